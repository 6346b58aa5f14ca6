#include "cli/view.hpp"

#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "cli/map_input.hpp"
#include "cli/options/arguments.hpp"
#include "cli/options/view_arguments.hpp"
#include "cli/terminal/output.hpp"
#include "core/atomic_file.hpp"
#include "core/number.hpp"
#include "core/text_file.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/planner/view_planner.hpp"
#include "web/map_page.hpp"

namespace nbvopt {
namespace {

struct ViewOptions {
  MapInput map;
  std::string out_file;
  std::string answer_file;
  std::string episode_file;
  std::vector<double> box_m;  ///< two corners; empty: all of the map
  ViewArguments view;
};

std::optional<KeyBox> key_box(const std::vector<double>& corners_m, const Lattice& lattice) {
  if (corners_m.empty()) return std::nullopt;
  const Eigen::Array3d a_m(corners_m[0], corners_m[1], corners_m[2]);
  const Eigen::Array3d b_m(corners_m[3], corners_m[4], corners_m[5]);
  return KeyBox{lattice.key(a_m.min(b_m).matrix()), lattice.key(a_m.max(b_m).matrix())};
}

/// Tells when the answer is to another map, robot or gain than those that it is shown with.
void compare(const AnswerFile& answer, const ViewPlanner& planner, const std::string& file) {
  const double gain =
      planner.evaluate(T_map_sensor(answer.request, planner.mast(), answer.joints)).gain;
  if (std::abs(gain - answer.gain) <= 1e-6 * std::max(1.0, std::abs(gain))) return;
  print_message("warning: " + file + ": its view gains " + decimal(answer.gain, 1) +
                ", here it gains " + decimal(gain, 1) +
                ": give the map, the robot and the gain that the answer is for");
}

void add_answer(MapPage& page, const ViewOptions& options, UncertaintyMap map) {
  const AnswerFile answer =
      parse_answer_file(read_text_file(options.answer_file), options.answer_file);
  ViewPlanner planner = ViewPlanner::with_given_sensor(std::move(map), make_robot(options.view),
                                                       options.view.evaluator);
  if (const auto hazards = given_hazards(options.view)) planner.set_hazards(*hazards);
  compare(answer, planner, options.answer_file);
  page.add_answer(answer, planner);
}

void run_view(const ViewOptions& options) {
  require_writable(options.out_file);  // a page that could not be kept would be made in vain
  const ThreadLimit thread_limit(options.view);
  UncertaintyMap map = read_map_input(options.map);
  MapPage page(options.map.file, map, key_box(options.box_m, map.lattice()));
  if (!options.episode_file.empty()) {
    page.add_episode(parse_episode_file(read_text_file(options.episode_file), options.episode_file),
                     *VoxelGrid::lazy(map), make_robot(options.view));
  }
  if (!options.answer_file.empty()) add_answer(page, options, std::move(map));
  const std::string html = page.html();
  write_file_atomically(options.out_file, html);
  print_answer(options.out_file + ": " + std::to_string(page.faces()) + " faces in " +
               std::to_string(page.rectangles()) + " rectangles, " +
               decimal(1e-6 * static_cast<double>(html.size()), 1) + " MB\n");
}

}  // namespace

void set_up_view(CLI::App& app) {
  auto options = std::make_shared<ViewOptions>();
  CLI::App* view = app.add_subcommand("view", "A map and a plan as a page for a browser");
  add_map_input(*view, "MAP", options->map);
  view->add_option("-o,--out", options->out_file, "the page: one file that needs no network")
      ->type_name("OUT.html")
      ->required();
  view->add_option("--answer", options->answer_file,
                   "what nbvopt query --json wrote: show the robot, its view and the chosen one")
      ->type_name("FILE");
  view->add_option("--episode", options->episode_file,
                   "what nbvopt simulate --metrics wrote while it made the map: show the drive")
      ->type_name("FILE");
  view->add_option_function<std::string>(
          "--box",
          [options](const std::string& text) {
            options->box_m = numbers_argument("--box", text, {6}, "X0,Y0,Z0,X1,Y1,Z1");
          },
          "show the part of the map between two corners, metres [all of it]")
      ->type_name("X0,Y0,Z0,X1,Y1,Z1");
  add_view_arguments(*view, options->view);
  view->footer(
      "The robot, the evaluator and the gain are those that the answer was asked with,\n"
      "the robot of an episode the one that drove it.\n"
      "Example: nbvopt view map.ot --answer answer.json -o view.html");
  view->callback([options] { run_view(*options); });
}

}  // namespace nbvopt
