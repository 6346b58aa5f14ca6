#include "server/file_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "nbvopt/core/error.hpp"

namespace nbvopt {

FileLock::FileLock(const std::filesystem::path& path, const char* use)
    : file_(::open((path.string() + ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600)) {
  const std::string name = path.string();
  if (!file_.is_open()) {
    throw InputError(name + ".lock: cannot be made: " + std::generic_category().message(errno));
  }
  if (::flock(file_.get(), LOCK_EX | LOCK_NB) != 0) {
    throw InputError(name + ": another server uses this " + use + ", stop it or name another");
  }
}

}  // namespace nbvopt
