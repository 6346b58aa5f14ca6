#include "core/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <span>
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

/// What stands between a file's name and the random letters of a temporary one.
constexpr std::string_view kUnfinished = ".nbvopt-unfinished-";
constexpr const char* kBackup = ".bak";

[[noreturn]] void fail() { throw std::system_error(errno, std::generic_category()); }

/// A new file beside the one of that name, removed unless it takes that name.
class TemporaryFile {
 public:
  TemporaryFile(int folder, const std::string& name) : folder_(folder) {
    static std::atomic<std::uint64_t> count{0};
    do {
      temporary_ = name + std::string(kUnfinished) + std::to_string(::getpid()) + '-' +
                   std::to_string(count++);
      file_ = Descriptor(::openat(folder, temporary_.c_str(),
                                  O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666));
    } while (!file_.is_open() && errno == EEXIST);  // of a killed process with the same number
    if (!file_.is_open()) fail();
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (!temporary_.empty()) ::unlinkat(folder_, temporary_.c_str(), 0);
  }

  Descriptor& file() { return file_; }

  void rename_to(const std::string& name) {
    if (::renameat(folder_, temporary_.c_str(), folder_, name.c_str()) != 0) fail();
    temporary_.clear();
  }

 private:
  int folder_;
  std::string temporary_;
  Descriptor file_{-1};
};

/// Gives the file of that name, if there is one, the backup's name as well, by a second link that
/// is made beside and renamed. On a file system without links the file is moved there.
void keep_backup(int folder, const std::string& name) {
  const std::string backup = name + kBackup;
  const std::string link = backup + std::string(kUnfinished) + std::to_string(::getpid());
  ::unlinkat(folder, link.c_str(), 0);  // of a killed process with the same number
  const bool is_linked = ::linkat(folder, name.c_str(), folder, link.c_str(), 0) == 0;
  if (!is_linked && errno == ENOENT) return;
  if (::renameat(folder, (is_linked ? link : name).c_str(), folder, backup.c_str()) != 0) {
    const int reason = errno;
    if (is_linked) ::unlinkat(folder, link.c_str(), 0);
    errno = reason;
    fail();
  }
  // Renaming a link to another name of the same file does nothing, and leaves it.
  if (is_linked) ::unlinkat(folder, link.c_str(), 0);
}

/// What a file is to hold, piece by piece.
using Pieces = std::span<const std::string_view>;

bool write_all(int descriptor, Pieces pieces) {
  for (std::string_view bytes : pieces) {
    while (!bytes.empty()) {
      const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
  }
  return true;
}

void write_in_place(const fs::path& path, Pieces bytes) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (!file.is_open() || !write_all(file.get(), bytes) || !file.close()) fail();
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

/// The folder of a target, open.
Descriptor open_folder(const fs::path& target) {
  const fs::path folder = target.has_parent_path() ? target.parent_path() : ".";
  Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!descriptor.is_open()) fail();
  return descriptor;
}

/// Calls `write` and tells of its failure as of one of `path`.
template <typename Write>
void naming(const fs::path& path, const Write& write) {
  try {
    write();
  } catch (const std::system_error& error) {
    refuse(path, error.code().message());
  }
}

}  // namespace

void require_writable(const fs::path& path) {
  std::error_code ignored;
  if (fs::is_other(fs::status(path, ignored))) return;
  const fs::path target = checked_target(path);
  naming(path, [&] {
    const Descriptor folder = open_folder(target);
    const TemporaryFile file(folder.get(), target.filename().string());
  });
}

namespace {

enum class Replaced { is_removed, is_kept };

void write_at(int folder, const std::string& name, Pieces bytes, Replaced replaced_file) {
  TemporaryFile temporary(folder, name);
  Descriptor& file = temporary.file();
  struct stat replaced {};
  const bool replaces = ::fstatat(folder, name.c_str(), &replaced, AT_SYMLINK_NOFOLLOW) == 0;
  if (replaces && ::fchmod(file.get(), replaced.st_mode & 07777) != 0) fail();
  if (!write_all(file.get(), bytes) || ::fsync(file.get()) != 0 || !file.close()) fail();
  if (replaced_file == Replaced::is_kept) keep_backup(folder, name);
  temporary.rename_to(name);
  // The new name, too, outlives a loss of power from here on. Not every file system can say so.
  ::fsync(folder);
}

void write(const fs::path& path, Pieces bytes, Replaced replaced_file) {
  naming(path, [&] {
    std::error_code ignored;
    if (fs::is_other(fs::status(path, ignored))) return write_in_place(path, bytes);
    const fs::path target = checked_target(path);
    const Descriptor folder = open_folder(target);
    write_at(folder.get(), target.filename().string(), bytes, replaced_file);
  });
}

}  // namespace

void write_file_atomically_at(int folder, const std::string& name, Pieces pieces) {
  write_at(folder, name, pieces, Replaced::is_removed);
}

void write_file_atomically(const fs::path& path, std::string_view bytes) {
  write_file_atomically(path, Pieces(&bytes, 1));
}

void write_file_atomically(const fs::path& path, Pieces pieces) {
  write(path, pieces, Replaced::is_removed);
}

void write_file_with_backup(const fs::path& path, std::string_view bytes) {
  write(path, Pieces(&bytes, 1), Replaced::is_kept);
}

fs::path backup_of(const fs::path& path) { return checked_target(path) += kBackup; }

void remove_unfinished_files(const fs::path& path) {
  std::error_code ignored;
  const fs::path target = fs::weakly_canonical(path, ignored);
  const std::string stem = target.filename().string() + std::string(kUnfinished);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : ".";
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().filename().string().starts_with(stem)) fs::remove(entry.path(), ignored);
  }
}

}  // namespace nbvopt
