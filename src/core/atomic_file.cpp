#include "core/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

#include "core/descriptor.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, const std::string& what) {
  throw InputError(path.string() + ": cannot be written: " + what);
}

std::string reason() { return std::generic_category().message(errno); }

/// Removes a file unless the caller keeps it.
class RemovedUnlessKept {
 public:
  explicit RemovedUnlessKept(const std::string& name) : name_(name) {}
  RemovedUnlessKept(const RemovedUnlessKept&) = delete;
  RemovedUnlessKept& operator=(const RemovedUnlessKept&) = delete;
  ~RemovedUnlessKept() {
    if (!is_kept_) ::unlink(name_.c_str());
  }
  void keep() { is_kept_ = true; }

 private:
  std::string name_;
  bool is_kept_ = false;
};

bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

void write_in_place(const fs::path& path, std::string_view bytes) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (!file.is_open() || !write_all(file.get(), bytes) || !file.close()) refuse(path, reason());
}

/// What a new file's permissions are: those of the file that it replaces, or the user's default.
mode_t permissions_for(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0) return status.st_mode & 07777;
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return 0666 & ~mask;
}

/// The file that `path` leads to, links followed. Refuses a folder, and a folder that is missing.
fs::path checked_target(const fs::path& path) {
  std::error_code ignored;
  const fs::path resolved = fs::weakly_canonical(path, ignored);
  const fs::path& target = resolved.empty() ? path : resolved;
  if (fs::is_directory(target, ignored)) refuse(path, "it is a folder");
  if (const fs::path folder = target.parent_path();
      !folder.empty() && !fs::is_directory(folder, ignored)) {
    refuse(path, "there is no folder '" + folder.string() + "'");
  }
  return target;
}

/// Opens a new file beside the target and gives its name.
int create_beside(const fs::path& path, const fs::path& target, std::string& temporary) {
  temporary = target.string() + ".XXXXXX";
  const int descriptor = ::mkostemp(temporary.data(), O_CLOEXEC);
  if (descriptor < 0) refuse(path, reason());
  return descriptor;
}

/// The new name, too, outlives a loss of power from here on. Not every file system can say so.
void sync_folder(const fs::path& target) {
  const fs::path folder = target.has_parent_path() ? target.parent_path() : ".";
  const Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (descriptor.is_open()) ::fsync(descriptor.get());
}

}  // namespace

void require_writable(const fs::path& path) {
  std::error_code ignored;
  if (fs::is_other(fs::status(path, ignored))) return;
  std::string temporary;
  const Descriptor file(create_beside(path, checked_target(path), temporary));
  const RemovedUnlessKept guard(temporary);
}

void write_file_atomically(const fs::path& path, std::string_view bytes) {
  std::error_code ignored;
  if (fs::is_other(fs::status(path, ignored))) return write_in_place(path, bytes);
  const fs::path target = checked_target(path);
  std::string temporary;
  Descriptor file(create_beside(path, target, temporary));
  RemovedUnlessKept guard(temporary);
  if (::fchmod(file.get(), permissions_for(target)) != 0 || !write_all(file.get(), bytes) ||
      ::fsync(file.get()) != 0 || !file.close() ||
      ::rename(temporary.c_str(), target.c_str()) != 0) {
    refuse(path, reason());
  }
  guard.keep();
  sync_folder(target);
}

}  // namespace nbvopt
