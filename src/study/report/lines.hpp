// Which solvers stand out in a picture of a study, and how.
#pragma once

#include <string>
#include <vector>

#include "plot/line_chart.hpp"

namespace nbvopt {

/// The lines of a study's solvers in one picture: the first solver, the paper's grids (names that
/// begin with "paper") and the best five of the others stand out by colour, mark and dashes; the
/// rest is thin and grey.
class StudyLines {
 public:
  /// `score` has a figure a solver, greater for better ones; NaN for one without a line.
  StudyLines(const std::vector<std::string>& solvers, const std::vector<double>& score);

  /// Solvers in the order in which their lines are drawn: those that stand out last.
  const std::vector<std::size_t>& drawing_order() const { return drawing_order_; }
  const LineStyle& style(std::size_t solver) const { return styles_[solver]; }

  /// Of names with their lines, the best first, downwards from the top left corner. Very long names
  /// are cut.
  void draw_legend(Canvas& canvas, const Eigen::Vector2d& top_left) const;
  double legend_width() const;

 private:
  std::vector<std::string> solvers_;
  std::vector<LineStyle> styles_;
  std::vector<std::size_t> highlighted_;  ///< the best first
  std::vector<std::size_t> drawing_order_;
  std::size_t others_ = 0;  ///< grey lines
};

}  // namespace nbvopt
