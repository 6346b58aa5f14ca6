#include "study/merge.hpp"

#include <array>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/file_lock.hpp"
#include "core/folder.hpp"
#include "core/text_file.hpp"
#include "experiment/digest.hpp"
#include "experiment/record_file.hpp"
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

/// The records of one kind that are known, by their unit.
class KnownRecords {
 public:
  enum class Answer { is_new, is_known };

  /// Takes up a record of the folder. Throws InputError when it contradicts another's.
  Answer take(const Json& record, const StudyFolder& folder) {
    const bool has_failed = record.contains("failure");
    const auto [place, is_new] = known_.try_emplace(record_id(record));
    Known& known = place->second;
    if (!is_new && (has_failed || !known.has_failed)) {
      if (!has_failed && known.digest != timeless_digest(record)) {
        throw InputError(folder.root.string() + ": the record of " + place->first +
                         " says something else than that in " + known.folder->root.string() +
                         ": one of them was not written by this version of nbvopt; leave one out");
      }
      return Answer::is_known;
    }
    known = {&folder, has_failed, has_failed ? std::string() : timeless_digest(record)};
    return Answer::is_new;
  }

 private:
  struct Known {
    const StudyFolder* folder = nullptr;
    bool has_failed = false;
    std::string digest;  ///< of an answer, without what depends on time
  };

  /// Answers within a time limit depend on it; they agree whatever they are.
  static std::string timeless_digest(const Json& record) {
    if (!record.value("time_limit_ms", Json()).is_null()) return {};
    Json timeless = record;
    timeless.erase("times");
    return experiment::digest(timeless.dump());
  }

  std::unordered_map<std::string, Known> known_;
};

using RecordPath = std::filesystem::path (StudyFolder::*)() const;

/// Passes over the records of one kind in all folders, in order: visit(record, folder, is_new).
template <class Visit>
void for_each_of(const std::vector<const StudyFolder*>& folders, RecordPath path,
                 const Visit& visit) {
  KnownRecords known;
  for (const StudyFolder* folder : folders) {
    experiment::for_each_record((folder->*path)(), [&](const Json& record) {
      visit(record, *folder, known.take(record, *folder) == KnownRecords::Answer::is_new);
    });
  }
}

}  // namespace

MergeCount merge_studies(std::span<const StudyFolder> parts, const StudyFolder& into) {
  std::optional<FileLock> lock;
  const auto take_lock = [&] { lock.emplace(into.study(), "run writes this study"); };
  std::vector<const StudyFolder*> folders;
  if (std::filesystem::exists(into.study())) {
    take_lock();
    folders.push_back(&into);
  }
  for (const StudyFolder& part : parts) {
    if (!lock || !std::filesystem::equivalent(part.root, into.root)) folders.push_back(&part);
  }

  const Json study = placeless_study(*folders.front());
  for (const StudyFolder* other : folders) require_same_study(study, *folders.front(), *other);
  constexpr std::array<RecordPath, 2> kKinds{&StudyFolder::records, &StudyFolder::references};
  for (const RecordPath kind : kKinds) {
    for_each_of(folders, kind, [](const Json&, const StudyFolder&, bool) {});
  }

  if (!lock) {
    create_folder(into.root);
    take_lock();
    write_study(read_study(*folders.front()), into);
  }
  MergeCount count;
  for (const RecordPath kind : kKinds) {
    std::size_t& added = kind == &StudyFolder::records ? count.records : count.references;
    experiment::RecordFile file((into.*kind)());
    for_each_of(folders, kind, [&](const Json& record, const StudyFolder& folder, bool is_new) {
      if (&folder == &into) return;
      ++(is_new ? added : count.repeated);
      if (is_new) file.append(record);
    });
  }
  return count;
}

}  // namespace nbvopt::study
