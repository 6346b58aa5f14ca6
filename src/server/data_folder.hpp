// The only folder whose files clients may name.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/descriptor.hpp"
#include "core/shared_bytes.hpp"

namespace nbvopt {

/// Paths are relative to the folder and stay in it: neither ".." nor links are followed, checked
/// while they are opened, so that nobody can exchange a folder in between.
class DataFolder {
 public:
  /// Clients may not write `kept_files`, wherever they are: the server's own.
  /// Throws InputError when there is no such folder.
  explicit DataFolder(const std::filesystem::path& folder,
                      std::vector<std::filesystem::path> kept_files = {});

  /// A file for reading. Throws RequestError: a path that leads out, a link, no such file.
  Descriptor open(const std::string& text) const;

  /// Writes a file atomically. Throws RequestError as above, of code DATA_LOSS where the disk is
  /// full or faulty, and InputError for what else keeps it from being written.
  void write(const std::string& text, const SharedBytes& bytes) const;

 private:
  /// The folder that holds the file of that path.
  Descriptor open_parent(const std::filesystem::path& path) const;

  Descriptor folder_;
  std::vector<std::filesystem::path> kept_files_;
};

}  // namespace nbvopt
