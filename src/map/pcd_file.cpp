#include <algorithm>
#include <cstdint>
#include <sstream>

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
  std::string data;
};

/// One number of a record; a field of several numbers has as many of these.
struct Column {
  std::string name;  ///< empty for all but the first number of a field
  NumberType type = NumberType::f32;
};

class PcdReader {
 public:
  PcdReader(std::istream& in, const std::string& name) : in_(in), name_(name) {}

  Scan read() {
    const Header header = read_header();
    const std::vector<Column> columns = columns_of(header);
    const std::uint64_t points = points_of(header);
    if (header.data == "ascii") return read_ascii(columns, points);
    if (header.data == "binary") return read_binary(columns, points);
    if (header.data == "binary_compressed") return read_compressed(columns, points);
    refuse("DATA is '" + header.data + "', known are ascii, binary and binary_compressed");
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw InputError(name_ + ": " + what); }

  Header read_header() {
    Header header;
    while (header.data.empty()) {
      const std::string line = take_text_line(in_, name_);
      std::istringstream words(line);
      std::string key;
      words >> key;
      if (key.empty() || key.starts_with('#')) continue;
      std::vector<std::string> values;
      for (std::string value; words >> value;) values.push_back(value);
      if (key == "FIELDS") {
        header.fields = values;
      } else if (key == "SIZE") {
        header.sizes = values;
      } else if (key == "TYPE") {
        header.types = values;
      } else if (key == "COUNT") {
        header.counts = values;
      } else if (key == "WIDTH") {
        header.width = whole_number(values, line);
      } else if (key == "HEIGHT") {
        header.height = whole_number(values, line);
      } else if (key == "POINTS") {
        header.points = whole_number(values, line);
      } else if (key == "DATA" && values.size() == 1) {
        header.data = values.front();
      } else if (key != "VERSION" && key != "VIEWPOINT") {
        refuse("the header's line '" + line.substr(0, 60) +
               "' is not understood, is this a PCD file?");
      }
    }
    return header;
  }

  std::uint64_t whole_number(const std::vector<std::string>& values,
                             const std::string& line) const {
    const auto number = values.size() == 1 ? parse_whole_number(values.front()) : std::nullopt;
    if (!number) refuse("the header's line '" + line.substr(0, 60) + "' has no count");
    return *number;
  }

  std::uint64_t points_of(const Header& header) const {
    if (header.points) return *header.points;
    if (!header.width || !header.height) refuse("the header has no POINTS");
    if (*header.height > 0 && *header.width > UINT64_MAX / *header.height) {
      refuse("WIDTH times HEIGHT is too large");
    }
    return *header.width * *header.height;
  }

  std::vector<Column> columns_of(const Header& header) const {
    if (header.sizes.size() != header.fields.size() ||
        header.types.size() != header.fields.size() ||
        (!header.counts.empty() && header.counts.size() != header.fields.size())) {
      refuse("FIELDS, SIZE, TYPE and COUNT do not have one value a field");
    }
    constexpr std::uint64_t kMaxNumbers = 4096;
    std::vector<Column> columns;
    for (std::size_t i = 0; i < header.fields.size(); ++i) {
      const auto count = header.counts.empty() ? std::optional<std::uint64_t>(1)
                                               : parse_whole_number(header.counts[i]);
      if (!count || *count == 0 || *count > kMaxNumbers || columns.size() > kMaxNumbers) {
        refuse("the COUNT of field '" + header.fields[i] + "' is not usable");
      }
      const NumberType type = number_type(header.fields[i], header.types[i] + header.sizes[i]);
      columns.push_back({header.fields[i], type});
      columns.resize(columns.size() + *count - 1, {"", type});
    }
    return columns;
  }

  NumberType number_type(const std::string& field, const std::string& type_and_size) const {
    static constexpr std::array<std::pair<const char*, NumberType>, 10> kTypes{{
        {"I1", NumberType::i8},
        {"U1", NumberType::u8},
        {"I2", NumberType::i16},
        {"U2", NumberType::u16},
        {"I4", NumberType::i32},
        {"U4", NumberType::u32},
        {"I8", NumberType::i64},
        {"U8", NumberType::u64},
        {"F4", NumberType::f32},
        {"F8", NumberType::f64},
    }};
    for (const auto& [name, type] : kTypes) {
      if (type_and_size == name) return type;
    }
    refuse("the TYPE and SIZE of field '" + field + "' are not known");
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
    return PointFields(names, name_);
  }

  Scan read_ascii(const std::vector<Column>& columns, std::uint64_t points) {
    const PointFields fields = fields_of(columns);
    std::vector<double> record(columns.size());
    Scan scan;
    for (std::uint64_t i = 0; i < points; ++i) {
      parse_numbers(take_text_line(in_, name_), record, name_);
      for (std::size_t c = 0; c < columns.size(); ++c) {
        if (is_float_colour(columns[c])) record[c] = colour_bits(record[c]);
      }
      fields.add(record, scan);
    }
    return scan;
  }

  Scan read_binary(const std::vector<Column>& columns, std::uint64_t points) {
    const PointFields fields = fields_of(columns);
    const std::size_t bytes = record_bytes(columns);
    std::vector<double> record(columns.size());
    Scan scan;
    for (std::uint64_t i = 0; i < points; ++i) {
      const char* next = take_bytes(in_, bytes, name_);
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
    const auto compressed_bytes = number_at<std::uint32_t>(take_bytes(in_, 4, name_));
    const auto bytes = number_at<std::uint32_t>(take_bytes(in_, 4, name_));
    if (points > bytes || points * record_bytes(columns) != bytes) {
      refuse("the size of the compressed points does not fit the header, the file is damaged");
    }
    std::string compressed;
    while (compressed.size() < compressed_bytes) {
      constexpr std::size_t kBlock = 1 << 16;
      const std::size_t count = std::min<std::size_t>(kBlock, compressed_bytes - compressed.size());
      compressed.append(take_bytes(in_, count, name_), count);
    }
    const auto data = lzf_decompressed(compressed, bytes);
    if (!data) refuse("the compressed points are damaged");

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

  ByteReader in_;
  const std::string& name_;
};

}  // namespace

Scan read_pcd(std::istream& in, const std::string& name) { return PcdReader(in, name).read(); }

}  // namespace nbvopt
