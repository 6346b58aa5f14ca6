#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "nbvopt/core/error.hpp"
#include "nbvopt/gain/panorama.hpp"
#include "nbvopt/planner/view_planner.hpp"
#include "python/arrays.hpp"
#include "python/bindings.hpp"

namespace nbvopt::python {
namespace {

/// The panorama over what a request's joints can reach, with the map that it looks at.
class RequestPanorama {
 public:
  RequestPanorama(std::shared_ptr<SharedMap> map, const Robot& robot, const PlanRequest& request,
                  const PanoramaOptions& options)
      : planner_(std::move(map), robot), box_(planner_.reachable_box(request)) {
    panorama_ = std::make_unique<Panorama>(planner_.grid(), robot.sensor,
                                           moving_mast(request, planner_.mast()), box_, options);
  }

  const JointBox& box() const { return box_; }
  const Panorama& panorama() const { return *panorama_; }

  /// Throws InputError for the first position outside the box: no rays were cast for it.
  void check_inside(const std::vector<JointPosition>& all) const {
    const Eigen::Vector3d rounding = Eigen::Vector3d::Constant(1e-9);
    const JointBox widened{box_.min - rounding, box_.max + rounding};
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!widened.contains(all[i].vector())) {
        throw InputError("joints[" + std::to_string(i) + "] is outside the surrogate's box");
      }
    }
  }

 private:
  ViewPlanner planner_;
  JointBox box_;
  std::unique_ptr<const Panorama> panorama_;
};

std::unique_ptr<RequestPanorama> make_surrogate(std::shared_ptr<SharedMap> map, const Robot& robot,
                                                const py::object& base, const py::object& joints,
                                                double motion_time_s, double ray_spacing,
                                                double layer_spacing, double smoothing,
                                                bool double_precision) {
  PlanRequest request;
  request.T_map_base = base_from(base);
  std::vector<std::string> warnings;  // tiny steps beyond the limits: query() reports them
  request.joints = Mast(robot.mast).clamped(joint_position_from(joints), warnings);
  request.motion_time_s = motion_time_s;
  const py::gil_scoped_release release;
  return std::make_unique<RequestPanorama>(std::move(map), robot, request,
                                           PanoramaOptions{.ray_spacing = ray_spacing,
                                                           .layer_spacing = layer_spacing,
                                                           .smoothing = smoothing,
                                                           .double_precision = double_precision});
}

py::array_t<double> gains(const RequestPanorama& surrogate, const py::object& joints) {
  const std::vector<JointPosition> all = joint_positions_from(joints);
  surrogate.check_inside(all);
  std::vector<double> values;
  {
    const py::gil_scoped_release release;
    for (const JointPosition& q : all) values.push_back(surrogate.panorama().gain(q));
  }
  return array_of<double>(values, [](double value) { return value; });
}

py::tuple gains_and_gradients(const RequestPanorama& surrogate, const py::object& joints) {
  const std::vector<JointPosition> all = joint_positions_from(joints);
  surrogate.check_inside(all);
  std::vector<double> values;
  std::vector<Eigen::Vector3d> gradients;
  {
    const py::gil_scoped_release release;
    for (const JointPosition& q : all) {
      values.push_back(surrogate.panorama().gain(q, gradients.emplace_back()));
    }
  }
  return py::make_tuple(array_of<double>(values, [](double value) { return value; }),
                        to_array(gradients));
}

}  // namespace

void bind_surrogate(py::module_& module) {
  const PanoramaOptions defaults;
  py::class_<RequestPanorama>(
      module, "Surrogate",
      "The smooth gain that searches climb, over the joint positions that are in reach: rays are "
      "cast once from layers along the mast, and the hits reused for every pan and tilt.")
      .def(py::init(&make_surrogate), py::arg("map"), py::arg("robot"), py::arg("base"),
           py::arg("joints"), py::arg("motion_time_s"),
           py::arg("ray_spacing") = defaults.ray_spacing,
           py::arg("layer_spacing") = defaults.layer_spacing,
           py::arg("smoothing") = defaults.smoothing,
           py::arg("double_precision") = defaults.double_precision,
           "base: (x, y, yaw) or (x, y, z, yaw). joints: where they are now, (pan, tilt, height). "
           "motion_time_s: how long they may move; 0 means no limit.\n\n"
           "ray_spacing: of the layers' rays, in spacings of the sensor's; the search `auto` takes "
           "2. layer_spacing: in voxels, or half voxels where they are 0.1 m or larger; `auto` "
           "takes 6. smoothing: the width of the field of view's soft edge, in spacings of the "
           "layers' rays. double_precision: of the sums, which are good to 1e-6 without.\n\n"
           "ValueError: an argument of a wrong shape or not finite, joints beyond their limits, a "
           "negative time, a spacing that is not above 0.")
      .def_property_readonly(
          "box", [](const RequestPanorama& surrogate) { return to_array(surrogate.box()); },
          "(2, 3): the lowest and the highest joint position in reach.")
      .def("gains", &gains, py::arg("joints"),
           "(N,) gains of `joints`, (N, 3): pan, tilt, height. ValueError: a wrong shape, or a "
           "position outside the box.")
      .def("gains_and_gradients", &gains_and_gradients, py::arg("joints"),
           "(N,) gains and (N, 3) their derivatives by pan and tilt (1/rad) and height (1/m).");
}

}  // namespace nbvopt::python
