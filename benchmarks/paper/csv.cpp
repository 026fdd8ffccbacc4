// SPDX-License-Identifier: BSD-3-Clause
#include "paper/csv.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>
#include <stdexcept>

#include "flbc/io/files.h"

namespace flbc::bench {

std::string number(double value) {
  if (!std::isfinite(value)) return "";
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string csv_line(const std::vector<std::string>& columns, const Row& row) {
  for (const auto& [name, cell] : row) {
    if (std::find(columns.begin(), columns.end(), name) == columns.end()) {
      throw std::invalid_argument("the table has no column " + name);
    }
    if (cell.find_first_of(",\n") != std::string::npos) {
      throw std::invalid_argument("a cell cannot hold '" + cell + "'");
    }
  }
  std::string line;
  for (const auto& name : columns) {
    const auto cell = row.find(name);
    if (&name != &columns.front()) line += ',';
    if (cell != row.end()) line += cell->second;
  }
  return line + '\n';
}

void write_csv(const std::string& path, const std::vector<std::string>& comments,
               const std::vector<std::string>& columns, const std::string& lines) {
  std::string header;
  for (const auto& name : columns) header += (header.empty() ? "" : ",") + name;
  io::write_file(path, [&](std::ostream& file) {
    for (const auto& comment : comments) file << "# " << comment << '\n';
    file << header << '\n' << lines;
  });
}

}  // namespace flbc::bench
