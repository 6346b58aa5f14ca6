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

/// Two significant digits, as p values are read; less than rounding knows is not told.
std::string p_digits(double value);

/// NaN is a figure that is missing.
using TableCell = std::variant<std::string, double>;

struct TextTable {
  std::vector<TableColumn> columns;
  std::vector<std::vector<TableCell>> rows;  ///< a cell a column
};

bool is_text_cell(const TableCell& cell);

/// A cell as people see it, in no language's quotes.
std::string shown(const TableCell& cell, const TableColumn& column);

/// Figures are rounded; "-" where they are missing, and "never" where they are infinite.
std::string to_markdown(const TextTable& table);

/// Figures read back to the same bits; empty where they are missing, and "inf". Texts are quoted
/// where they need it (RFC 4180).
std::string to_csv(const TextTable& table);

}  // namespace nbvopt
