#include "study/report/lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "plot/style.hpp"

namespace nbvopt {
namespace {

constexpr std::size_t kBestOthers = 5;

// The legend, in points.
constexpr double kSample = 30.0;
constexpr double kGap = 9.0;
constexpr double kRow = 21.0;
constexpr double kWidestName = 300.0;

// Okabe and Ito's colours, which people with any colour vision tell apart.
const std::array<LineStyle, kBestOthers> kOtherStyles{
    LineStyle{{rgb(0xD55E00), 1.7}, LineMark::square},
    LineStyle{{rgb(0x009E73), 1.7}, LineMark::triangle},
    LineStyle{{rgb(0xCC79A7), 1.7}, LineMark::diamond},
    LineStyle{{rgb(0xE69F00), 1.7}, LineMark::disc},
    LineStyle{{rgb(0x56B4E9), 1.7}, LineMark::square},
};
const LineStyle kControlStyle{{style::kChosen, 2.8}, LineMark::disc};
const LineStyle kGreyStyle{{style::kUnknownGain, 0.9}, LineMark::none};

/// Dark and dashed, the dashes growing shorter from grid to grid.
LineStyle paper_style(std::size_t grid) {
  constexpr std::array kDashes{10.0, 6.0, 3.0, 1.5};
  const double dash = kDashes[grid % kDashes.size()];
  return {{style::kInk, 1.6, {dash, 2.5}}, LineMark::none};
}

TextStyle name_style(std::size_t solver) {
  TextStyle text = style::body();
  text.bold = solver == 0;
  return text;
}

std::string shortened(const Canvas& canvas, std::string name, const TextStyle& style) {
  if (canvas.text_width(name, style) <= kWidestName) return name;
  while (canvas.text_width(name + "\u2026", style) > kWidestName) {
    while ((name.back() & 0xC0) == 0x80) name.pop_back();  // the rest of a letter in UTF-8
    name.pop_back();
  }
  return name + "\u2026";
}

}  // namespace

StudyLines::StudyLines(const std::vector<std::string>& solvers, const std::vector<double>& score)
    : solvers_(solvers), styles_(solvers.size(), kGreyStyle) {
  std::vector<std::size_t> ranking;
  for (std::size_t i = 0; i < solvers.size(); ++i) {
    if (!std::isnan(score[i])) ranking.push_back(i);
  }
  std::ranges::stable_sort(ranking, std::greater{}, [&](std::size_t i) { return score[i]; });
  std::size_t best = 0;
  for (const std::size_t i : ranking) {
    const bool is_given = i == 0 || solvers[i].starts_with("paper");
    const bool is_highlighted = is_given || best++ < kBestOthers;
    (is_highlighted ? highlighted_ : drawing_order_).push_back(i);
  }
  // In the study's order, so that a solver keeps its style where two pictures show the same ones.
  std::vector<std::size_t> in_order = highlighted_;
  std::ranges::sort(in_order);
  std::size_t grids = 0;
  std::size_t others = 0;
  for (const std::size_t i : in_order) {
    const bool is_grid = solvers[i].starts_with("paper");
    styles_[i] = i == 0 ? kControlStyle : is_grid ? paper_style(grids++) : kOtherStyles[others++];
  }
  others_ = drawing_order_.size();
  const auto control = std::ranges::find(highlighted_, std::size_t{0});
  drawing_order_.insert(drawing_order_.end(), highlighted_.rbegin(), highlighted_.rend());
  if (control == highlighted_.end()) return;
  std::erase(drawing_order_, std::size_t{0});
  drawing_order_.push_back(0);
}

double StudyLines::legend_width() const {
  const Canvas canvas(1.0, 1.0, 1.0);
  double widest = 0.0;
  for (const std::size_t solver : highlighted_) {
    widest = std::max(widest, canvas.text_width(solvers_[solver], name_style(solver)));
  }
  return kSample + kGap + std::clamp(widest, 80.0, kWidestName);
}

void StudyLines::draw_legend(Canvas& canvas, const Eigen::Vector2d& top_left) const {
  Eigen::Vector2d at = top_left + Eigen::Vector2d(0.0, 8.0);
  const auto add = [&](const LineStyle& line, const std::string& name, const TextStyle& text) {
    draw_line_sample(canvas, at, kSample, line);
    canvas.text(at + Eigen::Vector2d(kSample + kGap, 4.0), shortened(canvas, name, text), text);
    at.y() += kRow;
  };
  for (const std::size_t solver : highlighted_) {
    add(styles_[solver], solvers_[solver], name_style(solver));
  }
  if (others_ > 0) {
    add(kGreyStyle, std::to_string(others_) + (others_ == 1 ? " other" : " others"), style::note());
  }
}

}  // namespace nbvopt
