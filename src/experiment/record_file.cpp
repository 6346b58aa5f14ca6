#include "experiment/record_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

#include "experiment/line_channel.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt::experiment {
namespace {

/// Where the last line that has an end ends.
std::int64_t end_of_last_line(int file) {
  std::array<char, 65536> block;
  std::int64_t end = ::lseek(file, 0, SEEK_END);
  while (end > 0) {
    const std::int64_t begin = std::max<std::int64_t>(0, end - std::int64_t{block.size()});
    const ssize_t count = ::pread(file, block.data(), static_cast<std::size_t>(end - begin), begin);
    if (count <= 0) return -1;
    for (ssize_t i = count; i > 0; --i) {
      if (block[static_cast<std::size_t>(i - 1)] == '\n') return begin + i;
    }
    end = begin;
  }
  return end;
}

}  // namespace

void for_each_record(const std::filesystem::path& path,
                     const std::function<void(const Json& record)>& visit) {
  std::ifstream in(path, std::ios::binary);
  if (!in && !std::filesystem::exists(path)) return;
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    if (in.eof()) return;  // torn
    try {
      visit(Json::parse(line));
    } catch (const Json::exception& error) {
      throw InputError(path.string() + ": line " + std::to_string(number) +
                       ": is no record: " + error.what());
    } catch (const InputError& error) {
      throw InputError(path.string() + ": line " + std::to_string(number) + ": " + error.what());
    }
  }
  if (in.bad() || !in.eof()) throw InputError(path.string() + ": cannot be read");
}

RecordFile::RecordFile(std::filesystem::path path)
    : path_(std::move(path)),
      file_(::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666)) {
  if (!file_.is_open()) fail(errno);
  size_ = end_of_last_line(file_.get());
  if (size_ < 0 || ::ftruncate(file_.get(), size_) != 0) fail(errno);
}

void RecordFile::append(const Json& record) {
  const std::string line = record.dump(-1, ' ', false, Json::error_handler_t::replace);
  try {
    write_line(file_.get(), line);
  } catch (const std::system_error& error) {
    [[maybe_unused]] const int cut = ::ftruncate(file_.get(), size_);  // else the next run does it
    fail(error.code().value());
  }
  size_ += static_cast<std::int64_t>(line.size()) + 1;
}

void RecordFile::fail(int error) const {
  throw InputError(path_.string() +
                   ": cannot be written: " + std::generic_category().message(error));
}

}  // namespace nbvopt::experiment
