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
  std::string origin{};  //!< commit of the sources and behavior of the program; may be empty
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

//! OUT/NAME.csv, written whole after each case, so that a run that was stopped resumes there.
class ResultTable {
 public:
  //! Keeps the cases of a file of the same commit, behavior, machine, and options. Sources that
  //! differ from their commit have no name of their own, so nothing is kept then.
  //! \param about  a comment line
  ResultTable(const Context& context, std::string name, const std::string& about);

  const Context& context() const { return context_; }
  const std::string& name() const { return name_; }

  //! Whether the file had this case.
  bool has(const std::string& which) const;

  //! Adds the rows of a case that is not there yet, made in a child process.
  //! \param which  cell of the column `case` \param body  () -> Rows \throws IoError
  void add(const std::string& which, const std::function<Rows()>& body);

  //! Marks the file as complete unless a case failed. \return whether it is \throws IoError
  bool finish();

 private:
  void write() const;

  const Context& context_;
  std::string name_;
  std::vector<std::string> comments_;
  Rows rows_;
  bool failed_ = false;
  bool finished_ = false;
};

int available_cores();

//! Largest resident memory in MiB since the process began.
double peak_mebibytes();

}  // namespace flbc::bench
