#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <utility>

#include "map/lzf.hpp"
#include "map/point_records.hpp"
#include "map/whole_number.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/scan_file.hpp"

namespace nbvopt {

namespace {

struct Header {
  std::vector<std::string> fields, sizes, types, counts;
  std::optional<std::uint64_t> points, width, height;
  std::optional<Transform> viewpoint;
  std::string data;
};

/// One number of a record; a field of several numbers has as many of these.
struct Column {
  std::string name;  ///< empty for all but the first number of a field
  NumberType type = NumberType::f32;
};

class PcdReader {
 public:
  PcdReader(std::istream& in, const std::string& name) : in_(in, name) {}

  Scan read() {
    const Header header = read_header();
    const std::vector<Column> columns = columns_of(header);
    const std::uint64_t points = points_of(header);
    if (header.data == "ascii") return read_ascii(columns, points);
    if (header.data == "binary") return read_binary(columns, points);
    if (header.data == "binary_compressed") return read_compressed(columns, points);
    in_.refuse("DATA is '" + header.data + "', known are ascii, binary and binary_compressed");
  }

  Header read_header() {
    Header header;
    while (header.data.empty()) {
      const std::string line = in_.needed_line();
      Words words(line);
      const std::string key = lower_case(std::string(words.next()));
      if (key.starts_with('#')) continue;
      std::vector<std::string> values = words.rest();
      if (key == "fields" || key == "columns") {
        header.fields = std::move(values);
      } else if (key == "size") {
        header.sizes = std::move(values);
      } else if (key == "type") {
        header.types = std::move(values);
      } else if (key == "count") {
        header.counts = std::move(values);
      } else if (key == "width") {
        header.width = whole_number(values);
      } else if (key == "height") {
        header.height = whole_number(values);
      } else if (key == "points") {
        header.points = whole_number(values);
      } else if (key == "viewpoint") {
        header.viewpoint = viewpoint(values);
      } else if (key == "data" && values.size() == 1) {
        header.data = lower_case(values.front());
      } else if (key != "version") {
        in_.refuse_line("'" + line.substr(0, 60) + "' is not understood, is this a PCD file?");
      }
    }
    return header;
  }

 private:
  std::uint64_t whole_number(const std::vector<std::string>& values) const {
    const auto number = values.size() == 1 ? parse_whole_number(values.front()) : std::nullopt;
    if (!number) in_.refuse_line("a count is missing");
    return *number;
  }

  /// Position and quaternion, the real part first; none where they are no pose.
  static std::optional<Transform> viewpoint(const std::vector<std::string>& values) {
    std::array<double, 7> n{};
    if (values.size() != n.size()) return std::nullopt;
    for (std::size_t i = 0; i < n.size(); ++i) {
      const auto number = parse_scan_number(values[i]);
      if (!number) return std::nullopt;
      n[i] = *number;
    }
    try {
      return pose_from_quaternion({n[0], n[1], n[2]}, {n[4], n[5], n[6], n[3]});
    } catch (const InputError&) {
      return std::nullopt;
    }
  }

  /// A POINTS that differs from WIDTH times HEIGHT is right: files that were cut or joined by hand
  /// keep the others.
  std::uint64_t points_of(const Header& header) const {
    if (header.points) return *header.points;
    if (!header.width) in_.refuse("the header has neither POINTS nor WIDTH");
    const std::uint64_t height = header.height.value_or(1);
    if (height > 0 && *header.width > UINT64_MAX / height) {
      in_.refuse("WIDTH times HEIGHT is too large");
    }
    return *header.width * height;
  }

  /// Files of the first versions have neither SIZE nor TYPE nor COUNT: one float a field.
  std::vector<Column> columns_of(const Header& header) const {
    const auto fits = [&](const std::vector<std::string>& values) {
      return values.empty() || values.size() == header.fields.size();
    };
    if (header.fields.empty()) in_.refuse("the header has no FIELDS");
    if (!fits(header.sizes) || !fits(header.types) || !fits(header.counts)) {
      in_.refuse("FIELDS, SIZE, TYPE and COUNT do not have one value a field");
    }
    constexpr std::uint64_t kMaxNumbers = 4096;
    std::vector<Column> columns;
    for (std::size_t i = 0; i < header.fields.size(); ++i) {
      const auto count = header.counts.empty() ? std::optional<std::uint64_t>(1)
                                               : parse_whole_number(header.counts[i]);
      if (!count || *count == 0 || *count > kMaxNumbers || columns.size() > kMaxNumbers) {
        in_.refuse("the COUNT of field '" + header.fields[i] + "' is not usable");
      }
      const std::string type = header.types.empty() ? "f" : lower_case(header.types[i]);
      const std::string size = header.sizes.empty() ? "4" : header.sizes[i];
      const NumberType number = number_type(header.fields[i], type + size);
      columns.push_back({lower_case(header.fields[i]), number});
      columns.resize(columns.size() + *count - 1, {"", number});
    }
    return columns;
  }

