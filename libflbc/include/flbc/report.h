// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! What a run tells about itself.
#pragma once

#include "flbc/options.h"
#include "flbc/types.h"

namespace flbc {

//! How a run ended. Every status comes with usable weights.
enum class SolveStatus {
  kConverged,       //!< both residuals fell below their thresholds
  kIterationLimit,  //!< max_iterations was reached first
  kStopped          //!< the progress callback asked to stop
};

//! Wall-clock seconds of the stages.
struct StageSeconds {
  double setup = 0;    //!< topology, boundary values, phi
  double solve = 0;    //!< the iteration with its set-up and start
  double recover = 0;  //!< from gradients to weights
};

//! Properties of weights, measured on the weights themselves.
struct Quality {
  double min_weight = 0;
  double max_partition_error = 0;     //!< max |sum_i w_i - 1|
  double max_reproduction_error = 0;  //!< max |sum_i w_i c_i - x| / size of the cage
  double mean_influences = 0;         //!< mean number of |w_i| > 1e-4 per point
};

//! Result of solve() beside the weights.
struct SolveReport {
  Method method = Method::kAuto;  //!< the method used, never kAuto
  SolveStatus status = SolveStatus::kConverged;
  Index control_points = 0;
  Index vertices = 0;
  Index cells = 0;
  int iterations = 0;
  double primal_residual = 0;  //!< |r_p| divided by its threshold
  double dual_residual = 0;    //!< |r_d| divided by its threshold
  double objective =
      0;  //!< of the weights: sum_s sum_i phi A |grad w_i|, in units of the mesh^(dim - 1)
  double numbers_per_cell = 0;  //!< state of the iteration, per cell and control point
  StageSeconds seconds{};
  Quality quality{};
};

}  // namespace flbc
