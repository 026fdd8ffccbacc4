// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Watching and stopping a solve.
#pragma once

#include <functional>

namespace flbc {

//! Where a run is.
struct Progress {
  int iteration;           //!< counted from 1
  double primal_residual;  //!< norm of r_p, or estimated error, divided by its threshold
  double dual_residual;    //!< norm of r_d divided by its threshold; 0 where there is none
  int finer_levels = 0;    //!< meshes or parts still to come after this one
  //! Objective of the present weights, in the units of SolveReport::objective. It is computed when
  //! called, which takes as long as an iteration or two; valid during the callback only.
  std::function<double()> objective{};
};

//! Parts of a solve besides the iteration that may take long.
enum class Stage {
  kDistances,    //!< those behind phi
  kNonNegative,  //!< the weights of the last iteration are projected
  kCertificate   //!< the lower bound at the end
};

//! Callbacks of a solve, made by the calling thread; each may be empty.
struct Observer {
  //! Called whenever residuals are evaluated; returning false stops the run.
  std::function<bool(const Progress&)> progress{};

  //! Called from time to time during a stage with the part in [0, 1] that is done. Must not throw.
  std::function<void(Stage stage, double done)> stage{};
};

}  // namespace flbc
