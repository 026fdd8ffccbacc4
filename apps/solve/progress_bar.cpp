// SPDX-License-Identifier: BSD-3-Clause
#include "solve/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace flbc::app {

ProgressBar::ProgressBar(bool quiet) : visible_(!quiet && isatty(STDERR_FILENO) != 0) {
}

ProgressBar::~ProgressBar() {
  if (drawn_) std::fprintf(stderr, "\r\033[K");
}

void ProgressBar::show(const Progress& progress) {
  if (!visible_) return;
  // Residuals fall about geometrically, so their logarithm tells how much of the way is done.
  const double excess = std::log(std::max({progress.primal_residual, progress.dual_residual, 1.0}));
  // On meshes of a coarse-to-fine start it fills anew.
  if (!drawn_ || progress.finer_levels != finer_levels_) first_excess_ = std::max(excess, 1e-9);
  drawn_ = true;
  finer_levels_ = progress.finer_levels;
  constexpr int kWidth = 40;
  const double done = std::clamp(1 - excess / first_excess_, 0.0, 1.0);
  const auto filled = static_cast<std::size_t>(done * kWidth);
  std::fprintf(stderr, "\r\033[K[%s%s] %siteration %d, residuals %.3g and %.3g of their thresholds",
               std::string(filled, '#').c_str(), std::string(kWidth - filled, '.').c_str(),
               progress.finer_levels > 0 ? "coarse mesh, " : "", progress.iteration,
               progress.primal_residual, progress.dual_residual);
  std::fflush(stderr);
}

}  // namespace flbc::app
