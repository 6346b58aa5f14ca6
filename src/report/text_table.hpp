// Tables as text: for people in Markdown, for machines in CSV.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "core/number.hpp"

namespace nbvopt {

struct TableColumn {
  std::string key;                        ///< for machines; empty: not for them
  std::string heading;                    ///< for people; empty: not for them
  std::string (*show)(double) = grouped;  ///< a finite figure for people
};

/// NaN is a figure that is missing.
using TableCell = std::variant<std::string, double>;

struct TextTable {
  std::vector<TableColumn> columns;
  std::vector<std::vector<TableCell>> rows;  ///< a cell a column
};

/// Figures are rounded; "-" where they are missing, and "never" where they are infinite.
std::string to_markdown(const TextTable& table);

/// Figures read back to the same bits; empty where they are missing, and "inf". Texts are quoted
/// where they need it (RFC 4180).
std::string to_csv(const TextTable& table);

}  // namespace nbvopt
