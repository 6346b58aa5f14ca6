#include <array>
#include <cstdint>
#include <sstream>
#include <utility>

#include "map/point_records.hpp"
#include "map/whole_number.hpp"
#include "nbvopt/core/error.hpp"
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

struct Header {
  Format format = Format::ascii;
  std::vector<Element> elements;
};

class PlyReader {
 public:
  PlyReader(std::istream& in, const std::string& name) : in_(in), name_(name) {}

  Scan read() {
    const Header header = read_header();
    for (const Element& element : header.elements) {
      if (element.name == "vertex") return read_vertices(element, header.format);
      skip(element, header.format);
    }
    refuse("the file has no element 'vertex'");
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw InputError(name_ + ": " + what); }

  [[noreturn]] void refuse_line(const std::string& line) const {
    refuse("the header's line '" + line.substr(0, 60) + "' is not understood");
  }

  Header read_header() {
    if (take_text_line(in_, name_) != "ply") refuse("this is not a PLY file");
    Header header;
    bool has_format = false;
    while (true) {
      const std::string line = take_text_line(in_, name_);
      std::istringstream words(line);
      std::string key;
      words >> key;
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
    if (!has_format) refuse("the header has no line 'format'");
    return header;
  }

  Format parse_format(std::istringstream& words, const std::string& line) const {
    std::string format;
    words >> format;
    if (format == "ascii") return Format::ascii;
    if (format == "binary_little_endian") return Format::binary_little_endian;
    if (format == "binary_big_endian") return Format::binary_big_endian;
    refuse_line(line);
  }

  Element parse_element(std::istringstream& words, const std::string& line) const {
    Element element;
    std::string count;
    words >> element.name >> count;
    const auto number = parse_whole_number(count);
    if (!number) refuse_line(line);
    element.count = *number;
    return element;
  }

  Property parse_property(std::istringstream& words, const std::string& line) const {
    Property property;
    std::string type;
    words >> type;
    if (type == "list") {
      std::string count_type;
      words >> count_type >> type;
      property.list_count = parse_type(count_type, line);
    }
    property.type = parse_type(type, line);
    if (!(words >> property.name)) refuse_line(line);
    return property;
  }

  NumberType parse_type(const std::string& type, const std::string& line) const {
    static constexpr std::array<std::pair<const char*, NumberType>, 16> kTypes{{
        {"char", NumberType::i8},
        {"int8", NumberType::i8},
        {"uchar", NumberType::u8},
        {"uint8", NumberType::u8},
        {"short", NumberType::i16},
        {"int16", NumberType::i16},
        {"ushort", NumberType::u16},
        {"uint16", NumberType::u16},
        {"int", NumberType::i32},
        {"int32", NumberType::i32},
        {"uint", NumberType::u32},
        {"uint32", NumberType::u32},
        {"float", NumberType::f32},
        {"float32", NumberType::f32},
        {"double", NumberType::f64},
        {"float64", NumberType::f64},
    }};
    for (const auto& [name, number_type] : kTypes) {
      if (type == name) return number_type;
    }
    refuse_line(line);
  }

  static std::endian order(Format format) {
    return format == Format::binary_big_endian ? std::endian::big : std::endian::little;
  }

  Scan read_vertices(const Element& vertex, Format format) {
    std::vector<std::string> names;
    std::size_t bytes = 0;
    for (const Property& property : vertex.properties) {
      if (property.list_count) refuse("the element 'vertex' has a list, which is not supported");
      names.push_back(property.name);
      bytes += byte_size(property.type);
    }
    const PointFields fields(names, name_);
    std::vector<double> record(names.size());
    Scan scan;
    for (std::uint64_t i = 0; i < vertex.count; ++i) {
      if (format == Format::ascii) {
        parse_numbers(take_text_line(in_, name_), record, name_);
      } else {
        const char* next = take_bytes(in_, bytes, name_);
        for (std::size_t p = 0; p < record.size(); ++p) {
          record[p] = decoded_number(next, vertex.properties[p].type, order(format));
          next += byte_size(vertex.properties[p].type);
        }
      }
      fields.add(record, scan);
    }
    return scan;
  }

  /// Passes over an element that stands before the vertices.
  void skip(const Element& element, Format format) {
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if (format == Format::ascii) {
        take_text_line(in_, name_);
        continue;
      }
      for (const Property& property : element.properties) {
        std::uint64_t values = 1;
        if (property.list_count) {
          const char* bytes = take_bytes(in_, byte_size(*property.list_count), name_);
          const double count = decoded_number(bytes, *property.list_count, order(format));
          if (!(count >= 0.0 && count <= UINT32_MAX)) {
            refuse("a list's length is not usable, the file is damaged");
          }
          values = static_cast<std::uint64_t>(count);
        }
        for (; values > 0; --values) take_bytes(in_, byte_size(property.type), name_);
      }
      if (element.properties.empty()) break;
    }
  }

  ByteReader in_;
  const std::string& name_;
};

}  // namespace

Scan read_ply(std::istream& in, const std::string& name) { return PlyReader(in, name).read(); }

}  // namespace nbvopt
