#include "server/data_folder.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "core/atomic_file.hpp"
#include "nbvopt/core/error.hpp"
#include "server/call_status.hpp"

namespace nbvopt {
namespace {

namespace fs = std::filesystem;

/// The path, checked as text. Throws RequestError.
fs::path checked(const std::string& text) {
  fs::path path(text);
  const auto refuse = [&text](const char* why) {
    throw RequestError(grpc::StatusCode::PERMISSION_DENIED, "'" + text + "': " + why);
  };
  if (text.find('\0') != std::string::npos) refuse("a path has no zero byte");
  if (path.is_absolute()) refuse("give a path relative to the server's data folder");
  for (const fs::path& part : path) {
    if (part == "..") refuse("'..' is not allowed: paths stay in the server's data folder");
  }
  if (!path.has_filename() || path.filename() == ".") {
    throw RequestError(grpc::StatusCode::INVALID_ARGUMENT, "'" + text + "': name a file");
  }
  return path;
}

[[noreturn]] void refuse_to_open(const fs::path& path) {
  const int error = errno;
  const std::string name = "'" + path.string() + "': ";
  if (error == ELOOP) {
    throw RequestError(grpc::StatusCode::PERMISSION_DENIED, name + "links are not followed");
  }
  const auto code =
      error == ENOENT ? grpc::StatusCode::NOT_FOUND : grpc::StatusCode::INVALID_ARGUMENT;
  throw RequestError(code, name + std::generic_category().message(error));
}

bool is_link(int folder, const char* name) {
  struct stat status {};
  return ::fstatat(folder, name, &status, AT_SYMLINK_NOFOLLOW) == 0 && S_ISLNK(status.st_mode);
}

/// Whether the request was right and the disk is to blame.
bool is_of_disk(const std::error_code& error) {
  return error == std::errc::no_space_on_device || error == std::errc::file_too_large ||
         error == std::errc::io_error || error.value() == EDQUOT;
}

}  // namespace

DataFolder::DataFolder(const fs::path& folder, std::vector<fs::path> kept_files)
    : folder_(::open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC)),
      kept_files_(std::move(kept_files)) {
  if (folder_.is_open()) return;
  throw InputError(folder.string() +
                   ": cannot be the data folder: " + std::generic_category().message(errno));
}

Descriptor DataFolder::open_parent(const fs::path& path) const {
  Descriptor folder(::openat(folder_.get(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  for (const fs::path& part : path.parent_path()) {
    const bool leads_out = is_link(folder.get(), part.c_str());
    Descriptor next(
        ::openat(folder.get(), part.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
    if (leads_out) errno = ELOOP;
    if (leads_out || !next.is_open()) refuse_to_open(path);
    folder = std::move(next);
  }
  return folder;
}

Descriptor DataFolder::open(const std::string& text) const {
  const fs::path path = checked(text);
  const Descriptor parent = open_parent(path);
  // Without waiting for the writer of a pipe.
  Descriptor file(::openat(parent.get(), path.filename().c_str(),
                           O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (!file.is_open()) refuse_to_open(path);
  struct stat status {};
  if (::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode)) {
    throw RequestError(grpc::StatusCode::INVALID_ARGUMENT, "'" + text + "': not a file");
  }
  return file;
}

void DataFolder::write(const std::string& text, const SharedBytes& bytes) const {
  const fs::path path = checked(text);
  const Descriptor parent = open_parent(path);
  if (is_link(parent.get(), path.filename().c_str())) {
    errno = ELOOP;
    refuse_to_open(path);
  }
  const std::string name = path.filename().string();
  struct stat target {};
  const bool is_there = ::fstatat(parent.get(), name.c_str(), &target, AT_SYMLINK_NOFOLLOW) == 0;
  if (is_there && !S_ISREG(target.st_mode)) {
    throw RequestError(grpc::StatusCode::INVALID_ARGUMENT, "'" + text + "': not a file");
  }
  for (const fs::path& kept_file : kept_files_) {
    struct stat kept {};
    if (is_there && ::stat(kept_file.c_str(), &kept) == 0 && kept.st_dev == target.st_dev &&
        kept.st_ino == target.st_ino) {
      throw RequestError(grpc::StatusCode::PERMISSION_DENIED,
                         "'" + text + "': this is the server's own file, name another");
    }
  }
  try {
    write_file_atomically_at(parent.get(), name, bytes.views());
  } catch (const std::system_error& error) {
    const std::string message = "'" + text + "': cannot be written: " + error.code().message();
    if (is_of_disk(error.code())) throw RequestError(grpc::StatusCode::DATA_LOSS, message);
    throw InputError(message);
  }
}

}  // namespace nbvopt
