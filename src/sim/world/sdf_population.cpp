#include "sim/world/sdf_population.hpp"

#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <string>

#include "core/number.hpp"
#include "core/uniform.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {

namespace {

using Positions = std::vector<Eigen::Vector3d>;

constexpr double kCopiesMax = 100'000.0;

/// Three numbers in [0, 1), which say where in a region the copy of that number stands.
using Spread = std::function<Eigen::Vector3d(int copy)>;

std::size_t count_of(const SdfElement& parent, const char* child) {
  const double count = number_of(parent, child, 1.0);
  if (count >= 1.0 && count <= kCopiesMax) return static_cast<std::size_t>(count);
  throw InputError(std::string("<") + child + "> is " + format_number(count) +
                   ", it must be between 1 and 100000");
}

void require_positive(double value, const char* what) {
  if (value > 0.0) return;
  throw InputError(std::string("its region's ") + what + " is " + format_number(value) +
                   ", it must be positive");
}

/// Halton's sequence: an even spread that has no seed.
double halton(int copy, int base) {
  double value = 0.0;
  double share = 1.0;
  for (int rest = copy + 1; rest > 0; rest /= base) {
    share /= base;
    value += share * (rest % base);
  }
  return value;
}

/// Gazebo moves the region's corner to the pose before it turns what lies in it.
Positions in_box(const SdfElement& box, const Eigen::Affine3d& T_map_population, std::size_t count,
                 const Spread& spread) {
  const Eigen::Vector3d size_m = vector_of(box, "size", Eigen::Vector3d(Eigen::Vector3d::Ones()));
  require_positive(size_m.minCoeff(), "size");
  Positions positions_m;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d offset_m = spread(static_cast<int>(i)).cwiseProduct(size_m);
    positions_m.emplace_back(T_map_population.translation() - 0.5 * size_m +
                             T_map_population.linear() * offset_m);
  }
  return positions_m;
}

Positions in_cylinder(const SdfElement& cylinder, const Eigen::Affine3d& T_map_population,
                      std::size_t count, bool is_even, const Spread& spread) {
  const double radius_m = number_of(cylinder, "radius", 1.0);
  const double length_m = number_of(cylinder, "length", 1.0);
  require_positive(radius_m, "radius");
  require_positive(length_m, "length");
  Positions positions_m;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d share = spread(static_cast<int>(i));
    const double angle_rad = 2.0 * std::numbers::pi * share.x();
    // Gazebo's random radius is uniform, so that copies are denser in the middle.
    const double from_axis_m = radius_m * (is_even ? std::sqrt(share.y()) : share.y());
    positions_m.emplace_back(T_map_population * Eigen::Vector3d(from_axis_m * std::cos(angle_rad),
                                                                from_axis_m * std::sin(angle_rad),
                                                                (share.z() - 0.5) * length_m));
  }
  return positions_m;
}

Positions on_grid(const SdfElement& distribution, const Eigen::Affine3d& T_map_population) {
  const std::size_t rows = count_of(distribution, "rows");
  const std::size_t cols = count_of(distribution, "cols");
  if (static_cast<double>(rows) * static_cast<double>(cols) > kCopiesMax) {
    throw InputError("its grid has more than 100000 places");
  }
  const Eigen::Vector3d step_m = vector_of(distribution, "step", Eigen::Vector3d(0.5, 0.5, 0.0));
  const Eigen::Vector3d corner_m(0.5 * step_m.x() * static_cast<double>(cols - 1),
                                 0.5 * step_m.y() * static_cast<double>(rows - 1), 0.0);
  Positions positions_m;
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t col = 0; col < cols; ++col) {
      const Eigen::Vector3d offset_m(step_m.x() * static_cast<double>(col),
                                     step_m.y() * static_cast<double>(row), 0.0);
      positions_m.emplace_back(T_map_population.translation() - corner_m +
                               T_map_population.linear() * offset_m);
    }
  }
  return positions_m;
}

/// In a row along one axis of the box, in the middle of the others.
Spread row_along(int axis, std::size_t count) {
  return [axis, count](int copy) {
    Eigen::Vector3d share = Eigen::Vector3d::Constant(0.5);
    share[axis] = copy / static_cast<double>(count);
    return share;
  };
}

}  // namespace

Positions population_positions_m(const SdfElement& population, std::mt19937_64& generator) {
  const SdfElement* pose = population.FirstChildElement("pose");
  const Eigen::Affine3d T_map_population =
      pose == nullptr ? Eigen::Affine3d::Identity() : pose_of(*pose);
  const SdfElement* distribution = population.FirstChildElement("distribution");
  const std::string type = distribution == nullptr ? "random" : text_of(*distribution, "type");
  if (type == "grid") return on_grid(*distribution, T_map_population);

  const std::size_t count = count_of(population, "model_count");
  const SdfElement* box = population.FirstChildElement("box");
  const SdfElement* cylinder = population.FirstChildElement("cylinder");
  const bool is_even = type == "uniform";
  Spread spread;
  if (type == "random") {
    spread = [&generator](int) {
      const double x = uniform(generator);
      const double y = uniform(generator);
      return Eigen::Vector3d(x, y, uniform(generator));
    };
  } else if (is_even) {
    spread = [](int copy) {
      return Eigen::Vector3d(halton(copy, 2), halton(copy, 3), halton(copy, 5));
    };
  } else if (box != nullptr && type.starts_with("linear-") && type.size() == 8 &&
             type.back() >= 'x' && type.back() <= 'z') {
    spread = row_along(type.back() - 'x', count);
  }
  if (spread && box != nullptr) return in_box(*box, T_map_population, count, spread);
  if (spread && cylinder != nullptr) {
    return in_cylinder(*cylinder, T_map_population, count, is_even, spread);
  }
  throw InputError("its distribution is '" + type + "'" +
                   (box == nullptr && cylinder == nullptr ? " without a <box> or <cylinder>" : "") +
                   ", it must be random, uniform, grid or, in a box, linear-x, linear-y, linear-z");
}

}  // namespace nbvopt
