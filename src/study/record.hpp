// What a study keeps of a unit of work: docs/guide/studies.md describes both records.
#pragma once

#include "experiment/work.hpp"
#include "study/fingerprints.hpp"
#include "study/study.hpp"
#include "study/study_file.hpp"

namespace nbvopt::study {

/// The version of the records' schema.
inline constexpr int kRecordVersion = 1;

Json query_record(const Study& study, const UnitIndex& unit, Fingerprints& fingerprints,
                  const experiment::Outcome& outcome);
Json reference_record(const Study& study, std::size_t case_index, Fingerprints& fingerprints,
                      const experiment::Outcome& outcome);

/// The unit's fingerprint, or the case's. Throws InputError for a record of another schema.
std::string record_id(const Json& record);

/// Reads what a study's folder holds. Records of units that the study does not have are passed
/// over; of several of a unit the last one counts. Throws InputError when a record is damaged.
/// Measured against the upper bound, it is the bound that stands for each case's reference.
Results read_results(const Study& study, const StudyFolder& folder,
                     Against against = Against::best_known);

}  // namespace nbvopt::study
