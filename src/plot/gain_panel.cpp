#include "plot/gain_panel.hpp"

#include <algorithm>
#include <cmath>

#include "plot/axis.hpp"
#include "plot/style.hpp"

namespace nbvopt {
namespace {

using Line = std::vector<Eigen::Vector2d>;

constexpr int kSamples = 181;

/// The gain along pan, at the answer's tilt and height.
struct GainCurve {
  std::vector<double> pan_rad;
  std::vector<ViewGain> view;
};

GainCurve sample(const PlotInput& input, const std::vector<double>& pans_rad) {
  const MovingMast mast = moving_mast(input.result.request, input.planner.mast());
  std::vector<Transform> poses;
  for (const double pan_rad : pans_rad) {
    JointPosition joints = input.result.joints;
    joints.pan_rad = pan_rad;
    poses.push_back(mast.T_map_sensor(joints));
  }
  return {pans_rad, input.planner.evaluate(poses)};
}

std::vector<double> evenly_spaced(double min, double max, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(min + (max - min) * i / (count - 1));
  return values;
}

/// What the axes span, and where it lies on the page.
struct GainChart {
  Rectangle panel;
  double pan_min_rad;
  double pan_max_rad;
  double gain_max;

  Eigen::Vector2d to_page(double pan_rad, double gain) const {
    const double share_x = (pan_rad - pan_min_rad) / (pan_max_rad - pan_min_rad);
    return {panel.x + share_x * panel.width, panel.bottom() - gain / gain_max * panel.height};
  }
};

GainChart make_chart(const Rectangle& panel, const PlotInput& input, const GainCurve& curve) {
  // A frozen pan is drawn with some room on both sides; a chart without gain still has a scale.
  constexpr double kLeastWidth_rad = 0.2;
  constexpr double kHeadroom = 1.12;
  const JointBox& box = input.result.box;
  const double width_rad = std::max(box.max[0] - box.min[0], kLeastWidth_rad);
  const double middle_rad = 0.5 * (box.min[0] + box.max[0]);
  double gain_max = std::max({1.0, input.result.view.gain, input.result.current.gain});
  for (const ViewGain& view : curve.view) gain_max = std::max(gain_max, view.gain);
  return {panel, middle_rad - 0.5 * width_rad, middle_rad + 0.5 * width_rad, kHeadroom * gain_max};
}

void draw_axes(Canvas& canvas, const GainChart& chart) {
  const Rectangle& panel = chart.panel;
  const Ticks gains = make_ticks(0.0, chart.gain_max, 8);
  for (const double gain : gains.values) {
    const double y = chart.to_page(chart.pan_min_rad, gain).y();
    canvas.stroke_open(Line{{panel.x, y}, {panel.right(), y}}, {style::kGridLine, 1.0});
    canvas.text({panel.x - 8.0, y + 4.0}, gains.label(gain), style::note(Anchor::right));
  }
  draw_axis_below(
      canvas, panel, make_ticks(chart.pan_min_rad, chart.pan_max_rad, 7),
      [&](double pan_rad) { return chart.to_page(pan_rad, 0.0).x(); }, "pan (rad)");
}

/// The area between two gains along the curve.
template <typename Lower, typename Upper>
Line band(const GainChart& chart, const GainCurve& curve, Lower lower, Upper upper) {
  Line area;
  const std::size_t n = curve.view.size();
  for (std::size_t i = 0; i < n; ++i) {
    area.push_back(chart.to_page(curve.pan_rad[i], lower(curve.view[i])));
  }
  for (std::size_t i = n; i-- > 0;) {
    area.push_back(chart.to_page(curve.pan_rad[i], upper(curve.view[i])));
  }
  return area;
}

void draw_curve(Canvas& canvas, const GainChart& chart, const GainCurve& curve) {
  const auto nothing = [](const ViewGain&) { return 0.0; };
  const auto from_unknown = [](const ViewGain& view) { return view.unknown_gain; };
  const auto total = [](const ViewGain& view) { return view.gain; };
  canvas.fill(band(chart, curve, nothing, from_unknown), style::kUnknownGain.with_alpha(0.7));
  canvas.fill(band(chart, curve, from_unknown, total), style::kOccupiedGain.with_alpha(0.7));
  Line line;
  for (std::size_t i = 0; i < curve.view.size(); ++i) {
    line.push_back(chart.to_page(curve.pan_rad[i], curve.view[i].gain));
  }
  canvas.stroke_open(line, {style::kInk, 1.3});
}

/// A view's pan and gain.
void draw_mark(Canvas& canvas, const GainChart& chart, double pan_rad, double gain,
               const Stroke& stroke, Colour disc) {
  const Eigen::Vector2d at = chart.to_page(pan_rad, gain);
  canvas.stroke_open(Line{{at.x(), chart.panel.y}, {at.x(), chart.panel.bottom()}}, stroke);
  canvas.disc(at, 5.0, disc, {stroke.colour, 2.0});
}

void draw_marks(Canvas& canvas, const GainChart& chart, const PlotInput& input) {
  const PlanResult& result = input.result;
  draw_mark(canvas, chart, result.request.joints.pan_rad, result.current.gain,
            style::current_stroke(), style::kPaper);
  draw_mark(canvas, chart, result.joints.pan_rad, result.view.gain, style::chosen_stroke(),
            style::kChosen);
}

void draw_candidates(Canvas& canvas, const GainChart& chart, const GainCurve& candidates) {
  for (std::size_t i = 0; i < candidates.view.size(); ++i) {
    canvas.disc(chart.to_page(candidates.pan_rad[i], candidates.view[i].gain), 3.0, style::kPaper,
                {style::kInk, 1.2});
  }
}

}  // namespace

void draw_gain(Canvas& canvas, const Rectangle& panel, const PlotInput& input) {
  const JointBox& box = input.result.box;
  const GainCurve curve = sample(input, evenly_spaced(box.min[0], box.max[0], kSamples));
  const GainChart chart = make_chart(panel, input, curve);
  draw_axes(canvas, chart);
  draw_curve(canvas, chart, curve);
  canvas.stroke_open(Line{{panel.x, panel.bottom()}, {panel.right(), panel.bottom()}},
                     {style::kMutedInk, 1.0});
  draw_candidates(canvas, chart, sample(input, input.candidate_pans_rad));
  draw_marks(canvas, chart, input);
}

}  // namespace nbvopt
