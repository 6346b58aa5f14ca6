#include "core/file_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "nbvopt/core/error.hpp"

namespace nbvopt {

namespace {

/// Whatever link leads to the file, its lock is the same.
std::filesystem::path lock_path(const std::filesystem::path& path) {
  std::error_code ignored;
  const std::filesystem::path resolved = std::filesystem::weakly_canonical(path, ignored);
  return (resolved.empty() ? path : resolved).string() + ".lock";
}

}  // namespace

FileLock::FileLock(const std::filesystem::path& path, const char* use)
    : path_(lock_path(path)),
      file_(::open(path_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0600)) {
  const std::string name = path.string();
  if (!file_.is_open()) {
    throw InputError(name + ".lock: cannot be made: " + std::generic_category().message(errno));
  }
  if (::flock(file_.get(), LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK) {
      throw InputError(path_.string() +
                       ": cannot be locked: " + std::generic_category().message(errno));
    }
    throw InputError(name + ": another " + use + ", stop it or name another");
  }
}

}  // namespace nbvopt
