// Worlds as other people write them: everything that a loader meets, made by hand, with positions
// worked out by hand.
#include "nbvopt/sim/world.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <tuple>

#include "nbvopt/core/error.hpp"
#include "sim/world/world_files.hpp"
#include "support/error_message.hpp"

namespace nbvopt {
namespace {

using test::box;
using test::box_of;
using test::has_vertex;
using test::include;
using test::link_with;
using test::mesh;
using test::message_of;
using test::WorldFolder;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

void expect_box(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& min_m,
                const Eigen::Vector3d& max_m) {
  EXPECT_LT((box.min() - min_m).norm(), 1e-5) << box.min().transpose();
  EXPECT_LT((box.max() - max_m).norm(), 1e-5) << box.max().transpose();
}

TEST(World, AddsUpThePosesOfNestedIncludes) {
  const WorldFolder folder;
  folder.add_model("inner", "<pose>0 0 5 0 0 0</pose>" + link_with(box("1 1 1"), "0 0 0.5 0 0 0"));
  folder.add_model("outer",
                   "<link name='base'/>" + include("model://inner", "<pose>1 0 0 0 0 0</pose>"));
  const World world = read_world(
      folder.add_world(include("model://outer",
                               "<name>turned</name><pose>10 0 0 0 0 1.5707963267948966</pose>")),
      {});
  // The include's pose replaces the inner model's own. Its box (0.5..1.5, -0.5..0.5, 0..1) in the
  // outer model is turned by a quarter and moved by 10 m.
  expect_box(world.bounds_m, {9.5, 0.5, 0.0}, {10.5, 1.5, 1.0});
  EXPECT_EQ(world.models, 1U);
  EXPECT_EQ(world.nested_models, 1U);
  EXPECT_THAT(world.warnings, IsEmpty());
}

TEST(World, KeepsAModelsOwnPoseWhereTheIncludeGivesNone) {
  const WorldFolder folder;
  folder.add_model("moved", "<pose>-20 -20 0 0 0 0</pose>" + link_with(box("2 2 2")));
  expect_box(read_world(folder.add_world(include("model://moved")), {}).bounds_m, {-21, -21, -1},
             {-19, -19, 1});
}

TEST(World, ReadsModelsThatWrapAnInclude) {
  const WorldFolder folder;
  folder.add_model("chair", link_with(box("1 1 1")), "1.4");
  const World world = read_world(
      folder.add_world("<model name='a'><static>true</static>" + include("model://chair") +
                       "<pose frame=''>3 0 0 0 0 0</pose></model><model name='b'>" +
                       include("model://chair") + "<pose frame=''>0 4 0 0 0 0</pose></model>"),
      {});
  EXPECT_EQ(world.models, 2U);
  EXPECT_EQ(world.nested_models, 2U);
  expect_box(world.bounds_m, {-0.5, -0.5, -0.5}, {3.5, 4.5, 0.5});
}

TEST(World, ScalesMeshesUnequallyAndMirrorsThem) {
  const WorldFolder folder;
  const auto model = folder.add_model(
      "carpet",
      link_with(mesh("model://carpet/meshes/t.stl", "<scale>-2 0.25 1</scale>"), "0 0 1 0 0 0"));
  folder.add_file("models/carpet/meshes/t.stl", test::triangle_stl());
  const World world = read_world(folder.add_world(include("model://carpet")), {});
  ASSERT_EQ(world.mesh.triangles.size(), 1U);
  EXPECT_TRUE(has_vertex(world.mesh, {0, 0, 4}));
  EXPECT_TRUE(has_vertex(world.mesh, {-2, 0, 4}));
  EXPECT_TRUE(has_vertex(world.mesh, {0, 0.5, 4}));
}

TEST(World, FindsMeshesByEveryKindOfUri) {
  const WorldFolder folder;
  const auto file = folder.add_file("models/Owner/meshes/t.stl", test::triangle_stl());
  for (const std::string& uri :
       {std::string("model://Owner/meshes/t.stl"), std::string("model:///Owner/meshes/t.stl"),
        std::string("model://owner/Meshes/T.STL"), std::string("file://../Owner/meshes/t.stl"),
        std::string("../Owner/meshes/t.stl"), file.string(), "file://" + file.string()}) {
    folder.add_model("user", link_with(mesh(uri)));  // another model's mesh
    const World world = read_world(folder.add_world(include("model://user")), {});
    EXPECT_EQ(world.mesh.triangles.size(), 1U) << uri;
    EXPECT_THAT(world.warnings, IsEmpty()) << uri;
  }
}

TEST(World, FindsModelsByTheirOwnNameAndInAnyCase) {
  const WorldFolder folder;
  const auto model = folder.add_model("Letter Box", link_with(box("1 1 1")));
  std::filesystem::rename(model, model.parent_path() / "mailbox_v2");
  for (const std::string uri :
       {"model://MailBox_V2", "model://letter box", "model:///mailbox_v2"}) {
    EXPECT_EQ(read_world(folder.add_world(include(uri)), {}).mesh.triangles.size(), 12U) << uri;
  }
}

TEST(World, SearchesTheUsersFoldersInTheirOrderAfterTheWorldsOwn) {
  const WorldFolder folder;
  const WorldFolder first;
  const WorldFolder second;
  first.add_model("thing", link_with(box("1 1 1")));
  second.add_model("thing", link_with(box("2 2 2")));
  const auto world = folder.add_world(include("model://thing"));
  const auto models = [](const WorldFolder& of) { return of.path() / "models"; };
  const auto size_m = [&](const WorldOptions& options) {
    return read_world(world, options).bounds_m.sizes().x();
  };
  EXPECT_DOUBLE_EQ(size_m({.model_paths = {models(first), models(second)}}), 1.0);
  EXPECT_DOUBLE_EQ(size_m({.model_paths = {models(second), models(first)}}), 2.0);
  folder.add_model("thing", link_with(box("3 3 3")));
  EXPECT_DOUBLE_EQ(size_m({.model_paths = {models(first)}}), 3.0);
  EXPECT_THAT(message_of<InputError>([&] { size_m({.model_paths = {"absent"}}); }),
              HasSubstr("absent: is not a folder"));
}

TEST(World, MakesTheShapesOfSdf) {
  const WorldFolder folder;
  const auto bounds = [&](const std::string& geometry) {
    return read_world(
               folder.add_world(
                   "<model name='m'>" + link_with(geometry, "1 2 3 0 0 0") + "</model>", "1.9"),
               {})
        .bounds_m;
  };
  expect_box(bounds(box("2 4 6")), {0, 0, 0}, {2, 4, 6});
  expect_box(bounds("<sphere><radius>0.5</radius></sphere>"), {0.5, 1.5, 2.5}, {1.5, 2.5, 3.5});
  expect_box(bounds("<cylinder><radius>0.5</radius><length>4</length></cylinder>"), {0.5, 1.5, 1},
             {1.5, 2.5, 5});
  expect_box(bounds("<capsule><radius>0.5</radius><length>4</length></capsule>"), {0.5, 1.5, 0.5},
             {1.5, 2.5, 5.5});
  expect_box(bounds("<ellipsoid><radii>1 2 3</radii></ellipsoid>"), {0, 0, 0}, {2, 4, 6});
}

TEST(World, TurnsPlanesAlongTheirNormalsAndKeepsThemOutOfTheBounds) {
  const WorldFolder folder;
  const World world = read_world(
      folder.add_world(
          "<model name='wall'>" +
          link_with("<plane><normal>1 0 0</normal><size>10 10</size></plane>", "3 0 0 0 0 0") +
          "</model><model name='box'>" + link_with(box("1 1 1")) + "</model>"),
      {});
  EXPECT_EQ(world.mesh.triangles.size(), 14U);
  EXPECT_TRUE(has_vertex(world.mesh, {3, 5, 5}));
  expect_box(world.bounds_m, {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
}

TEST(World, ResolvesPosesGivenInOtherFrames) {
  const WorldFolder folder;
  const World world =
      read_world(folder.add_world("<frame name='corner'><pose>10 0 0 0 0 0</pose></frame>"
                                  "<model name='m'><pose relative_to='corner'>0 1 0 0 0 0</pose>"
                                  "<frame name='shelf'><pose>0 0 2 0 0 0</pose></frame>"
                                  "<link name='link'><pose relative_to='shelf'>0 0 0.5 0 0 0</pose>"
                                  "<visual name='v'><geometry>" +
                                      box("1 1 1") + "</geometry></visual></link></model>",
                                  "1.9"),
                 {});
  expect_box(world.bounds_m, {9.5, 0.5, 2.0}, {10.5, 1.5, 3.0});
}

TEST(World, MixesVersionsReadsCrlfAndIgnoresComments) {
  const WorldFolder folder;
  for (const std::string version : {"1.4", "1.5", "1.6", "1.7", "1.8", "1.9"}) {
    folder.add_model("v" + version, link_with(box("1 1 1")), version);
  }
  std::string body;
  for (const std::string number : {"4", "5", "6", "7", "8", "9"}) {
    body += include("model://v1." + number, "<pose>" + number + " 0 0 0 0 0</pose>") + "\r\n";
  }
  body += "<!-- <model name='ceiling'>" + link_with(box("50 50 50")) + "</model> -->\r\n";
  for (const std::string version : {"1.4", "1.6", "1.9"}) {
    const World world = read_world(folder.add_world(body, version), {});
    EXPECT_EQ(world.models, 6U) << version;
    EXPECT_EQ(world.mesh.triangles.size(), 72U) << version;
    expect_box(world.bounds_m, {3.5, -0.5, -0.5}, {9.5, 0.5, 0.5});
  }
}

TEST(World, ReadsACommentBeforeTheDeclaration) {
  const WorldFolder folder;
  const std::string world = "<sdf version='1.6'><world name='w'><model name='m'>" +
                            link_with(box("1 1 1")) + "</model></world></sdf>";
  const auto path = folder.add_file(
      "a.world", "<!-- made by -- hand, > 1 year ago -->\n<?xml version='1.0'?>\n" + world);
  EXPECT_EQ(read_world(path, {}).mesh.triangles.size(), 12U);
}

TEST(World, LoadsWithoutWhatIsMissingAndRefusesWhenStrict) {
  const std::tuple<std::string, std::string, std::string> cases[] = {
      {include("model://absent"), "model://absent", "is not found"},
      {"<model name='bad'>" + link_with(mesh("model://there/none.dae")) + "</model>",
       "model 'bad': mesh 'model://there/none.dae'", "is not found"},
      {"<model name='bad'>" + link_with(mesh("model://there/broken.dae")) + "</model>",
       "model 'bad': mesh is left out", "broken.dae: cannot be read as a mesh"},
      {include("model://nests"), "model://absent_too", "is not found"},
      {"<model name='bad'>" + link_with("<image><uri>x.png</uri></image>") + "</model>",
       "model 'bad'", "'image' is left out"},
      {"<model name='bad'>" + link_with(box("1 1")) + "</model>",
       "model 'bad': visual 'visual' is left out", "<size> is '1 1', it must be 3 numbers"},
      {"<model name='bad'><pose relative_to='x'>0 0 0 0 0 0</pose></model>", "the world",
       "frame 'x' is not known"},
      {"<road name='r'><width>1</width><point>0 0 0</point><point>1 0 0</point></road>", "road 'r'",
       "it is flat"},
      {"<actor name='walker'><script><trajectory id='0' type='walk'/></script></actor>",
       "actor 'walker' is left out", "<trajectory> has no <waypoint>"},
      {include("model://there"), "there", "already exists"},
      {"<model name='far'><pose>300000 0 0 0 0 0</pose>" + link_with(box("1 1 1")) + "</model>",
       "model 'far' is left out", "300 km"}};
  for (const auto& [body, name, reason] : cases) {
    const WorldFolder folder;
    folder.add_model("there", link_with(box("1 1 1")));
    folder.add_file("models/there/broken.dae", "<COLLADA><asset>");
    folder.add_model("nests", "<link name='l'/>" + include("model://absent_too"));
    const auto path = folder.add_world(include("model://there") + body);
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    const World world = read_world(path, {});
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << body;
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "") << body;
    expect_box(world.bounds_m, {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
    EXPECT_EQ(world.warnings.size(), 1U) << testing::PrintToString(world.warnings);
    EXPECT_THAT(world.warnings, Contains(AllOf(HasSubstr(name), HasSubstr(reason)))) << body;
    EXPECT_THAT(message_of<InputError>([&] { read_world(path, {.is_strict = true}); }),
                AllOf(HasSubstr("test.world: "), HasSubstr(name)))
        << body;
  }
}

TEST(World, KeepsACityWhoseQuartersLieKilometresApart) {
  const WorldFolder folder;
  std::string body;
  for (int i = 0; i < 7; ++i) {
    body += "<model name='m" + std::to_string(i) + "'><pose>" + std::to_string(600 * i) +
            " 0 0 0 0 0</pose>" + link_with(box("10 10 10")) + "</model>";
  }
  const World world = read_world(folder.add_world(body), {});
  expect_box(world.bounds_m, {-5, -5, -5}, {3605, 5, 5});
  EXPECT_THAT(world.warnings, IsEmpty());
}

TEST(World, TakesVisualOrCollisionGeometry) {
  const WorldFolder folder;
  const auto path = folder.add_world(
      "<model name='m'><link name='l'><visual name='v'><pose>0 0 1 0 0 0</pose><geometry>" +
      box("1 1 1") + "</geometry></visual><collision name='c'><pose>0 0 2 0 0 0</pose><geometry>" +
      box("3 3 3") + "</geometry></collision></link></model>");
  expect_box(read_world(path, {}).bounds_m, {-0.5, -0.5, 0.5}, {0.5, 0.5, 1.5});
  expect_box(read_world(path, {.geometry = WorldGeometry::collision}).bounds_m, {-1.5, -1.5, 0.5},
             {1.5, 1.5, 3.5});
}

TEST(World, ReadsAFileThatHoldsOnlyAModel) {
  const WorldFolder folder;
  const auto model = folder.add_model("alone", link_with(mesh("meshes/t.stl")));
  folder.add_file("models/alone/meshes/t.stl", test::triangle_stl());
  const World world = read_world(model / "model.sdf", {});
  EXPECT_EQ(world.models, 1U);
  EXPECT_TRUE(has_vertex(world.mesh, {0, 2, 3}));
}

TEST(World, RefusesWhatIsNoWorldAndSaysWhy) {
  const WorldFolder folder;
  folder.add_model("again", "<link name='l'/>" + include("model://again"));
  folder.add_model("broken", "<link name='l'></model>");
  const std::string head = "<?xml version='1.0'?><sdf version='1.6'><world name='w'>";
  const std::string tail = "</world></sdf>";
  const std::tuple<std::string, std::string, std::string> files[] = {
      {"empty.world", "", "the file is empty"},
      {"page.world", "<html><body/></html>", "neither a world nor a model"},
      {"cut.world", head + "<model name='m'>", "Error parsing XML"},
      {"pose.world", head + "<model name='m'><pose>1 2 3</pose></model>" + tail, "<pose>"},
      {"lights.world", head + "<light name='sun' type='point'/>" + tail, "there is no geometry"},
      {"missing.world", head + include("model://absent") + tail, "model 'model://absent'"},
      {"cycle.world", head + include("model://again") + tail, "does it include itself?"},
      {"nested.world", head + include("model://broken") + tail, "Error parsing XML"},
      {"picture.png", "not looked at", "is neither a world (.world, .sdf) nor a mesh"}};
  for (const auto& [name, content, reason] : files) {
    const auto path = folder.add_file("worlds/" + name, content);
    testing::internal::CaptureStderr();
    const std::string message = message_of<InputError>([&] { read_world(path, {}); });
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << name;
    EXPECT_THAT(message, AllOf(HasSubstr(name + ": "), HasSubstr(reason)));
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
  EXPECT_THAT(message_of<InputError>([] { read_world("absent.world", {}); }),
              HasSubstr("absent.world: cannot be opened"));
}

}  // namespace
}  // namespace nbvopt
