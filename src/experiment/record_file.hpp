// A file of records, a JSON object a line, that grows and survives being torn.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "core/descriptor.hpp"
#include "core/json.hpp"

namespace nbvopt::experiment {

/// Calls visit(record) for every line of the file, which may be missing; a last line without an end
/// is left out. Throws InputError that names file and line of what is no JSON object, and of what
/// `visit` cannot read.
void for_each_record(const std::filesystem::path& path,
                     const std::function<void(const Json& record)>& visit);

/// Appends records. One process at a time may do so.
class RecordFile {
 public:
  /// Opens the file, or makes it. What a writer that was killed left of a last line is cut off.
  /// Throws InputError when it cannot be opened or written.
  explicit RecordFile(std::filesystem::path path);

  /// The record is in the file when this returns. Throws InputError when it cannot be written, such
  /// as on a full disk; the file then ends with the record before.
  void append(const Json& record);

 private:
  [[noreturn]] void fail(int error) const;

  std::filesystem::path path_;
  Descriptor file_;
  std::int64_t size_ = 0;  ///< up to the end of the last whole line
};

}  // namespace nbvopt::experiment
