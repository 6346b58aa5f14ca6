// An episode along a course that may react to what it learns.
#pragma once

#include <functional>

#include "nbvopt/sim/episode.hpp"
#include "sim/base_course.hpp"

namespace nbvopt {

/// As run_episode() along a recorded drive. After each planned capture the course is settled up to
/// the next one; what it has settled in the end, replayed with the same options, gives the same
/// map. Only a recorded course can be followed by a base that errs about its pose.
EpisodeSummary run_episode_along(const Scene& scene, BaseCourse& course, const CameraMode& mode,
                                 const EpisodeOptions& options, UncertaintyMap& map,
                                 const std::function<void(const Capture&)>& observe);

}  // namespace nbvopt
