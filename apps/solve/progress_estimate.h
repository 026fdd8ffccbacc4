// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! How far an iteration is, and how long it will take.
#pragma once

#include <string>

#include "flbc/options.h"

namespace flbc::app {

//! Progress from the arguments of a progress callback. Residuals fall about geometrically, so their
//! logarithm shows how much is done; what has been reached once is never taken back.
class ProgressEstimate {
 public:
  //! \param options  of the solve
  explicit ProgressEstimate(const SolverOptions& options);

  //! \param seconds  since the start
  void update(const Progress& progress, double seconds);

  //! The same of a stage besides the iteration. \param name  for the line \param done  in [0, 1]
  void update_stage(const std::string& name, double done, double seconds);

  //! The part of the way that is done, in [0, 1].
  double done() const { return done_; }

  //! A line of at most 79 characters, ASCII only: the stage until the first update, then a bar,
  //! the time left and, of an iteration, the estimated error or the residual.
  //! \param seconds  since the start
  std::string line(const std::string& stage, double seconds) const;

 private:
  std::string stage_line(double seconds) const;

  double tolerance_ = 0;  // of the estimated error; 0 for methods without one
  bool started_ = false;
  Progress last_{};
  int levels_ = 0;           // meshes in all
  double first_excess_ = 0;  // log of residual / threshold when the mesh was new
  double done_ = 0;
  double first_seconds_ = 0;  // when the iteration began
  double last_seconds_ = 0;   // at the last update
  double interval_ = 0;       // the longest between two updates
  std::string stage_{};       // the one besides the iteration that goes on
  double stage_begin_ = 0;    // in seconds
  double stage_done_ = 0;
};

}  // namespace flbc::app
