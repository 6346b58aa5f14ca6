#include "experiment/merge.hpp"

#include <unordered_map>

#include "experiment/digest.hpp"
#include "experiment/record_file.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt::experiment {
namespace {

/// The records of one kind that are known, by their unit.
class KnownRecords {
 public:
  explicit KnownRecords(const RecordKind& kind) : kind_(kind) {}

  /// Whether a record of the folder says something new. Throws InputError when it contradicts
  /// another's.
  bool take(const Json& record, const std::filesystem::path& folder) {
    const bool has_failed = record.contains("failure");
    const auto [place, is_new] = known_.try_emplace(kind_.id(record));
    Known& known = place->second;
    if (!is_new && (has_failed || !known.has_failed)) {
      if (!has_failed && known.digest != repeatable_digest(record)) {
        throw InputError(folder.string() + ": the record of " + place->first +
                         " says something else than that in " + known.folder->string() +
                         ": one of them was not written by this version of nbvopt; leave one out");
      }
      return false;
    }
    known = {&folder, has_failed, has_failed ? std::string() : repeatable_digest(record)};
    return true;
  }

 private:
  struct Known {
    const std::filesystem::path* folder = nullptr;
    bool has_failed = false;
    std::string digest;  ///< of an answer
  };

  std::string repeatable_digest(const Json& record) const {
    return digest(kind_.repeatable(record).dump());
  }

  const RecordKind& kind_;
  std::unordered_map<std::string, Known> known_;
};

}  // namespace

void require_agreement(std::span<const std::filesystem::path> folders, const RecordKind& kind) {
  KnownRecords known(kind);
  for (const std::filesystem::path& folder : folders) {
    for_each_record(folder / kind.file, [&](const Json& record) { known.take(record, folder); });
  }
}

MergeCount merge_records(std::span<const std::filesystem::path> parts,
                         const std::filesystem::path& into, const RecordKind& kind) {
  KnownRecords known(kind);
  RecordFile file(into / kind.file);
  for_each_record(into / kind.file, [&](const Json& record) { known.take(record, into); });
  MergeCount count;
  for (const std::filesystem::path& part : parts) {
    for_each_record(part / kind.file, [&](const Json& record) {
      const bool is_new = known.take(record, part);
      ++(is_new ? count.added : count.repeated);
      if (is_new) file.append(record);
    });
  }
  return count;
}

}  // namespace nbvopt::experiment
