// Rosbags of format 2.0, read from their start to their end.
//
// Their index is not looked at: a bag whose recorder was not closed is read as well, and no
// position that the file claims is believed. rosbag_storage believes them, and crashes on bags of
// which a byte is wrong.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace nbvopt {

/// A topic of a bag, as one of its publishers had it.
struct BagConnection {
  std::string topic;
  std::string type;  ///< such as sensor_msgs/PointCloud2
};

/// Where a message stands: the record of the file, and within its chunk where it is in one.
struct BagPosition {
  std::uint64_t record = 0;
  std::uint64_t in_chunk = 0;
};

class BagFile {
 public:
  /// Throws InputError that says what the file is, where it is no bag of format 2.0, or encrypted.
  explicit BagFile(const std::filesystem::path& path);

  /// Calls visit(connection, message's bytes, where) for each message in the file's order. The
  /// bytes are valid until it returns. Throws InputError, with the place, where the bag is
  /// damaged or truncated.
  using Visit = std::function<void(const BagConnection& connection, std::string_view message,
                                   const BagPosition& where)>;
  void for_each_message(const Visit& visit);

  /// The bytes of a message that for_each_message() has shown, valid until the next call.
  std::string_view message_at(const BagPosition& where);

 private:
  struct Record;

  std::string_view read_bytes(std::uint64_t at, std::uint64_t count, std::string& into);
  Record read_record(std::uint64_t at);
  Record record_in(std::string_view bytes, std::uint64_t at) const;
  void take_record(const Record& record, const BagPosition& where, const Visit& visit);
  const std::string& chunk_at(std::uint64_t at, const Record& record);
  [[noreturn]] void refuse(std::uint64_t at, const std::string& what) const;

  std::string name_;
  std::ifstream in_;
  std::uint64_t size_ = 0;
  std::uint64_t first_record_ = 0;
  std::map<std::uint32_t, BagConnection> connections_;
  std::string header_bytes_, data_bytes_;
  std::string chunk_;           ///< unpacked
  std::uint64_t chunk_at_ = 0;  ///< the record that it is of; 0: none
};

}  // namespace nbvopt
