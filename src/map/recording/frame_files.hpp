// The files of a recording's frames.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nbvopt {

/// The files of a folder with that end of the name (any kind of scan where it is empty), in the
/// order of their numbers: 2 before 10. Throws InputError when there is no such folder or file.
std::vector<std::filesystem::path> frame_files(const std::filesystem::path& folder,
                                               std::string_view suffix);

/// The first of these files that is there; '*' at a name's start stands for anything. Throws
/// InputError that names them when there is none.
std::filesystem::path find_file(const std::filesystem::path& folder,
                                const std::vector<std::string_view>& names);

/// A file with its time.
struct TimedFile {
  std::filesystem::path file;
  std::optional<double> time_s;
};

/// The depth images of TUM's layout: those that depth.txt or an associations file of the recording
/// lists, with their times; else those in `depth`, whose names are their times.
std::vector<TimedFile> timed_files(const std::filesystem::path& recording,
                                   const std::vector<std::filesystem::path>& in_folder);

/// Whether one is a depth image, by its name.
bool is_depth_image(const std::filesystem::path& file);

/// A name without `suffix`.
std::string without_suffix(const std::filesystem::path& file, std::string_view suffix);

}  // namespace nbvopt
