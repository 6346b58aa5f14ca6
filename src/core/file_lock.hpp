// A file that one process at a time holds: two servers must not share a socket or a snapshot, two
// studies no folder.
#pragma once

#include <filesystem>

#include "core/descriptor.hpp"

namespace nbvopt {

class FileLock {
 public:
  /// Takes the lock "<path>.lock"; it ends with the process, however that ends. Throws InputError
  /// when another process holds it or when it cannot be made; `use` says what that process does,
  /// such as "server uses this socket".
  FileLock(const std::filesystem::path& path, const char* use);

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  Descriptor file_;
};

}  // namespace nbvopt
