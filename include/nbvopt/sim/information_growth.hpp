// How a map's information grew while it was made.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace nbvopt {

/// Information after each of a sequence of captures; it stays as it is from one to the next.
class InformationGrowth {
 public:
  struct Point {
    double time_s = 0.0;
    double information = 0.0;  ///< from then on

    bool operator==(const Point&) const = default;
  };

  /// Times must not fall.
  void add(double time_s, double information) { points_.push_back({time_s, information}); }

  const std::vector<Point>& points() const { return points_; }

  /// The time when there was first so much; none where that never was.
  std::optional<double> time_to_s(double information) const;

  /// Information at that time: 0 before the first capture, the last one's after it.
  double at(double time_s) const;

  /// The area below the curve, from 0 s, divided by the duration: 0 where that is 0.
  double mean_until(double duration_s) const;

  /// The same growth in at most `count` points, at least two: those left out are evenly spread,
  /// the last one stays.
  InformationGrowth thinned(std::size_t count) const;

 private:
  std::vector<Point> points_;
};

}  // namespace nbvopt
