#include "web/map_page.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include "web/answer_json.hpp"
#include "web/first_captures.hpp"
#include "web/packed.hpp"
#include "web/view_gains.hpp"

namespace nbvopt {
namespace {

/// Two bytes a face: the first capture that saw its voxel, the last number where none did.
std::string packed_captures(const FaceSet& set,
                            const std::unordered_map<std::uint64_t, std::uint16_t>& first) {
  constexpr std::uint16_t kNever = 0xFFFF;
  std::vector<std::uint16_t> captures;
  captures.reserve(set.faces);
  for (const FaceRectangle& rectangle : set.rectangles) {
    for_each_face(rectangle, [&](VoxelKey key) {
      const auto found = first.find(packed(key));
      captures.push_back(found == first.end() ? kNever : found->second);
    });
  }
  return packed_array(captures);
}

}  // namespace

Json map_json(const std::string& name, const Lattice& lattice, bool carries_uncertainty,
              const MapCounts& counts) {
  return {{"name", name},
          {"resolution_m", lattice.resolution_m()},
          {"key_of_origin", Lattice::kKeyOfOrigin},
          {"carries_uncertainty", carries_uncertainty},
          {"occupied_voxels", counts.occupied_voxels},
          {"free_voxels", counts.free_voxels},
          {"information", counts.information}};
}

MapPage::MapPage(const std::string& name, const UncertaintyMap& map,
                 const std::optional<KeyBox>& box)
    : name_(name), mesh_(surface_mesh(map, box)) {
  data_["map"] = map_json(name, map.lattice(), map.carries_uncertainty(), map.counts());
  const auto add = [&](const std::string& id, const FaceSet& set) {
    const auto* values = reinterpret_cast<const char*>(set.values.data());
    blocks_.push_back({id, packed_rectangles(set.rectangles)});
    blocks_.push_back({id + "-values", packed_bytes({values, set.values.size()})});
  };
  add("seen", mesh_.seen);
  add("backs", mesh_.backs);
  add("frontier", mesh_.frontier);
}

void MapPage::add_answer(const AnswerFile& answer, const ViewPlanner& planner) {
  data_["camera"] = camera_json(planner.robot().sensor);
  data_["mast"] = mast_json(planner.robot().mast);
  data_["answer"] = answer_json(answer, planner.mast());
  ViewGains gains = view_gains(answer, planner);
  data_.update(gains.data);
  std::ranges::move(gains.blocks, std::back_inserter(blocks_));
}

void MapPage::add_episode(const std::vector<EpisodeCapture>& captures, const VoxelGrid& grid,
                          const Robot& robot) {
  const Mast mast(robot.mast);
  std::vector<Transform> poses_T_map_sensor;
  std::vector<double> numbers;
  for (const EpisodeCapture& capture : captures) {
    const Transform T_map_sensor = capture.T_map_base * mast.T_base_sensor(capture.joints);
    poses_T_map_sensor.push_back(T_map_sensor);
    numbers.insert(numbers.end(), {capture.time_s, capture.information, capture.predicted_gain,
                                   capture.realised_gain, capture.joints.height_m});
    for (const Transform& pose : {capture.T_map_base, T_map_sensor}) {
      numbers.insert(numbers.end(), pose.matrix().data(), pose.matrix().data() + 16);
    }
  }
  data_["camera"] = camera_json(robot.sensor);
  data_["mast"] = mast_json(robot.mast);
  data_["episode"] = {{"captures", captures.size()}};
  blocks_.push_back({"captures", packed_numbers(numbers)});
  const auto first = first_captures(grid, robot.sensor, poses_T_map_sensor);
  for (const auto& [id, set] : {std::pair{"seen", &mesh_.seen}, std::pair{"backs", &mesh_.backs}}) {
    blocks_.push_back({std::string(id) + "-captures", packed_captures(*set, first)});
  }
}

std::string MapPage::html() const { return page_html(name_, data_, blocks_); }

}  // namespace nbvopt
