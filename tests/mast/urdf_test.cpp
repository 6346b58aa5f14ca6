// The mast of a URDF: what is understood, and what is refused.
#include "nbvopt/mast/urdf.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "core/text_file.hpp"
#include "nbvopt/core/error.hpp"
#include "support/error_message.hpp"
#include "support/paths.hpp"

namespace nbvopt {
namespace {

using std::numbers::pi;
using test::message_of;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

const std::string kOpticalRpy = "-1.5707963267948966 0 -1.5707963267948966";

/// A joint of a chain of links a0, a1, ... as the file gives it.
struct MadeJoint {
  std::string type = "fixed";
  std::string axis = "0 0 1";
  std::string xyz = "0 0 0";
  std::string rpy = "0 0 0";
  std::string limit = "lower='-1' upper='1' effort='1' velocity='1'";  ///< empty: no <limit/>
  std::string more{};
};

/// Joint i is called 'j<i>' and leads from link 'a<i>' to 'a<i + 1>'.
std::string urdf_of(const std::vector<MadeJoint>& joints) {
  std::string text = "<robot name='made'><link name='a0'/>";
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const MadeJoint& joint = joints[i];
    const std::string n = std::to_string(i);
    const std::string child = "a" + std::to_string(i + 1);
    text += "<link name='" + child + "'/><joint name='j" + n + "' type='" + joint.type +
            "'><parent link='a" + n + "'/><child link='" + child + "'/><origin xyz='" + joint.xyz +
            "' rpy='" + joint.rpy + "'/>";
    if (joint.type != "fixed") text += "<axis xyz='" + joint.axis + "'/>";
    if (!joint.limit.empty()) text += "<limit " + joint.limit + "/>";
    text += joint.more + "</joint>";
  }
  return text + "</robot>";
}

UrdfMast mast_of_chain(const std::vector<MadeJoint>& joints, UrdfOptions options = {}) {
  options.camera_link = "a" + std::to_string(joints.size());
  return read_urdf_mast(urdf_of(joints), "r.urdf", options);
}

std::string refusal(const std::vector<MadeJoint>& joints, const UrdfOptions& options = {}) {
  return message_of<InputError>([&] { mast_of_chain(joints, options); });
}

std::string text_refusal(const std::string& text, const UrdfOptions& options = {"a1", "", {}}) {
  const std::string message =
      message_of<InputError>([&] { read_urdf_mast(text, "r.urdf", options); });
  EXPECT_THAT(message, Not(HasSubstr("\n")));
  return message;
}

const MadeJoint kPan{.type = "revolute"};
const MadeJoint kTilt{.type = "revolute", .axis = "0 1 0"};
const MadeJoint kLift{.type = "prismatic", .limit = "lower='0' upper='1' effort='1' velocity='1'"};

MadeJoint with(MadeJoint joint, const std::string& xyz, const std::string& rpy = "0 0 0") {
  joint.xyz = xyz;
  joint.rpy = rpy;
  return joint;
}

/// The shipped file, its camera that of the optical frame.
UrdfMast shipped(const std::string& file) {
  const auto path = test::datasets_dir() / "robots" / file;
  return read_urdf_mast(read_text_file(path), file,
                        {.camera_link = "camera_depth_optical_frame", .base_link = ""});
}

// --- What is understood ---

TEST(Urdf, ShippedLiftIsThePapersMastToTheBit) {
  const UrdfMast lift = shipped("lift.urdf");
  EXPECT_EQ(lift.mast, MastOptions{});
  EXPECT_THAT(lift.warnings, IsEmpty());
  EXPECT_EQ(lift.joints[2]->name, "lift_1_joint");
  EXPECT_EQ(lift.joints[2]->scale, 3.0);
  EXPECT_EQ(lift.joints[2]->offset, 0.18);
}

TEST(Urdf, ShippedTurtleIsWhatOneWouldWriteByHandToTheBit) {
  MastOptions by_hand;
  by_hand.pan_continuous = false;
  by_hand.pan_min_rad = -2.6;
  by_hand.pan_max_rad = 2.6;
  by_hand.pan_velocity_rad_s = 1.5;
  by_hand.tilt_min_rad = -1.1;
  by_hand.tilt_max_rad = 0.5;
  by_hand.tilt_velocity_rad_s = 0.8;
  by_hand.height_min_m = by_hand.height_max_m = 0.47;
  by_hand.pan_axis_x_m = -0.05;
  by_hand.sensor_offset_m = {0.04, 0.0175, 0.025};
  const UrdfMast turtle = shipped("turtle_pan_tilt.urdf");
  EXPECT_EQ(turtle.mast, by_hand);
  EXPECT_EQ(turtle.base_link, "base_footprint");
  EXPECT_EQ(turtle.camera_axes, CameraAxes::optical);
  EXPECT_EQ(turtle.joints[1]->scale, -1.0);
  EXPECT_FALSE(turtle.joints[2]);
  EXPECT_THAT(turtle.warnings, IsEmpty());
}

TEST(Urdf, BodyAxesOfTheSameCameraAreTheSameMast) {
  const std::string text = read_text_file(test::datasets_dir() / "robots/turtle_pan_tilt.urdf");
  const UrdfMast body = read_urdf_mast(text, "t", {"camera_depth_frame", "base_footprint", {}});
  EXPECT_EQ(body.camera_axes, CameraAxes::body);
  EXPECT_EQ(body.mast, shipped("turtle_pan_tilt.urdf").mast);
  EXPECT_THAT(message_of<InputError>([&] {
                read_urdf_mast(text, "t", {"camera_depth_frame", "", CameraAxes::optical});
              }),
              HasSubstr("camera_axes may be body"));
}

TEST(Urdf, BaseMayBeAnyLinkThatCarriesTheCamera) {
  const std::string text = read_text_file(test::datasets_dir() / "robots/turtle_pan_tilt.urdf");
  const UrdfMast mast = read_urdf_mast(text, "t", {"camera_link", "mast_link", {}});
  EXPECT_EQ(mast.mast.height_min_m, 0.34);
}

/// The axis, or the same one turned about.
std::string sign(bool is_flipped, const char* axis, const char* flipped) {
  return is_flipped ? flipped : axis;
}

// For random chains that a mast can express, the poses of an independent product of the file's own
// numbers equal the mast's, whatever frames, signs and orders the chain has.
TEST(Urdf, KinematicsEqualTheChainsForRandomJoints) {
  std::mt19937 random(5);  // NOLINT(cert-msc51-cpp): the same each time
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto coin = [&] { return unit(random) > 0.0; };
  const auto number = [&](double scale) { return std::to_string(scale * unit(random)); };
  for (int i = 0; i < 60; ++i) {
    const bool flips_pan = coin();
    const bool flips_tilt = coin();
    const bool flips_lift = coin();
    const bool lifts_first = coin();
    const bool is_optical = coin();
    const double mount_yaw = unit(random) * 3.0;
    const double link_yaw = unit(random) * 3.0;
    const double camera_pitch = unit(random) * 0.4;
    MadeJoint lift = with(kLift, "0 0 " + number(0.3));
    lift.axis = sign(flips_lift, "0 0 2", "0 0 -0.5");
    MadeJoint pan = with(kPan, "0 0 " + number(0.3), "0 0 " + std::to_string(mount_yaw));
    pan.axis = sign(flips_pan, "0 0 1", "0 0 -1");
    MadeJoint tilt = with(kTilt, "0 0 " + number(0.2), "0 0 " + std::to_string(link_yaw));
    tilt.axis = sign(flips_tilt, "0 1 0", "0 -3 0");
    // Whoever slides the tilt joint along its own axis changes nothing but the offset's y.
    const MadeJoint camera = with({}, number(0.1) + " " + number(0.1) + " " + number(0.1),
                                  "0 " + std::to_string(camera_pitch) + " 0");
    std::vector<MadeJoint> chain{with({}, number(0.3) + " " + number(0.3) + " " + number(0.3))};
    chain.insert(chain.end(), {lifts_first ? lift : pan, lifts_first ? pan : lift, tilt, camera});
    if (is_optical) chain.push_back(with({}, "0 0 0", kOpticalRpy));
    const UrdfMast urdf =
        mast_of_chain(chain, {"", "a0", is_optical ? CameraAxes::optical : CameraAxes::body});
    const Mast mast(urdf.mast);

    for (int k = 0; k < 5; ++k) {
      Eigen::Vector3d joints(unit(random), unit(random), 0.5 + 0.5 * unit(random));
      // The chain's product, from the text of the file: Rz(yaw) Ry(pitch) Rx(roll) a joint.
      const auto place = [](const MadeJoint& joint) {
        std::istringstream xyz(joint.xyz);
        std::istringstream rpy(joint.rpy);
        Eigen::Vector3d t;
        Eigen::Vector3d a;
        xyz >> t.x() >> t.y() >> t.z();
        rpy >> a.x() >> a.y() >> a.z();
        return Transform(Eigen::Translation3d(t) *
                         Eigen::AngleAxisd(a.z(), Eigen::Vector3d::UnitZ()) *
                         Eigen::AngleAxisd(a.y(), Eigen::Vector3d::UnitY()) *
                         Eigen::AngleAxisd(a.x(), Eigen::Vector3d::UnitX()));
      };
      Transform T = Transform::Identity();
      for (const MadeJoint& joint : chain) {
        T = T * place(joint);
        if (joint.type == "prismatic") {
          T.translate(Eigen::Vector3d(0, 0, flips_lift ? -joints[2] : joints[2]));
        } else if (joint.type == "revolute" && joint.axis.starts_with("0 0")) {
          T.rotate(Eigen::AngleAxisd(flips_pan ? -joints[0] : joints[0], Eigen::Vector3d::UnitZ()));
        } else if (joint.type == "revolute") {
          T.rotate(
              Eigen::AngleAxisd(flips_tilt ? -joints[1] : joints[1], Eigen::Vector3d::UnitY()));
        }
      }
      if (!is_optical) T.rotate(rotation_body_sensor());
      Eigen::Vector3d q;
      for (int j = 0; j < 3; ++j) {
        q[j] = urdf.joints[j]->offset + urdf.joints[j]->scale * joints[j];
      }
      EXPECT_TRUE(mast.T_base_sensor(JointPosition::from(q)).isApprox(T, 1e-10))
          << urdf_of(chain) << "\n"
          << q.transpose();
      EXPECT_LE(q[0], urdf.mast.pan_max_rad + 1e-11);
      EXPECT_GE(q[1], urdf.mast.tilt_min_rad - 1e-11);
      EXPECT_LE(q[1], urdf.mast.tilt_max_rad + 1e-11);
      EXPECT_GE(q[2], urdf.mast.height_min_m - 1e-11);
      EXPECT_LE(q[2], urdf.mast.height_max_m + 1e-11);
    }
  }
}

TEST(Urdf, FlippedAxesFlipTheirLimits) {
  MadeJoint pan = kPan;
  pan.axis = "0 0 -1";
  pan.limit = "lower='-0.5' upper='2' effort='1' velocity='1'";
  MadeJoint lift = kLift;
  lift.axis = "0 0 -1";
  lift.limit = "lower='-0.5' upper='-0.25' effort='1' velocity='1'";
  const UrdfMast urdf = mast_of_chain({lift, pan});
  EXPECT_EQ(urdf.mast.pan_min_rad, -2.0);
  EXPECT_EQ(urdf.mast.pan_max_rad, 0.5);
  EXPECT_EQ(urdf.mast.height_min_m, 0.25);
  EXPECT_EQ(urdf.mast.height_max_m, 0.5);
}

TEST(Urdf, PanThatTurnsWithoutEndHasNoLimits) {
  MadeJoint pan = kPan;
  pan.type = "continuous";
  pan.limit = "effort='1' velocity='2'";
  const UrdfMast urdf = mast_of_chain({pan, kTilt});
  EXPECT_TRUE(urdf.mast.pan_continuous);
  EXPECT_EQ(urdf.mast.pan_velocity_rad_s, 2.0);
}

TEST(Urdf, MissingJointsStandWhereTheChainHoldsThem) {
  const UrdfMast urdf =
      mast_of_chain({with({}, "0.1 0.2 0.5", "0 0.25 0"), with(kLift, "0 0 0", "0 -0.25 0"),
                     with({}, "0 0 0", "0 0.25 1.5")});
  EXPECT_FALSE(urdf.mast.pan_continuous);
  EXPECT_EQ(urdf.mast.pan_min_rad, 1.5);
  EXPECT_EQ(urdf.mast.pan_max_rad, 1.5);
  EXPECT_EQ(urdf.mast.tilt_min_rad, -0.25);
  EXPECT_EQ(urdf.mast.tilt_max_rad, -0.25);
  EXPECT_EQ(urdf.mast.height_min_m, 0.5);
  EXPECT_EQ(urdf.mast.height_max_m, 1.5);
  const Transform T = Mast(urdf.mast).T_base_sensor({1.5, -0.25, 0.5});
  EXPECT_TRUE(T.translation().isApprox(Eigen::Vector3d(0.1, 0.2, 0.5), 1e-12));
}

TEST(Urdf, NothingThatMovesIsTold) {
  EXPECT_THAT(mast_of_chain({with({}, "0 0 1")}).warnings,
              testing::ElementsAre(HasSubstr("there is one view only")));
}

TEST(Urdf, JointWithEqualLimitsIsTakenAsFixed) {
  MadeJoint pan = kPan;
  pan.limit = "lower='0.5' upper='0.5' effort='1' velocity='0'";
  const UrdfMast urdf = mast_of_chain({pan, kTilt});
  EXPECT_THAT(urdf.warnings, testing::ElementsAre(HasSubstr("joint 'j0' has equal limits, 0.5")));
  EXPECT_FALSE(urdf.joints[0]);
  EXPECT_EQ(urdf.mast.pan_max_rad, 0.5);
}

TEST(Urdf, RoundedRightAnglesAreTakenForWhatTheyMean) {
  const UrdfMast urdf = mast_of_chain(
      {with(kPan, "0 0 0.5"), kTilt, with({}, "0.1 0 0"), with({}, "0 0 0", "-1.57 0 -1.57")},
      {"", "", CameraAxes::optical});
  EXPECT_THAT(urdf.warnings, testing::ElementsAre(HasSubstr("neglected")));
  EXPECT_NEAR(urdf.mast.sensor_offset_m.x(), 0.1, 1e-3);
  EXPECT_THAT(
      refusal({kPan, kTilt, with({}, "0 0 0", "-1.57 0 -1.5")}, {"", "", CameraAxes::optical}),
      HasSubstr("joint 'j1' turns about an axis that is not the camera's left or right"));
}

TEST(Urdf, TiltEndsStraightUpAndDown) {
  MadeJoint tilt = kTilt;
  tilt.limit = "lower='-3' upper='1' effort='1' velocity='1'";
  const UrdfMast urdf = mast_of_chain({kPan, tilt});
  EXPECT_EQ(urdf.mast.tilt_min_rad, -1.0);
  EXPECT_EQ(urdf.mast.tilt_max_rad, 0.5 * pi);
  EXPECT_THAT(urdf.warnings, testing::ElementsAre(HasSubstr("joint 'j1' tilts further")));
}

TEST(Urdf, StagesThatMimicALiftAreOneWithIt) {
  MadeJoint follower = kLift;
  follower.limit = "lower='-1' upper='0.5' effort='1' velocity='0.25'";
  follower.more = "<mimic joint='j1' multiplier='0.5' offset='0.1'/>";
  const UrdfMast urdf = mast_of_chain({follower, kLift, kPan});
  EXPECT_EQ(urdf.joints[2]->scale, 1.5);
  EXPECT_EQ(urdf.joints[2]->offset, 0.1);
  EXPECT_EQ(urdf.mast.height_min_m, 0.1);          // the leader's 0
  EXPECT_EQ(urdf.mast.height_max_m, 1.3);          // the follower's 0.5 is the leader's 0.8
  EXPECT_EQ(urdf.mast.height_velocity_m_s, 0.75);  // the follower's 0.25 is the leader's 0.5
}

// --- What a mast cannot express ---

TEST(Urdf, ArmIsRefusedByTheJointThatIsTooMany) {
  EXPECT_THAT(
      refusal({kPan, kTilt, with(kTilt, "0 0 0.3"), kPan}),
      AllOf(HasSubstr("r.urdf: joint 'j2' is the second that turns about a horizontal axis, "
                      "after joint 'j1'")));
  EXPECT_THAT(refusal({kPan, with(kPan, "0 0 0.3")}), HasSubstr("joint 'j1' is the second"));
  EXPECT_THAT(refusal({kLift, kLift}), HasSubstr("joint 'j1' is the second that lifts"));
}

TEST(Urdf, TiltComesLast) {
  EXPECT_THAT(refusal({kTilt, kLift}), HasSubstr("joint 'j1' lifts what joint 'j0' tilts"));
  EXPECT_THAT(refusal({kTilt, kPan}), HasSubstr("joint 'j1' pans what joint 'j0' tilts"));
}

TEST(Urdf, AxesOfNoMastAreRefused) {
  MadeJoint slide = kLift;
  slide.axis = "1 0 0";
  EXPECT_THAT(refusal({kPan, slide}), HasSubstr("joint 'j1' slides along (1.000, 0.000, 0.000)"));
  MadeJoint oblique = kPan;
  oblique.axis = "0 1 1";
  EXPECT_THAT(refusal({oblique}), HasSubstr("joint 'j0' turns about (0.000, 0.707, 0.707)"));
  MadeJoint roll = kTilt;
  roll.axis = "1 0 0";
  EXPECT_THAT(refusal({kPan, roll}), HasSubstr("joint 'j1' turns about an axis that is not"));
  MadeJoint none = kPan;
  none.axis = "0 0 0";
  EXPECT_THAT(refusal({none}), HasSubstr("joint 'j0' has the axis 0 0 0"));
}

TEST(Urdf, TiltAxisBeforeThePanAxisIsRefused) {
  EXPECT_THAT(refusal({with(kPan, "0.1 0 0"), with(kTilt, "0.05 0.02 0")}),
              HasSubstr("joint 'j1' tilts about a line 0.0500 m before the axis of joint 'j0'"));
}

TEST(Urdf, PanAxisStandsBesideTheBase) {
  const UrdfMast urdf =
      mast_of_chain({with({}, "-0.1 0.05 0.2", "0 0 1.5"), kPan, with(kTilt, "0 0.02 0.1")});
  EXPECT_EQ(urdf.mast.pan_axis_x_m, -0.1);
  EXPECT_EQ(urdf.mast.pan_axis_y_m, 0.05);
  EXPECT_EQ(urdf.mast.sensor_offset_m, Eigen::Vector3d(0.0, 0.02, 0.0));
  // Without a pan, the tilt axis is met where it is nearest.
  const UrdfMast still = mast_of_chain({with(kTilt, "0.1 0.05 0.2")});
  EXPECT_EQ(still.mast.pan_axis_x_m, 0.1);
  EXPECT_EQ(still.mast.pan_axis_y_m, 0.0);
  EXPECT_EQ(still.mast.sensor_offset_m, Eigen::Vector3d(0.0, 0.05, 0.0));
}

TEST(Urdf, CameraThatIsNotUprightIsRefused) {
  EXPECT_THAT(refusal({kPan, with({}, "0 0 0", "0.5 0 0")}), HasSubstr("'a2' is rolled by"));
  EXPECT_THAT(refusal({kPan, with({}, "0 0 0", "3.141592653589793 0 0")}),
              HasSubstr("'a2' is upside down"));
  EXPECT_THAT(refusal({kPan, kTilt, with({}, "0 0 0", "3.141592653589793 0 0")}),
              HasSubstr("'a3' is upside down"));
}

TEST(Urdf, JointsWithoutOneAxisOrUsableLimitsAreRefused) {
  for (const char* type : {"floating", "planar"}) {
    EXPECT_THAT(refusal({{.type = type}}), HasSubstr(std::string("joint 'j0' is ") + type));
  }
  MadeJoint joint = kPan;
  joint.limit = "lower='-1' upper='1' effort='1' velocity='0'";
  EXPECT_THAT(refusal({joint}), HasSubstr("joint 'j0' has the velocity limit 0"));
  joint.limit = "lower='1' upper='-1' effort='1' velocity='1'";
  EXPECT_THAT(refusal({joint}), HasSubstr("joint 'j0' has the lower limit 1 above"));
  joint.limit = "lower='-1' upper='1e300' effort='1' velocity='1'";
  EXPECT_THAT(refusal({joint}), HasSubstr("joint 'j0' has the limits -1 and 1e+300, they must be"));
  joint.limit = "";
  EXPECT_THAT(refusal({joint}), AllOf(HasSubstr("[j0]"), HasSubstr("does not specify limits")));
  joint.limit = "lower='-1' upper='1' effort='1'";
  EXPECT_THAT(refusal({joint}), AllOf(HasSubstr("[j0]"), HasSubstr("no velocity")));
  joint = {.type = "continuous", .limit = ""};
  EXPECT_THAT(refusal({joint}), HasSubstr("joint 'j0' has no velocity: add <limit"));
}

TEST(Urdf, MimicIsForTheStagesOfOneLiftOnly) {
  MadeJoint pan = kPan;
  pan.more = "<mimic joint='j1'/>";
  EXPECT_THAT(refusal({pan, kTilt}), HasSubstr("joint 'j0' mimics joint 'j1', which only"));
  MadeJoint follower = kLift;
  follower.more = "<mimic joint='elsewhere'/>";
  EXPECT_THAT(refusal({follower}), HasSubstr("'j0' mimics joint 'elsewhere', which is no lift"));
  EXPECT_THAT(refusal({kLift, follower}), HasSubstr("it must mimic the lift's first stage, 'j0'"));
  follower.more = "<mimic joint='j0' multiplier='-1'/>";
  EXPECT_THAT(refusal({kLift, follower}), HasSubstr("joint 'j0' lifts nothing"));
  follower.more = "<mimic joint='j0' multiplier='0'/>";
  EXPECT_THAT(refusal({kLift, follower}), HasSubstr("multiplier 0"));
}

TEST(Urdf, LimitsBeyondAnyMastAreRefusedByTheirField) {
  EXPECT_THAT(refusal({with({}, "0 0 500")}), HasSubstr("r.urdf: mast.height_max_m is 500"));
}

// --- Links and text ---

TEST(Urdf, UnknownLinksAreRefusedWithTheNearest) {
  const std::string text = read_text_file(test::datasets_dir() / "robots/turtle_pan_tilt.urdf");
  EXPECT_THAT(text_refusal(text, {"camera_lnk", "", {}}),
              HasSubstr("camera_link is 'camera_lnk', which is none of its 11 links, did you mean "
                        "'camera_link'?"));
  EXPECT_THAT(text_refusal(text, {"camera_link", "base_lonk", {}}),
              HasSubstr("base_link is 'base_lonk'"));
  EXPECT_THAT(text_refusal(text, {"", "", {}}),
              HasSubstr("give camera_link, such as 'camera_depth_optical_frame'"));
  EXPECT_THAT(text_refusal(text, {"camera_link", "wheel_left_link", {}}),
              HasSubstr("link 'camera_link' does not hang on 'wheel_left_link'"));
}

TEST(Urdf, CirclesAndTwoParentsAreRefused) {
  const std::string links = "<robot name='r'><link name='a0'/><link name='a1'/><link name='a2'/>";
  const auto joint = [](const std::string& name, const std::string& from, const std::string& to) {
    return "<joint name='" + name + "' type='fixed'><parent link='" + from + "'/><child link='" +
           to + "'/></joint>";
  };
  EXPECT_THAT(text_refusal(links + joint("j", "a1", "a2") + joint("k", "a2", "a1") + "</robot>"),
              HasSubstr("does not hang on 'a0'"));
  EXPECT_THAT(text_refusal(links + joint("j", "a0", "a1") + joint("k", "a2", "a1") +
                           joint("l", "a0", "a2") + "</robot>"),
              HasSubstr("link 'a1' is the child of two joints, 'j' and 'k'"));
}

TEST(Urdf, WhatIsNoUrdfIsRefusedInOneLine) {
  EXPECT_THAT(text_refusal("<sdf version='1.6'/>"),
              HasSubstr("Could not find the 'robot' element"));
  EXPECT_THAT(text_refusal("<robot name='r'>"), HasSubstr("is no URDF that can be read"));
  EXPECT_THAT(text_refusal("<robot name='r'/>"), HasSubstr("No link elements"));
  EXPECT_THAT(text_refusal("<a"), HasSubstr("is no URDF"));
  EXPECT_THAT(text_refusal("<robot name='r' version='7.0'><link name='a1'/></robot>"),
              HasSubstr("version"));
}

TEST(Urdf, XacroMustBeExpandedFirst) {
  EXPECT_THAT(
      text_refusal("<robot name='r'><!-- <xacro:no/> --><xacro:property name='p'/></robot>"),
      HasSubstr("xacro r.urdf > expanded.urdf"));
  EXPECT_THAT(text_refusal("<robot name='r'><!-- <xacro:no/> --><link name='a2'/></robot>"),
              HasSubstr("camera_link is 'a1'"));
}

TEST(Urdf, HugeOrDeepTextIsRefusedBeforeItIsRead) {
  std::string deep = "<robot name='r'>";
  for (int i = 0; i < 300'000; ++i) deep += "<a>";
  EXPECT_THAT(text_refusal(deep), HasSubstr("is nested deeper than 100 elements"));
  EXPECT_THAT(text_refusal("<robot name='r'>" + std::string(17 << 20, ' ')),
              HasSubstr("bytes, a robot must have at most"));
}

TEST(Urdf, IsToldFromYamlByItsContent) {
  EXPECT_TRUE(is_xml("\xEF\xBB\xBF \n<?xml version='1.0'?>"));
  EXPECT_TRUE(is_xml("<robot/>"));
  EXPECT_FALSE(is_xml("sensor: {}"));
  EXPECT_FALSE(is_xml(""));
}

}  // namespace
}  // namespace nbvopt
