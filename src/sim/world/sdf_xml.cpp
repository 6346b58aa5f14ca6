#include "sim/world/sdf_xml.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string_view>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {

namespace {

constexpr std::string_view kBlanks = " \t\r\n\f\v";

std::string_view trimmed(std::string_view text) {
  const std::size_t from = text.find_first_not_of(kBlanks);
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(kBlanks) - from + 1);
}

/// The text with blanks instead of a comment before its XML declaration, so that line numbers stay.
/// Older parsers let such a comment pass, and Gazebo's own cafe.world has one.
std::string with_declaration_first(std::string xml) {
  const std::size_t comment = xml.find_first_not_of(kBlanks);
  const std::size_t comment_end = xml.find("-->", comment);
  const std::size_t declaration = xml.find("<?xml", comment_end);
  if (declaration == std::string::npos) return xml;
  if (!std::string_view(xml).substr(comment).starts_with("<!--")) return xml;
  if (xml.find_first_not_of(kBlanks, comment_end + 3) != declaration) return xml;
  std::replace_if(
      xml.begin(), xml.begin() + static_cast<std::ptrdiff_t>(declaration),
      [](char c) { return c != '\n'; }, ' ');
  return xml;
}

/// Whether a text holds so many finite numbers and nothing else.
template <std::size_t N>
bool read_numbers(std::string_view text, std::array<double, N>& numbers) {
  std::size_t count = 0;
  for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
    const std::string_view word = text.substr(0, text.find_first_of(kBlanks));
    text.remove_prefix(word.size());
    const std::optional<double> number = parse_number(word);
    if (count == N || !number || !std::isfinite(*number)) return false;
    numbers[count++] = *number;
  }
  return count == N;
}

template <std::size_t N>
std::array<double, N> numbers_of(const SdfElement& element, const char* demand) {
  std::array<double, N> numbers{};
  const char* text = element.GetText();
  if (text == nullptr || !read_numbers(text, numbers)) refuse_value(element, demand);
  return numbers;
}

Eigen::Quaterniond turn_of(double roll_rad, double pitch_rad, double yaw_rad) {
  return Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX());
}

}  // namespace

SdfXml::SdfXml(const std::string& text, const std::string& file)
    : document_(std::make_unique<tinyxml2::XMLDocument>()) {
  const std::string xml = with_declaration_first(text);
  if (document_->Parse(xml.c_str(), xml.size()) != tinyxml2::XML_SUCCESS) {
    throw InputError(file + ": Error parsing XML in line " +
                     std::to_string(document_->ErrorLineNum()) + ": " +
                     tinyxml2::XMLDocument::ErrorIDToName(document_->ErrorID()));
  }
  if (root() == nullptr) throw InputError(file + ": there is no XML element in it");
}

const SdfElement* SdfXml::sdf() const {
  const bool is_sdf = is_named(*root(), "sdf") || is_named(*root(), "gazebo");
  return is_sdf && !is_too_old() ? root() : nullptr;
}

bool SdfXml::is_too_old() const { return attribute_of(*root(), "version") == "1.0"; }

bool is_named(const SdfElement& element, const char* name) {
  return std::string_view(element.Name()) == name;
}

std::string attribute_of(const SdfElement& element, const char* name) {
  const char* value = element.Attribute(name);
  return std::string(trimmed(value == nullptr ? "" : value));
}

std::string text_of(const SdfElement* element) {
  const char* text = element == nullptr ? nullptr : element->GetText();
  return std::string(trimmed(text == nullptr ? "" : text));
}

std::string text_of(const SdfElement& parent, const char* child) {
  return text_of(parent.FirstChildElement(child));
}

void refuse_value(const SdfElement& element, const std::string& demand) {
  constexpr std::size_t kShown = 60;
  std::string text = text_of(&element).substr(0, kShown);
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < ' '; }, ' ');
  throw InputError("line " + std::to_string(element.GetLineNum()) + ": <" + element.Name() +
                   "> is '" + text + "', it must be " + demand);
}

double number_of(const SdfElement& parent, const char* child, double otherwise) {
  const SdfElement* element = parent.FirstChildElement(child);
  return element == nullptr ? otherwise : numbers_of<1>(*element, "a number")[0];
}

Eigen::Vector2d vector_of(const SdfElement& parent, const char* child,
                          const Eigen::Vector2d& otherwise) {
  const SdfElement* element = parent.FirstChildElement(child);
  return element == nullptr ? otherwise : point_of(*element);
}

Eigen::Vector3d vector_of(const SdfElement& parent, const char* child,
                          const Eigen::Vector3d& otherwise) {
  const SdfElement* element = parent.FirstChildElement(child);
  if (element == nullptr) return otherwise;
  const auto [x, y, z] = numbers_of<3>(*element, "3 numbers");
  return {x, y, z};
}

Eigen::Vector2d point_of(const SdfElement& element) {
  const auto [x, y] = numbers_of<2>(element, "2 numbers");
  return {x, y};
}

Eigen::Affine3d pose_of(const SdfElement& pose) {
  if (text_of(&pose).empty()) return Eigen::Affine3d::Identity();
  if (attribute_of(pose, "rotation_format") == "quat_xyzw") {
    const auto numbers = numbers_of<7>(pose, "7 numbers: x y z and a quaternion x y z w");
    const auto [x, y, z, qx, qy, qz, qw] = numbers;
    const Eigen::Quaterniond turn(qw, qx, qy, qz);
    if (!(turn.norm() > 0.0)) refuse_value(pose, "a turn: its quaternion is zero");
    return Eigen::Translation3d(x, y, z) * turn.normalized();
  }
  const auto [x, y, z, roll, pitch, yaw] = numbers_of<6>(pose, "6 numbers: x y z roll pitch yaw");
  const std::string degrees = attribute_of(pose, "degrees");
  const double unit_rad = degrees == "true" || degrees == "1" ? std::numbers::pi / 180.0 : 1.0;
  return Eigen::Translation3d(x, y, z) * turn_of(unit_rad * roll, unit_rad * pitch, unit_rad * yaw);
}

}  // namespace nbvopt