  NumberType number_type(const std::string& field, const std::string& type_and_size) const {
    static constexpr std::array<std::pair<const char*, NumberType>, 10> kTypes{{
        {"i1", NumberType::i8},
        {"u1", NumberType::u8},
        {"i2", NumberType::i16},
        {"u2", NumberType::u16},
        {"i4", NumberType::i32},
        {"u4", NumberType::u32},
        {"i8", NumberType::i64},
        {"u8", NumberType::u64},
        {"f4", NumberType::f32},
        {"f8", NumberType::f64},
    }};
    for (const auto& [name, type] : kTypes) {
      if (type_and_size == name) return type;
    }
    in_.refuse("the TYPE and SIZE of field '" + field + "' are not known");
  }

  /// PCL stores a colour's four bytes as a float; this gives them as the number that they are.
  static double colour_bits(double value) {
    return static_cast<double>(std::bit_cast<std::uint32_t>(static_cast<float>(value)));
  }
  static bool is_float_colour(const Column& column) {
    return column.type == NumberType::f32 && (column.name == "rgb" || column.name == "rgba");
  }
  /// How the number is stored, the bytes of a colour being a whole number.
  static NumberType stored_type(const Column& column) {
    return is_float_colour(column) ? NumberType::u32 : column.type;
  }

  PointFields fields_of(const std::vector<Column>& columns) const {
    std::vector<std::string> names;
    for (const Column& column : columns) names.push_back(column.name);
    return PointFields(std::move(names), in_);
  }

  Scan read_ascii(const std::vector<Column>& columns, std::uint64_t points) {
    const PointFields fields = fields_of(columns);
    std::vector<double> record(columns.size());
    Scan scan;
    for (std::uint64_t i = 0; i < points;) {
      in_.enter_point(i, points);
      const std::string line = in_.needed_line();
      if (line.starts_with('#')) continue;
      Words words(line);
      in_.parse_numbers(words, record);
      for (std::size_t c = 0; c < columns.size(); ++c) {
        if (is_float_colour(columns[c])) record[c] = colour_bits(record[c]);
      }
      fields.add(record, scan);
      ++i;
    }
    return scan;
  }

  Scan read_binary(const std::vector<Column>& columns, std::uint64_t points) {
    const PointFields fields = fields_of(columns);
    const std::size_t bytes = record_bytes(columns);
    std::vector<double> record(columns.size());
    Scan scan;
    for (std::uint64_t i = 0; i < points; ++i) {
      in_.enter_point(i, points);
      const char* next = in_.take_bytes(bytes);
      for (std::size_t c = 0; c < columns.size(); ++c) {
        record[c] = decoded_number(next, stored_type(columns[c]), std::endian::little);
        next += byte_size(columns[c].type);
      }
      fields.add(record, scan);
    }
    return scan;
  }

  /// The sizes compressed and not, then all numbers of the first column, of the second, ...
  Scan read_compressed(const std::vector<Column>& columns, std::uint64_t points) {
    const PointFields fields = fields_of(columns);
    in_.enter("the compressed points");
    const auto compressed_bytes = number_at<std::uint32_t>(in_.take_bytes(4));
    const auto bytes = number_at<std::uint32_t>(in_.take_bytes(4));
    if (points > bytes || points * record_bytes(columns) != bytes) {
      in_.refuse("the size of the compressed points does not fit the header, the file is damaged");
    }
    std::string compressed;
    while (compressed.size() < compressed_bytes) {
      constexpr std::size_t kBlock = 1 << 16;
      const std::size_t count = std::min<std::size_t>(kBlock, compressed_bytes - compressed.size());
      compressed.append(in_.take_bytes(count), count);
    }
    const auto data = lzf_decompressed(compressed, bytes);
    if (!data) in_.refuse("the compressed points are damaged");

    std::vector<const char*> next;
    const char* column_start = data->data();
    for (const Column& column : columns) {
      next.push_back(column_start);
      column_start += points * byte_size(column.type);
    }
    std::vector<double> record(columns.size());
    Scan scan;
    for (std::uint64_t i = 0; i < points; ++i) {
      for (std::size_t c = 0; c < columns.size(); ++c) {
        record[c] = decoded_number(next[c], stored_type(columns[c]), std::endian::little);
        next[c] += byte_size(columns[c].type);
      }
      fields.add(record, scan);
    }
    return scan;
  }

  static std::size_t record_bytes(const std::vector<Column>& columns) {
    std::size_t bytes = 0;
    for (const Column& column : columns) bytes += byte_size(column.type);
    return bytes;
  }

  ScanInput in_;
};

}  // namespace

Scan read_pcd(std::istream& in, const std::string& name) { return PcdReader(in, name).read(); }

std::optional<Transform> read_pcd_viewpoint(std::istream& in, const std::string& name) {
  return PcdReader(in, name).read_header().viewpoint;
}

}  // namespace nbvopt
