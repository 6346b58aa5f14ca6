#include "map/recording/frame_files.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <system_error>

#include "core/text_file.hpp"
#include "map/point_records.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {

namespace {

namespace fs = std::filesystem;

constexpr auto kDepthSuffixes = std::to_array<std::string_view>({".png", ".pgm"});
constexpr auto kCloudSuffixes =
    std::to_array<std::string_view>({".ply", ".pcd", ".xyz", ".pts", ".asc", ".csv"});

bool has_suffix(const fs::path& file, const auto& suffixes) {
  const std::string name = lower_case(file.filename().string());
  return std::ranges::any_of(suffixes, [&](std::string_view end) { return name.ends_with(end); });
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Compares runs of digits by their value and the rest by characters.
bool natural_less(const std::string& a, const std::string& b) {
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      const auto run = [](const std::string& text, std::size_t& at) {
        while (at < text.size() && text[at] == '0') ++at;
        const std::size_t start = at;
        while (at < text.size() && is_digit(text[at])) ++at;
        return std::string_view(text).substr(start, at - start);
      };
      const std::string_view number_a = run(a, i);
      const std::string_view number_b = run(b, j);
      if (number_a.size() != number_b.size()) return number_a.size() < number_b.size();
      if (number_a != number_b) return number_a < number_b;
    } else {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i;
      ++j;
    }
  }
  return a.size() - i < b.size() - j || (i == a.size() && j == b.size() && a < b);
}

std::vector<fs::path> files_of(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    std::error_code ignored;
    if (!entry.is_directory(ignored)) files.push_back(entry.path());
  }
  if (error) throw InputError(folder.string() + ": cannot be listed: " + error.message());
  std::ranges::sort(files, natural_less, [](const fs::path& file) { return file.string(); });
  return files;
}

bool matches(const std::string& name, std::string_view pattern) {
  return pattern.starts_with('*') ? name.ends_with(pattern.substr(1)) : name == pattern;
}

/// Lines "time file" or, of pairs of images, "time file time file": the last file in `depth`.
std::vector<TimedFile> listed_files(const fs::path& list, const fs::path& recording) {
  const std::string name = list.string();
  std::istringstream in(read_text_file(list));
  ScanInput lines(in, name);
  std::vector<TimedFile> files;
  while (const auto line = lines.next_line()) {
    if (line->starts_with('#')) continue;
    Words words(*line);
    const std::vector<std::string> word = words.rest();
    const std::size_t pair = word.size() >= 4 && word[1].starts_with("rgb") ? 2 : 0;
    const auto time_s = parse_scan_number(word[pair]);
    if (word.size() < 2 || !time_s) lines.refuse_line("'time file' was expected");
    files.push_back({recording / word[pair + 1], time_s});
  }
  return files;
}

}  // namespace

std::vector<fs::path> frame_files(const fs::path& folder, std::string_view suffix) {
  std::vector<fs::path> files = files_of(folder);
  std::erase_if(files, [&](const fs::path& file) {
    return suffix.empty() ? !has_suffix(file, kDepthSuffixes) && !has_suffix(file, kCloudSuffixes)
                          : !has_suffix(file, std::array{suffix});
  });
  if (files.empty()) {
    throw InputError(folder.string() + ": holds no frames, files named *" +
                     (suffix.empty() ? ".ply, .pcd, .xyz, .png or .pgm" : std::string(suffix)));
  }
  return files;
}

fs::path find_file(const fs::path& folder, const std::vector<std::string_view>& names) {
  const std::vector<fs::path> files = files_of(folder);
  std::string all;
  for (const std::string_view name : names) {
    for (const fs::path& file : files) {
      if (matches(file.filename().string(), name)) return file;
    }
    all += (all.empty() ? "" : " or ") + std::string(name);
  }
  throw InputError(folder.string() + ": holds no poses, a file " + all);
}

std::vector<TimedFile> timed_files(const fs::path& recording,
                                   const std::vector<fs::path>& in_folder) {
  for (const char* list : {"depth.txt", "associations.txt", "associate.txt", "associated.txt"}) {
    std::error_code ignored;
    if (fs::exists(recording / list, ignored)) return listed_files(recording / list, recording);
  }
  std::vector<TimedFile> files;
  for (const fs::path& file : in_folder) {
    files.push_back({file, parse_scan_number(file.stem().string())});
  }
  return files;
}

bool is_depth_image(const fs::path& file) { return has_suffix(file, kDepthSuffixes); }

std::string without_suffix(const fs::path& file, std::string_view suffix) {
  const std::string name = file.filename().string();
  return name.substr(0, name.size() - suffix.size());
}

}  // namespace nbvopt
