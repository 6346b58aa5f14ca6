// Actors of SDF worlds: people.
#pragma once

#include "nbvopt/sim/people.hpp"
#include "sim/world/sdf_frames.hpp"
#include "sim/world/sdf_xml.hpp"

namespace nbvopt {

/// An <actor> that stands in those frames, of which only the way counts: along the waypoints of its
/// <script>, which are in the map; else as libActorPlugin.so has it; else it stands. Throws
/// InputError for a value that cannot be read, a <trajectory> without waypoints, and a plugin that
/// is not known where nothing else says how it walks.
Person actor_of(const SdfElement& actor, SdfFrames& frames);

}  // namespace nbvopt
