// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! A line on standard error that shows what is being done and how far it is.
#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "flbc/options.h"
#include "solve/progress_estimate.h"

namespace flbc::app {

//! The stage of meshing, of which only the time limit is known.
//! \param limit  seconds of a run of the mesher
std::string meshing_stage(double limit);

//! Draws only if standard error is a terminal and `quiet` is false, and only what takes longer than
//! a second; removes its line when destroyed. A thread of its own keeps the line alive where
//! there is no progress to show.
class ProgressBar {
 public:
  //! \param stage  as "meshing"; once show() is called, the iteration takes its place
  //! \param options  of the solve that show() is called for
  ProgressBar(bool quiet, std::string stage, const SolverOptions& options = {});
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(const Progress& progress);

  //! Of a stage besides the iteration. \param done  the part of it, in [0, 1]
  void show(const std::string& stage, double done);

 private:
  using Clock = std::chrono::steady_clock;

  void draw_until_ended();
  void draw();

  std::string stage_;
  ProgressEstimate estimate_;
  Clock::time_point start_ = Clock::now();
  bool ended_ = false;
  bool drawn_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::thread drawer_;  // none if nothing is to be drawn
};

}  // namespace flbc::app
