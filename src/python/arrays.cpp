#include "python/arrays.hpp"

#include <algorithm>
#include <cmath>

#include "nbvopt/core/error.hpp"

namespace nbvopt::python {
namespace {

using DoubleArray = py::array_t<double, py::array::c_style | py::array::forcecast>;

std::string shape_text(const py::array& array) {
  return py::str(py::tuple(array.attr("shape"))).cast<std::string>();
}

/// The numbers of an array or of nested sequences, all finite.
DoubleArray numbers_from(const py::object& values, const std::string& name) {
  auto array = DoubleArray::ensure(values);
  if (!array) {
    PyErr_Clear();
    throw InputError(name + " must be an array of numbers");
  }
  const double* const first = array.data();
  if (!std::all_of(first, first + array.size(),
                   [](double value) { return std::isfinite(value); })) {
    throw InputError(name + ": every number must be finite");
  }
  return array;
}

/// How far a product of the rotation's columns may be from 0 or 1: more than float32 loses.
constexpr double kRigidTolerance = 1e-5;

Transform rigid_from(const double* row_major, const std::string& name) {
  Transform T;
  T.matrix() = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(row_major);
  if (T.matrix().row(3) != Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0)) {
    throw InputError(name + ": the last row must be 0, 0, 0, 1");
  }
  const Eigen::Matrix3d R = T.linear();
  const double off = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(off <= kRigidTolerance) || R.determinant() < 0.0) {
    throw InputError(name + ": the upper left 3 x 3 must be a rotation");
  }
  return T;
}

void write_row_major(const Transform& T, double* at) {
  Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>{at} = T.matrix();
}

/// Points or directions: (N, 3) numbers, finite or not.
std::vector<Eigen::Vector3f> points_from(const py::object& points, const std::string& name) {
  const auto array = py::array_t<float, py::array::c_style | py::array::forcecast>::ensure(points);
  if (!array) {
    PyErr_Clear();
    throw InputError(name + " must be an array of numbers");
  }
  if (array.ndim() != 2 || array.shape(1) != 3) {
    throw InputError(name + " has the shape " + shape_text(array) + ", it must be (N, 3)");
  }
  std::vector<Eigen::Vector3f> result(static_cast<std::size_t>(array.shape(0)));
  std::copy_n(array.data(), array.size(), result.empty() ? nullptr : result.front().data());
  return result;
}

std::vector<std::array<std::uint8_t, 3>> colours_from(const py::object& colours) {
  // Other types are not converted: 0.5 and 300 would silently be other colours.
  if (!py::isinstance<py::array_t<std::uint8_t>>(colours)) {
    throw InputError("colours must be an array of uint8");
  }
  const auto array = py::array_t<std::uint8_t, py::array::c_style>::ensure(colours);
  if (array.ndim() != 2 || array.shape(1) != 3) {
    throw InputError("colours has the shape " + shape_text(array) + ", it must be (N, 3)");
  }
  std::vector<std::array<std::uint8_t, 3>> result(static_cast<std::size_t>(array.shape(0)));
  std::copy_n(array.data(), array.size(), result.empty() ? nullptr : result.front().data());
  return result;
}

}  // namespace

Transform pose_from(const py::object& pose, const std::string& name) {
  const DoubleArray array = numbers_from(pose, name);
  if (array.ndim() != 2 || array.shape(0) != 4 || array.shape(1) != 4) {
    throw InputError(name + " has the shape " + shape_text(array) + ", it must be (4, 4)");
  }
  return rigid_from(array.data(), name);
}

std::vector<Transform> poses_from(const py::object& poses) {
  const DoubleArray array = numbers_from(poses, "poses");
  if (array.ndim() != 3 || array.shape(1) != 4 || array.shape(2) != 4) {
    throw InputError("poses has the shape " + shape_text(array) + ", it must be (N, 4, 4)");
  }
  std::vector<Transform> result;
  for (std::size_t i = 0; i < static_cast<std::size_t>(array.shape(0)); ++i) {
    result.push_back(rigid_from(array.data() + 16 * i, "poses[" + std::to_string(i) + "]"));
  }
  return result;
}

