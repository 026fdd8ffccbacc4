// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! A file that keeps the state of a solve, so that the same command goes on from it.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "files/held_signals.h"
#include "flbc/options.h"
#include "report/history.h"
#include "solve/checkpoint_settings.h"
#include "solve/weights_cache.h"

namespace flbc::app {

//! Mesh, state and history of a solve that was interrupted.
template <int Dim>
struct KeptRun {
  SolvedDomain<Dim> solved{};  //!< without weights
  std::vector<HistoryEntry> history{};
  int iteration = 0;
  std::string state{};  //!< for SolverOptions::resume_from
};

//! Reads and writes the file of one solve, and holds signals back while there is a state to write.
template <int Dim>
class Checkpoint {
 public:
  //! \param lines  that tell what the solve depends on, see lines_of()
  Checkpoint(CheckpointSettings settings, std::string lines)
      : settings_(std::move(settings)), lines_(std::move(lines)) {}

  //! The run whose state is in the file; none without file.
  //! \throws InputError naming the file if it is damaged or of another run; IoError
  std::optional<KeptRun<Dim>> find() const;

  //! Writes the state if it is time to or a signal came. Says on standard error if that fails,
  //! which does not end the solve. \return whether a signal came, after which the program is to end
  //! by end()
  bool look(const Progress& progress, const SolvedDomain<Dim>& solved,
            const std::vector<HistoryEntry>& history);

  //! Says how to go on, and ends the program by the signal that came.
  void end();

  //! A signal ends the program from now on as ever; one that came meanwhile does at once.
  void release_signals() { signals_.reset(); }

  //! Once the results are written.
  void remove() const;

 private:
  void write(const Progress& progress, const SolvedDomain<Dim>& solved,
             const std::vector<HistoryEntry>& history);

  CheckpointSettings settings_;
  std::string lines_;
  std::optional<HeldSignals> signals_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  int iteration_ = 0;  // of the state in the file; 0 for none
};

}  // namespace flbc::app
