// A study as a file: with its maps found and its starts drawn, so that its units can be told again.
#pragma once

#include <filesystem>

#include "study/study.hpp"
#include "study/unit_message.hpp"

namespace nbvopt::study {

/// Where the things of a study lie in its folder.
struct StudyFolder {
  std::filesystem::path root;

  std::filesystem::path study() const { return root / "study.json"; }
  std::filesystem::path robot() const { return root / "robot.yaml"; }
  std::filesystem::path records() const { return root / "records.jsonl"; }
  std::filesystem::path references() const { return root / "references.jsonl"; }
  std::filesystem::path report() const { return root / "report"; }
};

/// Writes study and robot into the folder. Throws InputError when that fails.
void write_study(const Study& study, const StudyFolder& folder);

/// Reads them back. Throws InputError that names the file when they are missing or damaged.
Study read_study(const StudyFolder& folder);

}  // namespace nbvopt::study
