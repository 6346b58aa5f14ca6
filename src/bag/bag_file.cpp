#include "bag/bag_file.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "bag/unpack.hpp"
#include "core/input_file.hpp"
#include "map/byte_reader.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

constexpr std::string_view kMagic = "#ROSBAG V2.0\n";

/// The `op` of a record's header.
enum class Op : std::uint8_t {
  message = 2,
  bag = 3,
  index = 4,
  chunk = 5,
  chunk_info = 6,
  connection = 7
};

constexpr std::uint64_t kMostChunkBytes = std::uint64_t{1} << 30;
constexpr std::uint64_t kMostHeaderBytes = std::uint64_t{1} << 24;

/// The fields of a header, "name=value" each; none where it is damaged.
std::optional<std::map<std::string, std::string_view>> parse_fields(std::string_view header) {
  std::map<std::string, std::string_view> fields;
  while (!header.empty()) {
    if (header.size() < sizeof(std::uint32_t)) return std::nullopt;
    const auto length = number_at<std::uint32_t>(header.data());
    header.remove_prefix(sizeof(std::uint32_t));
    if (length > header.size()) return std::nullopt;
    const std::string_view field = header.substr(0, length);
    header.remove_prefix(length);
    const std::size_t equals = field.find('=');
    if (equals == std::string_view::npos) return std::nullopt;
    fields.emplace(field.substr(0, equals), field.substr(equals + 1));
  }
  return fields;
}

/// What a file that is no bag of format 2.0 is, and what to do about it.
std::string other_file(std::string_view start) {
  if (start.starts_with("#ROSBAG V")) {
    return "is a bag of an older format, which `rosbag fix` makes a new one";
  }
  if (start.starts_with("\x89MCAP0\r\n")) {
    return "is an MCAP file, of which bags are read alone: convert it to a rosbag of ROS 1";
  }
  if (start.starts_with("SQLite format 3")) {
    return "is a recording of ROS 2: convert it to a rosbag of ROS 1";
  }
  return "is no rosbag, which begins with '#ROSBAG V2.0'";
}

}  // namespace

/// A record of a file or of a chunk. The views hold until the next one is read.
struct BagFile::Record {
  std::map<std::string, std::string_view> fields;
  std::string_view data;
  std::uint64_t bytes = 0;  ///< of all of it

  Op op() const {
    const auto found = fields.find("op");
    return found == fields.end() || found->second.size() != 1
               ? Op{}
               : static_cast<Op>(found->second.front());
  }
  template <class Number>
  std::optional<Number> number(const std::string& name) const {
    const auto found = fields.find(name);
    if (found == fields.end() || found->second.size() != sizeof(Number)) return std::nullopt;
    return number_at<Number>(found->second.data());
  }
  std::string text(const std::string& name) const {
    const auto found = fields.find(name);
    return found == fields.end() ? std::string() : std::string(found->second);
  }
};

BagFile::BagFile(const std::filesystem::path& path)
    : name_(path.string()), in_(open_input_file(path)) {
  in_.seekg(0, std::ios::end);
  size_ = static_cast<std::uint64_t>(std::max<std::streamoff>(in_.tellg(), 0));
  constexpr std::uint64_t kStart = 16;
  const std::string_view start = read_bytes(0, std::min(kStart, size_), data_bytes_);
  if (!start.starts_with(kMagic)) throw InputError(name_ + ": " + other_file(start));
  first_record_ = kMagic.size();
  const Record header = read_record(first_record_);
  if (header.op() != Op::bag) refuse(first_record_, "is not the bag's header");
  if (!header.text("encryptor").empty()) {
    throw InputError(name_ + ": is encrypted, by " + header.text("encryptor"));
  }
}

void BagFile::refuse(std::uint64_t at, const std::string& what) const {
  throw InputError(name_ + ": the record at byte " + std::to_string(at) + ' ' + what);
}

std::string_view BagFile::read_bytes(std::uint64_t at, std::uint64_t count, std::string& into) {
  if (at > size_ || count > size_ - at) {
    throw InputError(name_ + ": ends within a record, at byte " + std::to_string(size_) +
                     ", it is truncated: `rosbag reindex` keeps what is whole");
  }
  into.resize(static_cast<std::size_t>(count));
  in_.clear();
  in_.seekg(static_cast<std::streamoff>(at));
  in_.read(into.data(), static_cast<std::streamsize>(count));
  if (!in_) throw InputError(name_ + ": cannot be read at byte " + std::to_string(at));
  return into;
}

