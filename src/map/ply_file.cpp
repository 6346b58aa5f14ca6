#include <array>
#include <cstdint>
#include <utility>

#include "map/point_records.hpp"
#include "map/whole_number.hpp"
#include "nbvopt/map/scan_file.hpp"

namespace nbvopt {

namespace {

struct Property {
  std::string name;
  NumberType type = NumberType::f32;
  std::optional<NumberType> list_count;  ///< of a list: the type of its length
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

enum class Format { ascii, binary_little_endian, binary_big_endian };

struct PlyHeader {
  Format format = Format::ascii;
  std::vector<Element> elements;
};

class PlyReader {
 public:
  PlyReader(std::istream& in, const std::string& name) : in_(in, name) {}

  Scan read() {
    const PlyHeader header = read_header();
    for (const Element& element : header.elements) {
      if (element.name == "vertex") return read_vertices(element, header.format);
      skip(element, header.format);
    }
    in_.refuse("the file has no element 'vertex'");
  }

 private:
  [[noreturn]] void refuse_line(const std::string& line) const {
    in_.refuse_line("'" + line.substr(0, 60) + "' is not understood in a PLY header");
  }

  PlyHeader read_header() {
    if (in_.needed_line() != "ply") in_.refuse("this is not a PLY file");
    PlyHeader header;
    bool has_format = false;
    while (true) {
      const std::string line = in_.needed_line();
      Words words(line);
      const std::string_view key = words.next();
      if (key == "end_header") break;
      if (key == "format") {
        header.format = parse_format(words, line);
        has_format = true;
      } else if (key == "element") {
        header.elements.push_back(parse_element(words, line));
      } else if (key == "property") {
        if (header.elements.empty()) refuse_line(line);
        header.elements.back().properties.push_back(parse_property(words, line));
      } else if (key != "comment" && key != "obj_info") {
        refuse_line(line);
      }
    }
    if (!has_format) in_.refuse("the header has no line 'format'");
    return header;
  }

  Format parse_format(Words& words, const std::string& line) const {
    const std::string_view format = words.next();
    if (format == "ascii") return Format::ascii;
    if (format == "binary_little_endian") return Format::binary_little_endian;
    if (format == "binary_big_endian") return Format::binary_big_endian;
    refuse_line(line);
  }

  Element parse_element(Words& words, const std::string& line) const {
    Element element;
    element.name = lower_case(std::string(words.next()));
    const auto count = parse_whole_number(words.next());
    if (!count) refuse_line(line);
    element.count = *count;
    return element;
  }

  Property parse_property(Words& words, const std::string& line) const {
    Property property;
    std::string_view type = words.next();
    if (type == "list") {
      property.list_count = parse_type(words.next(), line);
      type = words.next();
    }
    property.type = parse_type(type, line);
    property.name = words.next();
    if (property.name.empty()) refuse_line(line);
    return property;
  }

  NumberType parse_type(std::string_view word, const std::string& line) const {
    static constexpr std::array<std::pair<const char*, NumberType>, 20> kTypes{{
        {"char", NumberType::i8},    {"int8", NumberType::i8},     {"uchar", NumberType::u8},
        {"uint8", NumberType::u8},   {"short", NumberType::i16},   {"int16", NumberType::i16},
        {"ushort", NumberType::u16}, {"uint16", NumberType::u16},  {"int", NumberType::i32},
        {"int32", NumberType::i32},  {"uint", NumberType::u32},    {"uint32", NumberType::u32},
        {"long", NumberType::i64},   {"int64", NumberType::i64},   {"ulong", NumberType::u64},
        {"uint64", NumberType::u64}, {"float", NumberType::f32},   {"float32", NumberType::f32},
        {"double", NumberType::f64}, {"float64", NumberType::f64},
    }};
    const std::string type = lower_case(std::string(word));
    for (const auto& [name, number_type] : kTypes) {
      if (type == name) return number_type;
    }
    refuse_line(line);
  }

  Scan read_vertices(const Element& vertex, Format format) {
    std::vector<std::string> names;
    for (const Property& property : vertex.properties) {
      if (!property.list_count) names.push_back(property.name);
    }
    const PointFields fields(names, in_);
    std::vector<double> record(names.size());
    Scan scan;
    for (std::uint64_t i = 0; i < vertex.count; ++i) {
      in_.enter_point(i, vertex.count);
      if (format == Format::ascii) {
        read_line(vertex, in_.needed_line(), record);
      } else {
        read_bytes(vertex, format, record);
      }
      fields.add(record, scan);
    }
    return scan;
  }

  /// The numbers of an element but those of lists.
  void read_line(const Element& element, const std::string& line, std::span<double> record) const {
    Words words(line);
    for (const Property& property : element.properties) {
      if (property.list_count) {
        double count = 0.0;
        in_.parse_numbers(words, {&count, 1});
        for (std::uint64_t left = list_length(count); left > 0; --left) {
          if (words.next().empty()) in_.refuse_line("too few numbers, the file is damaged");
        }
      } else {
        in_.parse_numbers(words, record.first(1));
        record = record.subspan(1);
      }
    }
  }

  void read_bytes(const Element& element, Format format, std::span<double> record) {
    const std::endian order =
        format == Format::binary_big_endian ? std::endian::big : std::endian::little;
    const auto take = [&](NumberType type) {
      return decoded_number(in_.take_bytes(byte_size(type)), type, order);
    };
    for (const Property& property : element.properties) {
      if (property.list_count) {
        std::uint64_t left = list_length(take(*property.list_count));
        for (; left > 0; --left) in_.take_bytes(byte_size(property.type));
      } else {
        const double number = take(property.type);
        if (record.empty()) continue;  // of an element that is passed over
        record.front() = number;
        record = record.subspan(1);
      }
    }
  }

  std::uint64_t list_length(double count) const {
    if (!(count >= 0.0 && count <= UINT32_MAX)) {
      in_.refuse("a list's length is not usable, the file is damaged");
    }
    return static_cast<std::uint64_t>(count);
  }

  /// Passes over an element that stands before the vertices.
  void skip(const Element& element, Format format) {
    in_.enter("its element '" + element.name + "'");
    if (element.properties.empty()) return;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if (format == Format::ascii) {
        in_.needed_line();
      } else {
        read_bytes(element, format, {});
      }
    }
  }

  ScanInput in_;
};

}  // namespace

Scan read_ply(std::istream& in, const std::string& name) { return PlyReader(in, name).read(); }

}  // namespace nbvopt
