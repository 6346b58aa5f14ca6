// NumPy arrays and what they stand for. Readers throw InputError that names the argument.
#pragma once

#include <pybind11/numpy.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "nbvopt/core/transform.hpp"
#include "nbvopt/map/scan.hpp"
#include "nbvopt/mast/mast.hpp"

namespace nbvopt::python {

namespace py = pybind11;

/// T_map_sensor, from a (4, 4) array that is a finite rigid transform.
Transform pose_from(const py::object& pose, const std::string& name);

/// T_map_sensor of each view, from an (N, 4, 4) array of finite rigid transforms.
std::vector<Transform> poses_from(const py::object& poses);

/// Joint positions, from an (N, 3) array of finite numbers.
std::vector<JointPosition> joint_positions_from(const py::object& joints);

/// One joint position, from (pan, tilt, height).
JointPosition joint_position_from(const py::object& joints);

/// T_map_base, from (x, y, yaw) or (x, y, z, yaw).
Transform base_from(const py::object& base);

/// Finite numbers, from a sequence.
std::vector<double> vector_from(const py::object& values, const std::string& name);

/// Points in the plane, from an (N, 2) array of finite numbers.
std::vector<Eigen::Vector2d> plane_points_from(const py::object& points, const std::string& name);

/// Three finite numbers, from a sequence.
Eigen::Vector3d vector3_from(const py::object& values, const std::string& name);

/// A scan, from (N, 3) arrays: points and directions of numbers, finite or not, colours of uint8.
/// The last two may be None.
Scan scan_from(const py::object& points, const py::object& no_returns, const py::object& colours);

/// An uninitialised array of doubles.
py::array_t<double> make_array(std::vector<py::ssize_t> shape);

/// An array of any fields of a range's elements.
template <class Value, class Range, class Field>
py::array_t<Value> array_of(const Range& range, const Field& field) {
  py::array_t<Value> array(static_cast<py::ssize_t>(range.size()));
  Value* next = array.mutable_data();
  for (const auto& element : range) *next++ = field(element);
  return array;
}

py::array_t<double> to_array(const JointPosition& joints);        ///< (3,)
py::array_t<double> to_array(const std::vector<Transform>& all);  ///< (N, 4, 4)
py::array_t<double> to_array(const Transform& T);                 ///< (4, 4)
py::array_t<double> to_array(const JointBox& box);                ///< (2, 3): lowest, highest
py::array_t<double> to_array(const std::vector<Eigen::Vector3d>& rows);  ///< (N, 3)
py::array_t<float> to_array(const std::vector<Eigen::Vector3f>& rows);   ///< (N, 3)

}  // namespace nbvopt::python
