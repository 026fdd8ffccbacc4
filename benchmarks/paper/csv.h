// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Comma-separated tables with named columns.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace flbc::bench {

//! Cells by the name of their column.
using Row = std::map<std::string, std::string>;

//! 6 significant digits; empty if not finite.
std::string number(double value);

//! A line of the table, ended. Columns that the row lacks stay empty.
//! \throws std::invalid_argument if a name is no column or a cell holds a comma or line end
std::string csv_line(const std::vector<std::string>& columns, const Row& row);

//! Writes the file whole or not at all: comment lines, the columns' names, the lines.
//! \param comments  without the leading '#' \param lines  made by csv_line() \throws IoError
void write_csv(const std::string& path, const std::vector<std::string>& comments,
               const std::vector<std::string>& columns, const std::string& lines);

}  // namespace flbc::bench
