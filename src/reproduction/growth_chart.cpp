#include "reproduction/growth_chart.hpp"

#include <algorithm>
#include <array>

#include "plot/line_chart.hpp"
#include "plot/style.hpp"

namespace nbvopt {
namespace {

constexpr double kPixelsPerPoint = 2.0;
constexpr Rectangle kPanel{84.0, 44.0, 620.0, 260.0};
constexpr double kLegendX = 728.0;
constexpr double kLegendStep = 22.0;
constexpr double kPageWidth = 920.0;
constexpr double kPageHeight = 364.0;
constexpr int kSteps = 240;

/// Colours that differ without colour vision, too (Okabe and Ito), with dashes for a second round.
LineStyle line_style(std::size_t line) {
  constexpr std::array kColours{rgb(0x5F6B76), rgb(0xE69F00), rgb(0x56B4E9), rgb(0x0072B2),
                                rgb(0x009E73), rgb(0xCC79A7), rgb(0xD55E00)};
  const bool is_second_round = line / kColours.size() % 2 == 1;
  return {{kColours[line % kColours.size()], 2.0,
           is_second_round ? std::vector<double>{6.0, 4.0} : std::vector<double>{}}};
}

double information_at(const InformationGrowth& growth, double time_s) {
  const auto& points = growth.points();
  const auto after =
      std::ranges::upper_bound(points, time_s, {}, &InformationGrowth::Point::time_s);
  return after == points.begin() ? 0.0 : std::prev(after)->information;
}

double end_s(const GrowthSeries& series) {
  double end = 0.0;
  for (const InformationGrowth* growth : series.growths) {
    if (!growth->points().empty()) end = std::max(end, growth->points().back().time_s);
  }
  return end;
}

struct Spread {
  ChartLine mean;
  ChartBand band;
};

Spread spread_of(const GrowthSeries& series, double end_s, const LineStyle& style) {
  Spread spread{{.points = {}, .style = style},
                {.lower = {}, .upper = {}, .colour = style.stroke.colour.with_alpha(0.13)}};
  for (int step = 0; step <= kSteps; ++step) {
    const double time_s = end_s * step / kSteps;
    std::vector<double> known;
    double sum = 0.0;
    for (const InformationGrowth* growth : series.growths) {
      known.push_back(information_at(*growth, time_s));
      sum += known.back();
    }
    const auto [least, most] = std::ranges::minmax(known);
    spread.mean.points.emplace_back(time_s, sum / static_cast<double>(known.size()));
    spread.band.lower.emplace_back(time_s, least);
    spread.band.upper.emplace_back(time_s, most);
  }
  return spread;
}

}  // namespace

std::string growth_chart_png(const std::string& title, const std::vector<GrowthSeries>& series) {
  Canvas canvas(kPageWidth, kPageHeight, kPixelsPerPoint);
  canvas.text({kPanel.x, 28.0}, title, style::heading());
  double last_s = 1e-9;
  for (const GrowthSeries& one : series) last_s = std::max(last_s, end_s(one));
  std::vector<ChartLine> lines;
  std::vector<ChartBand> bands;
  double most = 1e-9;
  for (std::size_t i = 0; i < series.size(); ++i) {
    Spread spread = spread_of(series[i], end_s(series[i]), line_style(series[i].line));
    most = std::max(most, spread.band.upper.back().y());
    lines.push_back(std::move(spread.mean));
    bands.push_back(std::move(spread.band));
    const double y = kPanel.y + 12.0 + kLegendStep * static_cast<double>(i);
    draw_line_sample(canvas, {kLegendX, y - 4.0}, 26.0, lines.back().style);
    canvas.text({kLegendX + 34.0, y}, series[i].label, style::body());
  }
  draw_line_chart(canvas, kPanel,
                  {.min = 0.0,
                   .max = last_s,
                   .ticks = labelled(make_ticks(0.0, last_s, 8)),
                   .title = "time (s)"},
                  {.min = 0.0,
                   .max = most,
                   .ticks = labelled(make_ticks(0.0, most, 5)),
                   .title = "information (Eq. 11)"},
                  lines, bands);
  return canvas.png();
}

}  // namespace nbvopt
