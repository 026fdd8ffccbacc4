// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! A line on standard error that shows how far the iteration is.
#pragma once

#include "flbc/options.h"

namespace flbc::app {

//! Draws only if standard error is a terminal and `quiet` is false; ends its line when destroyed.
class ProgressBar {
 public:
  explicit ProgressBar(bool quiet);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(const Progress& progress);

 private:
  bool visible_;
  bool drawn_ = false;
  int finer_levels_ = 0;
  double first_excess_ = 0;  // log of residual / threshold when first shown
};

}  // namespace flbc::app
