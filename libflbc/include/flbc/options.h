// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! What a caller may choose.
#pragma once

#include <functional>

#include "flbc/distance_weights.h"

namespace flbc {

//! How the coordinates are computed.
enum class Method {
  kAuto,      //!< the method recommended for most uses, at present kGradient
  kGradient,  //!< the paper's gradient ADMM, started from harmonic coordinates, over-relaxed
  kPaper,     //!< the same with the paper's start, parameters and recovery, to the letter
  kHarmonic   //!< harmonic coordinates (Joshi et al. 2007), for comparison
};

//! Arithmetic of the iteration; set-up and recovery are always in double precision.
enum class Precision { kSingle, kDouble };

//! How weights are recovered from gradients.
enum class Recovery {
  kAuto,          //!< kBreadthFirst for Method::kPaper, else kLeastSquares
  kBreadthFirst,  //!< integration from the boundary, level by level (4.2.2 of the paper)
  kLeastSquares   //!< the weights whose gradients are nearest, by one Poisson solve
};

//! State of a run, handed to the progress callback.
struct Progress {
  int iteration;
  double primal_residual;  //!< Euclidean norm of r_p divided by its threshold
  double dual_residual;    //!< Euclidean norm of r_d divided by its threshold
};

//! Options of solve(). The defaults suit every cage.
struct SolverOptions {
  Method method = Method::kAuto;
  DistanceScheme phi = DistanceScheme::kSquare;
  Precision precision = Precision::kSingle;
  Recovery recovery = Recovery::kAuto;

  //! Residual threshold, > 0. kGradient ends when the root mean square of the primal residual's
  //! components is at most the tolerance and that of the dual residual's at most 10 times as much,
  //! which asks the same accuracy of every mesh. kPaper ends as section 5 of the paper says: norms
  //! at most N_p tolerance and 10 N_d tolerance. 0 = by method: 3e-5 for kGradient, the paper's 1e-7
  //! for kPaper.
  double tolerance = 0;

  //! Largest number of iterations, >= 1; reaching it is reported, not an error.
  int max_iterations = 20000;

  //! Penalty mu of the augmented Lagrangian, for a domain scaled to radius 250; 0 = by method.
  double penalty = 0;

  //! Over-relaxation in (0, 2), 1 = none; 0 = by method.
  double relaxation = 0;

  //! Iterations between two evaluations of the residuals, >= 1.
  int check_interval = 10;

  //! Number of threads; 0 = as many as OpenMP offers.
  int threads = 0;

  //! Called whenever residuals are evaluated; returning false stops the run.
  std::function<bool(const Progress&)> progress{};
};

//! \throws OptionError naming the field and its valid range
void validate(const SolverOptions& options);

//! The options with every "by method" filled in for dimension `dim`.
SolverOptions resolve(SolverOptions options, int dim);

}  // namespace flbc