std::vector<JointPosition> joint_positions_from(const py::object& joints) {
  const DoubleArray array = numbers_from(joints, "joints");
  if (array.ndim() != 2 || array.shape(1) != 3) {
    throw InputError("joints has the shape " + shape_text(array) +
                     ", it must be (N, 3): pan, tilt, height");
  }
  std::vector<JointPosition> result;
  for (py::ssize_t i = 0; i < array.shape(0); ++i) {
    result.push_back({array.at(i, 0), array.at(i, 1), array.at(i, 2)});
  }
  return result;
}

std::vector<double> vector_from(const py::object& values, const std::string& name) {
  const DoubleArray array = numbers_from(values, name);
  if (array.ndim() != 1) {
    throw InputError(name + " has the shape " + shape_text(array) + ", it must be (N,)");
  }
  return {array.data(), array.data() + array.size()};
}

std::vector<Eigen::Vector2d> plane_points_from(const py::object& points, const std::string& name) {
  const DoubleArray array = numbers_from(points, name);
  if (array.ndim() != 2 || array.shape(1) != 2) {
    throw InputError(name + " has the shape " + shape_text(array) + ", it must be (N, 2)");
  }
  std::vector<Eigen::Vector2d> result;
  for (py::ssize_t i = 0; i < array.shape(0); ++i)
    result.emplace_back(array.at(i, 0), array.at(i, 1));
  return result;
}

Eigen::Vector3d vector3_from(const py::object& values, const std::string& name) {
  const DoubleArray array = numbers_from(values, name);
  if (array.ndim() != 1 || array.size() != 3) {
    throw InputError(name + " has the shape " + shape_text(array) + ", it must be (3,)");
  }
  return {array.at(0), array.at(1), array.at(2)};
}

JointPosition joint_position_from(const py::object& joints) {
  return JointPosition::from(vector3_from(joints, "joints"));
}

Transform base_from(const py::object& base) {
  const DoubleArray array = numbers_from(base, "base");
  if (array.ndim() != 1 || (array.size() != 3 && array.size() != 4)) {
    throw InputError("base has the shape " + shape_text(array) +
                     ", it must be (x, y, yaw) or (x, y, z, yaw)");
  }
  const double z_m = array.size() == 4 ? array.at(2) : 0.0;
  return base_pose(array.at(0), array.at(1), z_m, array.at(array.size() - 1));
}

Scan scan_from(const py::object& points, const py::object& no_returns, const py::object& colours) {
  Scan scan{.points_m = points_from(points, "points"), .colours = {}, .no_returns = {}};
  if (!no_returns.is_none()) scan.no_returns = points_from(no_returns, "no_returns");
  if (!colours.is_none()) scan.colours = colours_from(colours);
  return scan;
}

py::array_t<double> make_array(std::vector<py::ssize_t> shape) {
  return py::array_t<double>(std::move(shape));
}

py::array_t<double> to_array(const JointPosition& joints) {
  return py::array_t<double>(3, joints.vector().data());
}

py::array_t<double> to_array(const std::vector<Transform>& all) {
  py::array_t<double> array = make_array({static_cast<py::ssize_t>(all.size()), 4, 4});
  double* next = array.mutable_data();
  for (const Transform& T : all) {
    write_row_major(T, next);
    next += 16;
  }
  return array;
}

py::array_t<double> to_array(const Transform& T) {
  py::array_t<double> array = make_array({4, 4});
  write_row_major(T, array.mutable_data());
  return array;
}

py::array_t<double> to_array(const std::vector<Eigen::Vector3d>& rows) {
  py::array_t<double> array = make_array({static_cast<py::ssize_t>(rows.size()), 3});
  double* next = array.mutable_data();
  for (const Eigen::Vector3d& row : rows) next = std::copy(row.begin(), row.end(), next);
  return array;
}

py::array_t<float> to_array(const std::vector<Eigen::Vector3f>& rows) {
  py::array_t<float> array({static_cast<py::ssize_t>(rows.size()), py::ssize_t{3}});
  float* next = array.mutable_data();
  for (const Eigen::Vector3f& row : rows) next = std::copy(row.begin(), row.end(), next);
  return array;
}

py::array_t<double> to_array(const JointBox& box) {
  return to_array(std::vector<Eigen::Vector3d>{box.min, box.max});
}

}  // namespace nbvopt::python
