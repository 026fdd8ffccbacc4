// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Collects the rows of one experiment.
#pragma once

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "paper/context.h"
#include "paper/csv.h"
#include "paper/machine.h"

namespace flbc::bench {

class ResultTable {
 public:
  ResultTable(const Context& context, std::string name, std::vector<std::string> columns)
      : context_(context), name_(std::move(name)), columns_(std::move(columns)) {}

  const std::string& name() const { return name_; }

  //! A row as a line of text, to be handed from a child process to add().
  std::string line(const Row& row) const { return csv_line(columns_, row); }

  //! Lines, or nothing from a child process that failed.
  void add(const std::optional<std::string>& lines) {
    if (!lines) {
      complete_ = false;
      return;
    }
    lines_ += *lines;
    std::printf("%s", lines->c_str());
    std::fflush(stdout);
  }

  //! Writes OUT/NAME.csv. \param about  a comment line \return whether all rows are there
  bool write(const std::string& about) const {
    std::vector<std::string> comments{about, describe_machine(context_.threads)};
    if (!context_.commit.empty()) comments.push_back("commit " + context_.commit);
    if (context_.busy) comments.push_back("busy machine: seconds are too long");
    if (context_.quick) comments.push_back("quick run: small meshes, few iterations");
    if (!context_.only_models.empty()) comments.push_back("only models that were asked for");
    if (!complete_) comments.push_back("incomplete: some cases failed");
    write_csv(context_.out + "/" + name_ + ".csv", comments, columns_, lines_);
    return complete_;
  }

 private:
  const Context& context_;
  std::string name_;
  std::vector<std::string> columns_;
  std::string lines_;
  bool complete_ = true;
};

}  // namespace flbc::bench
