// SPDX-License-Identifier: BSD-3-Clause
// What all experiments share: settings, processes, rows of a table, time, and memory.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/stopwatch.h"
#include "flbc/types.h"

namespace flbc::bench {

struct Context {
  std::string models;  //!< folder of the cages, with 2d/ and 3d/
  std::string out;     //!< folder of all results
  bool quick = false;  //!< small meshes and few iterations, to see that everything works
  bool busy = false;   //!< other programs run on the machine, which the results have to say
  int threads = 1;
  std::string commit{};  //!< of the sources, for the results to name; may be empty
  std::vector<std::string> only_models{};  //!< names of those to measure; empty for all

  bool wants(const std::string& model) const {
    return only_models.empty() ||
           std::find(only_models.begin(), only_models.end(), model) != only_models.end();
  }

  //! Number of vertices for a mesh that has `full` in a full run.
  Index size(Index full) const { return quick ? std::min(full, 1500 + full / 100) : full; }

  //! Most iterations of a method that has `full` in a full run.
  int iterations(int full) const { return quick ? std::min(full, 200) : full; }
};

//! Cells of a line, each with the name of its column.
class Row {
 public:
  //! \param cell  without commas and line ends
  Row& add(const std::string& column, const std::string& cell) {
    cells_.emplace_back(column, cell);
    return *this;
  }

  //! 6 significant digits; an empty cell if the number is not finite.
  template <class Number, class = std::enable_if_t<std::is_arithmetic_v<Number>>>
  Row& add(const std::string& column, Number number) {
    if constexpr (std::is_floating_point_v<Number>) return add(column, text_of(number));
    return add(column, std::to_string(number));
  }

  const std::vector<std::pair<std::string, std::string>>& cells() const { return cells_; }

 private:
  static std::string text_of(double number);

  std::vector<std::pair<std::string, std::string>> cells_;
};
using Rows = std::vector<Row>;

//! Runs `body` in a child process: its peak memory is its own, nothing is warm from the measurement
//! before, and a failure ends one row, not the program. The caller must not have used OpenMP, which
//! does not survive a fork. \param what  for messages
//! \return what `body` returned, or nothing after a message on stderr if it threw or crashed
std::optional<Rows> in_child(const std::string& what, const std::function<Rows()>& body);

class ResultTable {
 public:
  ResultTable(const Context& context, std::string name)
      : context_(context), name_(std::move(name)) {}

  const Context& context() const { return context_; }
  const std::string& name() const { return name_; }

  //! Rows, or nothing from a child process that failed.
  void add(const std::optional<Rows>& rows);

  //! Writes OUT/NAME.csv, whole or not at all. Its columns are those of all rows.
  //! \param about  a comment line \return whether all rows are there \throws IoError
  bool write(const std::string& about) const;

 private:
  const Context& context_;
  std::string name_;
  Rows rows_;
  bool complete_ = true;
};

int available_cores();

//! Resident memory now, in MiB, after freed memory went back to the system.
double resident_mebibytes();

//! Largest resident memory in MiB since the process began or the last reset_peak().
double peak_mebibytes();

//! Starts the peak anew. Where the system refuses, the peak stays that of the whole process.
void reset_peak();

}  // namespace flbc::bench