BagFile::Record BagFile::read_record(std::uint64_t at) {
  const auto length_at = [&](std::uint64_t place) {
    std::string bytes;
    return std::uint64_t{
        number_at<std::uint32_t>(read_bytes(place, sizeof(std::uint32_t), bytes).data())};
  };
  Record record;
  const std::uint64_t header_bytes = length_at(at);
  if (header_bytes > kMostHeaderBytes) refuse(at, "has a header that no record has");
  const std::uint64_t header_at = at + sizeof(std::uint32_t);
  auto fields = parse_fields(read_bytes(header_at, header_bytes, header_bytes_));
  if (!fields) refuse(at, "has a damaged header");
  record.fields = std::move(*fields);
  const std::uint64_t data_at = header_at + header_bytes + sizeof(std::uint32_t);
  const std::uint64_t data_bytes = length_at(data_at - sizeof(std::uint32_t));
  record.data = read_bytes(data_at, data_bytes, data_bytes_);
  record.bytes = data_at + data_bytes - at;
  return record;
}

/// The same from a chunk that was unpacked.
BagFile::Record BagFile::record_in(std::string_view bytes, std::uint64_t at) const {
  std::uint64_t place = at;
  const auto next = [&]() -> std::string_view {
    constexpr std::uint64_t kLength = sizeof(std::uint32_t);
    if (place > bytes.size() || bytes.size() - place < kLength) {
      refuse(chunk_at_, "is a chunk that ends too soon");
    }
    const std::uint64_t length = number_at<std::uint32_t>(bytes.data() + place);
    if (bytes.size() - place - kLength < length) refuse(chunk_at_, "is a chunk that ends too soon");
    const std::string_view part = bytes.substr(place + kLength, length);
    place += kLength + length;
    return part;
  };
  Record record;
  auto fields = parse_fields(next());
  if (!fields) refuse(chunk_at_, "is a chunk with a damaged header in it");
  record.fields = std::move(*fields);
  record.data = next();
  record.bytes = place - at;
  return record;
}

const std::string& BagFile::chunk_at(std::uint64_t at, const Record& record) {
  if (chunk_at_ == at) return chunk_;
  const auto size = record.number<std::uint32_t>("size");
  if (!size || *size > kMostChunkBytes) refuse(at, "is a chunk without a size that one has");
  const std::string compression = record.text("compression");
  chunk_at_ = 0;
  try {
    if (compression == "none") {
      chunk_ = record.data;
    } else if (compression == "bz2") {
      chunk_ = unpack_bz2(record.data, *size);
    } else if (compression == "lz4") {
      chunk_ = unpack_lz4(record.data, *size);
    } else {
      refuse(at, "is a chunk packed by '" + compression + "', which is not known");
    }
  } catch (const InputError& error) {
    if (compression != "bz2" && compression != "lz4") throw;
    refuse(at, std::string("is a chunk of which ") + error.what());
  }
  chunk_at_ = at;
  return chunk_;
}

void BagFile::take_record(const Record& record, const BagPosition& where, const Visit& visit) {
  const auto id = record.number<std::uint32_t>("conn");
  if (record.op() == Op::connection) {
    const auto fields = parse_fields(record.data);
    if (!id || !fields) refuse(where.record, "tells of a topic, and is damaged");
    const auto type = fields->find("type");
    connections_[*id] = {record.text("topic"),
                         type == fields->end() ? std::string() : std::string(type->second)};
  } else if (record.op() == Op::message) {
    const auto found = id ? connections_.find(*id) : connections_.end();
    if (found == connections_.end()) refuse(where.record, "has a message of a topic not told of");
    visit(found->second, record.data, where);
  }
}

void BagFile::for_each_message(const Visit& visit) {
  connections_.clear();
  for (std::uint64_t at = first_record_; at < size_;) {
    const Record record = read_record(at);
    if (record.op() == Op::chunk) {
      const std::string& chunk = chunk_at(at, record);
      for (std::uint64_t in_chunk = 0; in_chunk < chunk.size();) {
        const Record inner = record_in(chunk, in_chunk);
        take_record(inner, {at, in_chunk}, visit);
        in_chunk += inner.bytes;
      }
    } else {
      take_record(record, {at, 0}, visit);
    }
    at += record.bytes;
  }
}

std::string_view BagFile::message_at(const BagPosition& where) {
  if (chunk_at_ == where.record) return record_in(chunk_, where.in_chunk).data;
  const Record record = read_record(where.record);
  if (record.op() != Op::chunk) return record.data;
  return record_in(chunk_at(where.record, record), where.in_chunk).data;
}

}  // namespace nbvopt
