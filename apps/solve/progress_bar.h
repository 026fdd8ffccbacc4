// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! A line on standard error that shows what is being done, and for how long.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "flbc/options.h"

namespace flbc::app {

//! The stage of meshing, of which only the time limit is known.
//! \param limit  seconds of a run of the mesher
std::string meshing_stage(double limit);

//! Draws only if standard error is a terminal and `quiet` is false, and only what takes longer than
//! a second; removes its line when destroyed. A thread of its own keeps the line alive where
//! there is no progress to show.
class ProgressBar {
 public:
  ProgressBar(bool quiet, std::string stage);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  //! Of the iteration.
  void show(const Progress& progress);

  //! \param done  the part of the stage, in [0, 1]
  void show(const std::string& stage, double done);

 private:
  void replace(std::string text);
  void draw_until_ended();

  std::string text_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  bool ended_ = false;
  bool drawn_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::thread drawer_;  // none if nothing is to be drawn
};

}  // namespace flbc::app
