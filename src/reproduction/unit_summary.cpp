#include "reproduction/unit_summary.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>

#include "core/text_file.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

using nlohmann::json;

/// Reads a file's fields; whatever is wrong with them is the file's fault.
template <class Read>
auto read_summary(const std::filesystem::path& path, const Read& read) {
  const std::string text = read_text_file(path);
  try {
    return read(json::parse(text));
  } catch (const json::exception& error) {
    throw InputError(path.string() + ": is not a whole summary: " + error.what());
  }
}

}  // namespace

EpisodeFigures read_episode_summary(const std::filesystem::path& path) {
  return read_summary(path, [](const json& fields) {
    const json& prediction = fields.at("prediction");
    const json& pooled = prediction.at("pooled");
    return EpisodeFigures{
        .duration_s = fields.at("duration_s").get<double>(),
        .voxels = fields.at("voxels").get<double>(),
        .information = fields.at("information").get<double>(),
        .voxels_as_paper_counts = fields.at("voxels_as_paper_counts").get<double>(),
        .information_as_paper_counts = fields.at("information_as_paper_counts").get<double>(),
        .prediction = {.steps = prediction.at("steps").get<std::uint64_t>(),
                       .sum_x = pooled.at("sum_x").get<double>(),
                       .sum_y = pooled.at("sum_y").get<double>(),
                       .sum_xx = pooled.at("sum_xx").get<double>(),
                       .sum_yy = pooled.at("sum_yy").get<double>(),
                       .sum_xy = pooled.at("sum_xy").get<double>()}};
  });
}

ExplorationFigures read_exploration_summary(const std::filesystem::path& path) {
  return read_summary(path, [](const json& fields) {
    return ExplorationFigures{.status = fields.at("status").get<std::string>(),
                              .duration_s = fields.at("duration_s").get<double>(),
                              .length_m = fields.at("length_m").get<double>()};
  });
}

}  // namespace nbvopt
