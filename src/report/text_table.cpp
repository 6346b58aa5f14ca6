#include "report/text_table.hpp"

#include <array>
#include <cmath>
#include <cstdio>

namespace nbvopt {
namespace {

std::string escaped(const std::string& text) {
  std::string escaped;
  for (const char letter : text) {
    if (letter == '|') escaped += '\\';
    escaped += letter;
  }
  return escaped;
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char letter : text) {
    if (letter == '"') quoted += '"';
    quoted += letter;
  }
  return quoted + '"';
}

std::string exact(const TableCell& cell) {
  if (is_text_cell(cell)) return quoted(std::get<std::string>(cell));
  const double value = std::get<double>(cell);
  return std::isnan(value) ? "" : format_number(value);
}

}  // namespace

std::string p_digits(double value) {
  if (value < 1e-15) return "< 1e-15";
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2g", value);
  return text.data();
}

bool is_text_cell(const TableCell& cell) { return std::holds_alternative<std::string>(cell); }

std::string shown(const TableCell& cell, const TableColumn& column) {
  if (is_text_cell(cell)) return std::get<std::string>(cell);
  const double value = std::get<double>(cell);
  if (std::isnan(value)) return "-";
  return std::isinf(value) ? "never" : column.show(value);
}

std::string to_markdown(const TextTable& table) {
  std::string head = "|";
  std::string rule = "|";
  std::vector<std::string> lines(table.rows.size(), "|");
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const TableColumn& column = table.columns[i];
    if (column.heading.empty()) continue;
    head += ' ' + escaped(column.heading) + " |";
    rule += !table.rows.empty() && is_text_cell(table.rows.front()[i]) ? " --- |" : " ---: |";
    for (std::size_t row = 0; row < lines.size(); ++row) {
      lines[row] += ' ' + escaped(shown(table.rows[row][i], column)) + " |";
    }
  }
  std::string text = head + '\n' + rule + '\n';
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

std::string to_csv(const TextTable& table) {
  std::string text;
  const auto add_line = [&](const auto& cell_text) {
    std::string line;
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      if (!table.columns[i].key.empty()) line += ',' + cell_text(i);
    }
    text += line.erase(0, 1) + '\n';
  };
  add_line([&](std::size_t i) { return quoted(table.columns[i].key); });
  for (const std::vector<TableCell>& row : table.rows) {
    add_line([&](std::size_t i) { return exact(row[i]); });
  }
  return text;
}

}  // namespace nbvopt
