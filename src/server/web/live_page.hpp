// The page of a server's map: what it shows, as it changes.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "core/json.hpp"
#include "core/shared_bytes.hpp"
#include "server/web/live_gains.hpp"
#include "server/web/live_sources.hpp"
#include "server/web/making_pace.hpp"
#include "web/growing_surface.hpp"

namespace nbvopt {

/// What there is to show: equal where nothing is new.
struct LiveVersion {
  std::uint64_t map = 0;
  std::uint64_t plan = 0;
  bool operator==(const LiveVersion&) const = default;
};

/// Safe to share between threads.
class LivePage {
 public:
  /// Surfaces are made at least `least_pause` apart.
  explicit LivePage(LiveSources sources,
                    std::chrono::milliseconds least_pause = std::chrono::milliseconds(100));

  /// The page itself, which asks for the rest.
  const std::shared_ptr<const std::string>& html() const { return html_; }

  LiveVersion newest() const;

  /// One line of JSON: `map`, which names the newest version; `map_version`; `plan`, its number;
  /// `answer`, the newest plan, where there is one.
  std::string state() const;

  /// JSON for a reader that shows the map of the id `since` (any other text: none): `id`, that of
  /// the map which this makes; `map` as map_json() has it; `bricks`, the members of
  /// GrowingSurface::members() that changed; `is_whole`, where those are all there are. Surfaces
  /// are made when somebody asks, once for all who do, at the pace of MakingPace: an older map is
  /// given meanwhile. Where the map is too large, `error` says so instead.
  SharedBytes map(const std::string& since = "");

  /// See LiveGains::newest().
  std::shared_ptr<const std::string> gains() { return gains_.newest(); }

  /// The server ends: what takes long is left out.
  void end() const { gains_.end(); }

  /// Somebody who follows the page. While there is one, the last grid is kept to compare the next
  /// with; the page must outlive it.
  class Reader {
   public:
    explicit Reader(LivePage& page) : page_(page) { ++page_.readers_; }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
    ~Reader() { page_.end_reader(); }

   private:
    LivePage& page_;
  };

 private:
  std::string id_of(std::uint64_t map_version) const;
  /// The version of such an id; none of another server's.
  std::optional<std::uint64_t> version_of(std::string_view id) const;
  void keep_up();
  void end_reader();

  const LiveSources sources_;
  std::shared_ptr<const std::string> html_;

  LiveGains gains_;
  std::atomic<int> readers_{0};

  std::mutex making_;  ///< of what follows; held while surfaces are made
  GrowingSurface surface_;
  Json map_json_;
  MakingPace pace_;
};

}  // namespace nbvopt
