// Whatever messages a client sends, in whatever order, the server's request path answers or refuses
// each, and its map stays one that can be planned on.
//
// An input is a sequence of calls: a byte for the method, two for the length of the message
// (little-endian), the message.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <span>

#include "nbvopt/core/error.hpp"
#include "server/request_handler.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt {
namespace {

constexpr ServerLimits kTight{.max_scan_points = 2000,
                              .max_views = 20,
                              .max_map_extent_m = 15.0,
                              .min_resolution_m = 0.1,
                              .max_map_mib = 20,
                              .max_compute_ms = 2.0};

/// A camera of few rays and a short range: many inputs a second.
Robot small_robot() {
  Robot robot;
  robot.sensor.horizontal_rays = 8;
  robot.sensor.vertical_rays = 6;
  robot.sensor.range_max_m = 1.5;
  return robot;
}

template <typename Message, typename Call>
void call(std::span<const std::uint8_t> bytes, const Call& handle) {
  Message message;
  if (!message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) return;
  try {
    handle(message);
  } catch (const Error&) {  // refused
  }
}

void call_method(RequestHandler& handler, std::uint8_t method,
                 std::span<const std::uint8_t> bytes) {
  const auto now = StopRule::Clock::now();
  switch (method % 8) {
    case 0:
      return call<v1::PlanRequest>(bytes, [&](const auto& m) { handler.plan(m, now, {}); });
    case 1:
      return call<v1::EvaluateRequest>(bytes, [&](const auto& m) { handler.evaluate(m, now, {}); });
    case 2:
      return call<v1::InsertScanRequest>(bytes, [&](const auto& m) { handler.insert_scan(m); });
    case 3:
      return call<v1::LoadMapRequest>(bytes, [&](const auto& m) { handler.load_map(m); });
    case 4:
      return call<v1::SaveMapRequest>(bytes, [&](const auto& m) { handler.save_map(m); });
    case 5:
      return call<v1::GetMapRequest>(bytes, [&](const auto& m) { handler.get_map(m); });
    case 6:
      return call<v1::ClearMapRequest>(bytes, [&](const auto& m) { handler.clear_map(m); });
    default:
      return call<v1::GetStatusRequest>(bytes, [&](const auto& m) { handler.status(m); });
  }
}

}  // namespace
}  // namespace nbvopt

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nbvopt;
  static const test::TemporaryFolder folder;
  static const DataFolder files(folder.path());
  for (const auto& file : std::filesystem::directory_iterator(folder.path())) {
    std::filesystem::remove_all(file);  // of the input before
  }
  MapStore store(small_robot(), kTight, UncertaintyMap(0.1), 1);
  RequestHandler handler(store, nullptr, &files, kTight);

  std::span<const std::uint8_t> left(data, size);
  constexpr std::size_t kHead = 3;
  while (left.size() >= kHead) {
    const std::size_t length = std::min<std::size_t>(left[1] | left[2] << 8, left.size() - kHead);
    call_method(handler, left[0], left.subspan(kHead, length));
    left = left.subspan(kHead + length);
  }
  const ViewGain gain = store.published()->evaluate(Transform::Identity());
  if (!(gain.gain >= 0.0)) std::abort();
  return 0;
}
