// Hazards as a file, so that what one drive has taught is there for the next.
#pragma once

#include <filesystem>
#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "nbvopt/gain/hazard_table.hpp"

namespace nbvopt {

/// The contexts of HazardTable by name, in their order: such as
/// "unknown_floor_entry_beside_surface".
std::vector<std::string> hazard_context_names();

/// The table as JSON: `floor_map_m`, and in `contexts` hits and metres by name.
std::string hazards_json(const HazardTable& hazards);

/// Writes that atomically. Throws InputError that names the file when it cannot be written.
void write_hazards(const HazardTable& hazards, const std::filesystem::path& path);

/// Reads such a file, or the snapshot of a server, which keeps them in its header; contexts that it
/// leaves out keep what HazardTable has. Throws InputError that names file and key: no JSON, an
/// unknown key, hits or metres that are no numbers, negative, or without metres; and a map that
/// keeps none.
HazardTable read_hazards(const std::filesystem::path& path);

/// The same from text; `name` stands for the file in messages.
HazardTable parse_hazards(const std::string& text, const std::string& name);

/// The table as comment lines of a map's header, which other programs skip.
std::string hazards_comment(const HazardTable& hazards);

/// What such lines among the comments that a map begins with tell; none where there is no such
/// line. Throws as read_hazards() does.
std::optional<HazardTable> hazards_in_header(std::istream& map, const std::string& name);

}  // namespace nbvopt
