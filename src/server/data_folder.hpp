// The only folder whose files clients may name.
#pragma once

#include <filesystem>
#include <string>

#include "core/descriptor.hpp"

namespace nbvopt {

/// Paths are relative to the folder and stay in it: neither ".." nor links are followed, checked
/// while they are opened, so that nobody can exchange a folder in between.
class DataFolder {
 public:
  /// Clients may not write `kept_file`, wherever that is: the server's snapshot; empty: none.
  /// Throws InputError when there is no such folder.
  explicit DataFolder(const std::filesystem::path& folder, std::filesystem::path kept_file = {});

  /// A file for reading. Throws RequestError: a path that leads out, a link, no such file.
  Descriptor open(const std::string& path) const;

  /// Writes a file atomically. Throws RequestError as above, and InputError as
  /// write_file_atomically() does.
  void write(const std::string& path, std::string_view bytes) const;

 private:
  /// The folder that holds the file of that path.
  Descriptor open_parent(const std::filesystem::path& path) const;

  Descriptor folder_;
  std::filesystem::path kept_file_;
};

}  // namespace nbvopt
