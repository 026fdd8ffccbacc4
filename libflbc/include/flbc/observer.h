// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Callbacks to observe and stop a solve.
#pragma once

#include <functional>

namespace flbc {

//! Progress of a run.
struct Progress {
  int iteration;                    //!< counted from 1
  double relative_primal_residual;  //!< |r_p| or estimated error, divided by its threshold
  double relative_dual_residual;    //!< |r_d| divided by its threshold; 0 if the method has none
  int finer_levels = 0;             //!< number of meshes or parts that follow this one
  //! Computes the objective of the current weights, in the units of SolveReport::objective. A call
  //! takes as long as one or two iterations. Valid only during the callback.
  std::function<double()> objective{};
};

//! Stages of a solve, other than the iteration, that may take long.
enum class Stage {
  kDistances,    //!< geodesic distances for phi
  kNonNegative,  //!< projection of the final weights
  kCertificate   //!< lower bound at the end
};

//! Callbacks of a solve. They run on the calling thread; each may be empty.
struct Observer {
  //! Called every ten iterations; returning false stops the run. May throw: the
  //! exception leaves the solve.
  std::function<bool(const Progress&)> progress{};

  //! Called before every iteration of Method::kWeights, at least every ten iterations of other
  //! methods, and very often during stages. Throw to cancel the solve without a result.
  std::function<void()> poll{};

  //! Called repeatedly during a stage with its progress in [0, 1]. May throw, as poll().
  std::function<void(Stage stage, double done)> stage{};
};

//! Limits the cost of one solve, for example to get one result per frame while a user drags a
//! control point. A solve makes at least one iteration. The first one also solves the coarse
//! mesh of a refined one to the end.
struct Budget {
  int iterations = 0;  //!< maximum number, >= 1; 0 = as in the options
  double seconds = 0;  //!< no iteration starts after this time, setup included; checked every ten
                       //!< iterations of kGradient, kPaper, and kLbc2014. 0 = no limit. Results
                       //!< then depend on machine speed.
};

}  // namespace flbc
