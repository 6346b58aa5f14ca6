#include "reproduction/merge.hpp"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/file_lock.hpp"
#include "core/folder.hpp"
#include "core/text_file.hpp"
#include "experiment/digest.hpp"
#include "nbvopt/core/error.hpp"
#include "reproduction/record.hpp"

namespace nbvopt {
namespace {

namespace fs = std::filesystem;

/// Warnings name files, too.
Json repeatable(const Json& record) {
  Json repeatable = record;
  for (const char* key : {"times_ms", "world", "warnings"}) repeatable.erase(key);
  return repeatable;
}

/// What units have written, by its name: the first folder's that has it. Throws InputError when
/// trajectories of one name differ.
std::map<fs::path, fs::path> written_files(std::span<const fs::path> folders) {
  std::map<fs::path, fs::path> files;
  for (const fs::path& folder : folders) {
    const fs::path units = ReproductionFolder{folder}.units();
    if (!fs::exists(units)) continue;
    for (const fs::directory_entry& entry : fs::directory_iterator(units)) {
      const fs::path& file = entry.path();
      const bool is_trajectory = file.extension() == ".csv";
      if (!is_trajectory && file.extension() != ".png") continue;
      const auto [known, is_new] = files.try_emplace(file.filename(), file);
      if (is_new || !is_trajectory) continue;
      if (experiment::file_digest(known->second) == experiment::file_digest(file)) continue;
      throw InputError(file.string() + " is another drive than " + known->second.string() +
                       ": run both with the same options, and merge then");
    }
  }
  return files;
}

}  // namespace

experiment::MergeCount merge_reproductions(std::span<const ReproductionFolder> parts,
                                           const ReproductionFolder& into) {
  std::optional<FileLock> lock;
  const auto take_lock = [&] { lock.emplace(into.records(), "run writes this reproduction"); };
  std::vector<fs::path> folders;
  if (fs::exists(into.records())) {
    take_lock();
    folders.push_back(into.root);
  }
  std::vector<fs::path> others;
  for (const ReproductionFolder& part : parts) {
    if (!fs::exists(part.records())) {
      throw InputError(part.root.string() + " holds no reproduction: there is no " +
                       part.records().string());
    }
    if (lock && fs::equivalent(part.root, into.root)) continue;
    folders.push_back(part.root);
    others.push_back(part.root);
  }
  const experiment::RecordKind kind{
      .file = into.records().filename().string(), .id = record_id, .repeatable = repeatable};
  require_agreement(folders, kind);
  const std::map<fs::path, fs::path> files = written_files(folders);

  create_folder(into.units());
  if (!lock) take_lock();
  // First: a record counts where its trajectory is there.
  for (const auto& [name, file] : files) {
    const fs::path place = into.units() / name;
    if (!fs::exists(place)) write_file_atomically(place, read_text_file(file));
  }
  return merge_records(others, into.root, kind);
}

}  // namespace nbvopt
