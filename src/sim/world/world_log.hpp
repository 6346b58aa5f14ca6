// What is to be said of a world that is being built.
#pragma once

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace nbvopt {

/// Collects warnings, each text once, and what decides whether the world may be kept.
class WorldLog {
 public:
  /// Something is faulty, yet no part is missing.
  void remark(std::string warning) { add(warnings_, std::move(warning)); }

  /// A part is missing, and will be as long as the files are as they are.
  void left_out(std::string warning) {
    add(missing_, warning);
    remark(std::move(warning));
  }

  /// A part is missing because there is no such file: the world changes when it appears.
  void not_found(std::string warning) {
    is_lasting_ = false;
    left_out(std::move(warning));
  }

  /// The world depends on this file.
  void read(const std::filesystem::path& file) { files_.insert(file); }

  const std::vector<std::string>& warnings() const { return warnings_; }
  const std::vector<std::string>& missing() const { return missing_; }  ///< some of the warnings
  const std::set<std::filesystem::path>& files() const { return files_; }

  /// Whether the world stays the same as long as its files do.
  bool is_lasting() const { return is_lasting_; }

 private:
  static void add(std::vector<std::string>& lines, std::string line) {
    if (std::ranges::find(lines, line) == lines.end()) lines.push_back(std::move(line));
  }

  std::vector<std::string> warnings_;
  std::vector<std::string> missing_;
  std::set<std::filesystem::path> files_;
  bool is_lasting_ = true;
};

}  // namespace nbvopt
