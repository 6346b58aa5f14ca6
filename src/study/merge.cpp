#include "study/merge.hpp"

#include <optional>
#include <string>
#include <vector>

#include "core/file_lock.hpp"
#include "core/folder.hpp"
#include "core/text_file.hpp"
#include "experiment/merge.hpp"
#include "nbvopt/core/error.hpp"
#include "study/record.hpp"

namespace nbvopt::study {
namespace {

/// What makes studies one: all but where their maps lie.
Json placeless_study(const StudyFolder& folder) {
  read_study(folder);  // refuses what is no whole study
  Json study = Json::parse(read_text_file(folder.study()));
  for (Json& map : study.at("maps")) map.erase("file");
  study["robot"] = read_text_file(folder.robot());
  return study;
}

void require_same_study(const Json& a, const StudyFolder& folder_a, const StudyFolder& folder_b) {
  const Json b = placeless_study(folder_b);
  for (const auto& [key, value] : a.items()) {
    if (b.value(key, Json()) == value) continue;
    throw InputError(folder_b.root.string() + " holds another study than " +
                     folder_a.root.string() + ": their " + key +
                     " differ; run both with one spec, and merge then");
  }
}

/// Answers within a time limit depend on it; they agree whatever they are.
Json repeatable(const Json& record) {
  if (!record.value("time_limit_ms", Json()).is_null()) return {};
  Json timeless = record;
  timeless.erase("times");
  return timeless;
}

experiment::RecordKind kind_of(const std::filesystem::path& file) {
  return {.file = file.filename().string(), .id = record_id, .repeatable = repeatable};
}

}  // namespace

MergeCount merge_studies(std::span<const StudyFolder> parts, const StudyFolder& into) {
  std::optional<FileLock> lock;
  const auto take_lock = [&] { lock.emplace(into.study(), "run writes this study"); };
  std::vector<StudyFolder> all;
  if (std::filesystem::exists(into.study())) {
    take_lock();
    all.push_back(into);
  }
  std::vector<std::filesystem::path> others;
  for (const StudyFolder& part : parts) {
    if (lock && std::filesystem::equivalent(part.root, into.root)) continue;
    all.push_back(part);
    others.push_back(part.root);
  }

  const Json study = placeless_study(all.front());
  std::vector<std::filesystem::path> folders;
  for (const StudyFolder& folder : all) {
    require_same_study(study, all.front(), folder);
    folders.push_back(folder.root);
  }
  const experiment::RecordKind queries = kind_of(into.records());
  const experiment::RecordKind references = kind_of(into.references());
  require_agreement(folders, queries);
  require_agreement(folders, references);

  if (!lock) {
    create_folder(into.root);
    take_lock();
    write_study(read_study(all.front()), into);
  }
  const experiment::MergeCount of_queries = merge_records(others, into.root, queries);
  const experiment::MergeCount of_references = merge_records(others, into.root, references);
  return {.records = of_queries.added,
          .references = of_references.added,
          .repeated = of_queries.repeated + of_references.repeated};
}

}  // namespace nbvopt::study
