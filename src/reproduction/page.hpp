// The reproduction as one page to publish: charts, maps side by side, and all tables.
#pragma once

#include <span>
#include <string>

#include "reproduction/record.hpp"
#include "reproduction/table.hpp"

namespace nbvopt {

/// HTML that needs no other file: pictures stand within it. The maps are those that the units'
/// episodes drew; one that is not there is left out.
std::string to_html(const ReproductionTable& table, std::span<const Unit> units,
                    std::span<const UnitResult> results);

}  // namespace nbvopt
