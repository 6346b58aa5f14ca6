#include "sim/world/sdf_document.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <functional>
#include <iostream>
#include <mutex>
#include <sdf/Exception.hh>
#include <sdf/ParserConfig.hh>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/text_file.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {

namespace {

namespace fs = std::filesystem;

/// Keeps what is written to standard error. libsdformat reports the faults of included files there,
/// and nowhere else.
class CapturedErrors {
 public:
  CapturedErrors() : before_(std::cerr.rdbuf(text_.rdbuf())) {}
  CapturedErrors(const CapturedErrors&) = delete;
  CapturedErrors& operator=(const CapturedErrors&) = delete;
  ~CapturedErrors() { std::cerr.rdbuf(before_); }

  std::string text() const { return text_.str(); }

 private:
  std::ostringstream text_;
  std::streambuf* before_;
};

/// Lends libsdformat a way to find files. It must be the global one: included files are read with
/// no other.
class LentFindCallback {
 public:
  explicit LentFindCallback(std::function<std::string(const std::string&)> find)
      : before_(sdf::ParserConfig::GlobalConfig()) {
    sdf::ParserConfig::GlobalConfig().SetFindCallback(std::move(find));
  }
  LentFindCallback(const LentFindCallback&) = delete;
  LentFindCallback& operator=(const LentFindCallback&) = delete;
  ~LentFindCallback() { sdf::ParserConfig::GlobalConfig() = before_; }

 private:
  sdf::ParserConfig before_;
};

/// The text with blanks instead of a comment before its XML declaration, so that line numbers stay.
/// Older parsers let such a comment pass, and Gazebo's own cafe.world has one.
std::string with_declaration_first(std::string xml) {
  constexpr std::string_view kBlanks = " \t\r\n";
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

/// An error of libsdformat, as it prints them.
struct Fault {
  sdf::ErrorCode code;
  std::string text;
};

/// Reads lines `Error Code 13: [place]: Msg: text`, where the place may be absent.
std::vector<Fault> faults_in(const std::string& printed) {
  constexpr std::string_view kStart = "Error Code ";
  constexpr std::string_view kSeparator = "Msg: ";
  std::vector<Fault> faults;
  std::istringstream lines(printed);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t text = line.find(kSeparator);
    if (!line.starts_with(kStart) || text == std::string::npos) continue;
    const auto code = static_cast<sdf::ErrorCode>(std::atoi(line.c_str() + kStart.size()));
    const std::size_t place = line.find(": ") + 2;
    faults.push_back(
        {code, line.substr(place, text - place) + line.substr(text + kSeparator.size())});
  }
  return faults;
}

/// Whether a fault keeps a part out of the world, or from its place in it.
bool is_part_missing(sdf::ErrorCode code) {
  switch (code) {
    case sdf::ErrorCode::FILE_READ:
    case sdf::ErrorCode::DUPLICATE_NAME:
    case sdf::ErrorCode::ATTRIBUTE_MISSING:
    case sdf::ErrorCode::ELEMENT_MISSING:
    case sdf::ErrorCode::ELEMENT_INVALID:
    case sdf::ErrorCode::URI_INVALID:
    case sdf::ErrorCode::URI_LOOKUP:
    case sdf::ErrorCode::POSE_RELATIVE_TO_INVALID:
      return true;
    default:
      return false;
  }
}

void report(const std::vector<Fault>& faults, WorldLog& log) {
  for (const Fault& fault : faults) {
    // The first is said of worlds that loaded; includes that are not found we have reported.
    if (fault.text == "Failed to load a world." || fault.code == sdf::ErrorCode::URI_LOOKUP)
      continue;
    if (is_part_missing(fault.code)) {
      log.left_out(fault.text);
    } else {
      log.remark(fault.text);
    }
  }
}

/// Why there is neither a world nor a model.
std::string first_cause(const std::vector<Fault>& faults, const std::string& printed) {
  if (const std::size_t start = printed.find("Error parsing XML"); start != std::string::npos) {
    return printed.substr(start, printed.find('\n', start) - start);
  }
  for (const Fault& fault : faults) {
    if (fault.code != sdf::ErrorCode::STRING_READ) return fault.text;
  }
  return "there is neither a world nor a model in it";
}

/// Answers libsdformat's questions for included models, where it finds none in the current folder.
class IncludeFinder {
 public:
  IncludeFinder(const fs::path& world_file, ModelPaths& model_paths, WorldLog& log)
      : world_file_(world_file), model_paths_(model_paths), log_(log) {}

  std::string operator()(const std::string& uri) const {
    refuse_endless(uri);
    const auto found = model_paths_.find(uri, fs::absolute(world_file_).parent_path());
    if (found) return found->string();
    log_.not_found("model '" + uri + "' is not found, give its folder as a model path");
    return {};
  }

 private:
  /// libsdformat follows a model that includes itself until the stack ends.
  void refuse_endless(const std::string& uri) const {
    constexpr std::uintptr_t kStackMax_bytes = 128 * 1024;  // about 25 models in each other
    const auto here = reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0));
    if (stack_start_ - here < kStackMax_bytes) return;
    throw InputError(world_file_.string() + ": model '" + uri +
                     "' is included too deeply, does it include itself?");
  }

  fs::path world_file_;
  ModelPaths& model_paths_;
  WorldLog& log_;
  std::uintptr_t stack_start_ = reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0));
};

}  // namespace

sdf::Root read_sdf_document(const fs::path& path, ModelPaths& model_paths, WorldLog& log) {
  static std::mutex one_at_a_time;  // libsdformat's configuration and standard error are global
  const std::lock_guard lock(one_at_a_time);
  const std::string xml = with_declaration_first(read_text_file(path));
  log.read(path);
  sdf::Root root;
  std::string printed;
  try {
    const CapturedErrors captured;
    const LentFindCallback lent(IncludeFinder(path, model_paths, log));
    std::ostringstream returned;
    for (const sdf::Error& error : root.LoadSdfString(xml, sdf::ParserConfig::GlobalConfig())) {
      returned << error << '\n';
    }
    printed = captured.text() + returned.str();
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(path.string() + ": cannot be read as SDF: " + error.what());
  } catch (const sdf::Exception& error) {
    throw InputError(path.string() + ": cannot be read as SDF: " + error.GetErrorStr());
  }
  const std::vector<Fault> faults = faults_in(printed);
  if (root.WorldCount() == 0 && root.Model() == nullptr) {
    throw InputError(path.string() + ": cannot be read as SDF: " + first_cause(faults, printed));
  }
  report(faults, log);
  return root;
}

}  // namespace nbvopt
