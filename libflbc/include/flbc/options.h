// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! What a caller may choose.
#pragma once

#include <functional>

#include "flbc/distance_weights.h"
#include "flbc/linear_solver.h"

namespace flbc {

//! How the coordinates are computed.
enum class Method {
  kAuto,      //!< the method recommended for most uses, at present kValue
  kValue,     //!< splitting on the weights in the metric of the continuous problem: the fastest
  kGradient,  //!< the paper's gradient ADMM, started from harmonic coordinates, over-relaxed
  kPaper,     //!< the same with the paper's start, parameters and recovery, to the letter
  kLbc2014,   //!< the original solver (section 3 of the paper; Zhang et al. 2014)
  kHarmonic,  //!< harmonic coordinates (Joshi et al. 2007), for comparison
  kMeanValue  //!< mean value coordinates (Floater 2003, Ju et al. 2005), for comparison
};

//! What becomes of w >= 0. On a mesh the optimum without it may be negative, in 3D noticeably.
enum class NonNegative {
  kAuto,        //!< kConstraint where the method has it, kProject for kGradient, else kOff
  kConstraint,  //!< a constraint of the iteration; delivered weights are then projected as well
  kProject,     //!< each row is replaced by the nearest one that is feasible and not negative
  kOff          //!< neither: the paper's problem
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
  int iteration;           //!< counted from 1
  double primal_residual;  //!< norm of r_p, or estimated error, divided by its threshold
  double dual_residual;    //!< norm of r_d divided by its threshold; 0 where there is none
  int finer_levels = 0;    //!< meshes still to come after this one (coarse_to_fine.h)
};

//! Options of solve(). The defaults suit every cage.
struct SolverOptions {
  Method method = Method::kAuto;                  //!< how the coordinates are computed
  DistanceScheme phi = DistanceScheme::kSquare;   //!< growth of the weight functions phi
  Precision precision = Precision::kSingle;       //!< of the iteration
  Recovery recovery = Recovery::kAuto;            //!< for the methods whose unknowns are gradients
  NonNegative non_negative = NonNegative::kAuto;  //!< what becomes of w >= 0
  LinearSolver linear_solver = LinearSolver::kAuto;  //!< for the methods that split on the weights

  //! How accurate, > 0; 0 = by method.
  //! - kValue: mean squared error of the weights (the paper's (5)), as estimated from how much an
  //!   iteration changes them; 1e-7 by default.
  //! - kGradient: root mean square of the primal residual's components (the dual's: 10 times as
  //!   much); 2.5e-5 by default.
  //! - kPaper, kLbc2014: as section 5 of the paper says, norms at most N_p tolerance and 10 N_d
  //!   tolerance; by default the paper's 1e-7, and 5e-8 for kLbc2014.
  double tolerance = 0;

  //! Largest number of iterations, >= 1; reaching it is reported, not an error.
  int max_iterations = 20000;

  //! Penalty of the augmented Lagrangian, for a domain scaled to radius 250; 0 = by method, which
  //! for kValue and kLbc2014 means chosen from the mesh.
  double penalty = 0;

  //! Over-relaxation in (0, 2), 1 = none; 0 = by method.
  double relaxation = 0;

  //! Iterations between two evaluations of the residuals, >= 1.
  int check_interval = 10;

  //! Whether to compute a lower bound of the optimal objective as well; needs an iterative method.
  bool certify = false;

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
