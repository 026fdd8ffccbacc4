// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Options of a solve.
#pragma once

#include <optional>

#include "flbc/coarse_to_fine.h"
#include "flbc/distance_weights.h"
#include "flbc/types.h"

namespace flbc {

//! How the coordinates are computed.
enum class Method {
  kAuto,      //!< the method recommended for most uses, at present kValue
  kValue,     //!< splitting on the weights in the metric of the continuous problem: the fastest
  kGradient,  //!< the paper's gradient ADMM, started from harmonic coordinates, over-relaxed
  //! The paper's gradient ADMM with its parameters. What the paper leaves open is in
  //! docs/explanation/method/differences_from_papers.md.
  kPaper,
  kLbc2014,   //!< the original solver (section 3 of the paper; Zhang et al. 2014)
  kHarmonic,  //!< harmonic coordinates (Joshi et al. 2007), for comparison
  kMeanValue  //!< mean value coordinates (Floater 2003, Ju et al. 2005), for comparison
};

//! Treatment of w >= 0. On a mesh the optimum without it may be negative, in 3D noticeably.
enum class NonNegative {
  kAuto,        //!< kConstraint where the method has it, kProject for kGradient, else kOff
  kConstraint,  //!< a constraint of the iteration; delivered weights are then projected as well
  kProject,     //!< each row is replaced by the nearest one that is feasible and not negative
  kOff          //!< neither: the paper's problem
};

//! Numbers of the iteration. Setup and recovery always use double precision.
enum class Precision {
  kAuto,    //!< kSingle; Method::kValue stores duals of cells in half precision where that is safe
  kSingle,  //!< float
  kDouble   //!< double
};

//! Where the distances come from that the weight functions phi are made of.
enum class Distances {
  kAuto,         //!< kInterpolated for Method::kValue, where it costs less and keeps the tolerance
  kExact,        //!< the mesh itself
  kInterpolated  //!< a coarser mesh of the cage, by their detours round the boundary; needs a
                 //!< mesher
};

//! Whether an iteration works on all pairs of vertices and control points, or on the active set: the
//! pairs whose weights may be positive at the optimum, which it finds, extends and checks.
enum class ActiveSet {
  kAuto,  //!< in 3D from 80 control points and 400,000 pairs on, unless a certificate is asked for
  kOn,    //!< always; a certificate is left to some last iterations on all pairs
  kOff    //!< all pairs
};

//! How weights are recovered from gradients.
enum class Recovery {
  kAuto,          //!< kBreadthFirst for Method::kPaper, else kLeastSquares
  kBreadthFirst,  //!< integration from the boundary, level by level (4.2.2 of the paper)
  kLeastSquares   //!< the weights whose gradients are nearest, by one Poisson solve
};

//! What the gradient methods alone read: kGradient and kPaper.
struct GradientOptions {
  //! How weights follow from gradients.
  Recovery recovery = Recovery::kAuto;
};

//! Options of solve(). The defaults suit every cage. An option that is not set is chosen by the
//! method. Methods kHarmonic and kMeanValue read threads and non_negative alone.
struct SolverOptions {
  //! How the coordinates are computed.
  Method method = Method::kAuto;

  //! Growth of the weight functions phi.
  DistanceScheme phi = DistanceScheme::kSquare;

  //! Where the distances behind phi come from, where solve() sets the problem up. kAuto
  //! interpolates if the estimated effect on the weights stays within half the tolerance; the
  //! report says how far phi is off.
  Distances distances = Distances::kAuto;

  //! Of the iteration.
  Precision precision = Precision::kAuto;

  //! Treatment of w >= 0; kConstraint is one of kValue and kLbc2014 only.
  NonNegative non_negative = NonNegative::kAuto;

  //! For the linear system of each iteration (kValue, kLbc2014) or of start and recovery
  //! (kGradient, kPaper). kNone is for the gradient methods only.
  LinearSolver linear_solver = LinearSolver::kAuto;

  //! Whether kValue starts from coarser meshes, for which solve() takes a mesher.
  CoarseToFine coarse_to_fine = CoarseToFine::kAuto;

  //! Which coarser meshes.
  CoarseLevels coarse_levels{};

  //! How accurate, > 0.
  //! - kValue: mean squared error of the weights (the paper's (5)), as estimated from how much an
  //!   iteration changes them; 1e-7 by default.
  //! - kGradient: the same, of the optimum without non-negativity, as estimated from weights that
  //!   are recovered every 32 iterations or so; 1e-6 by default.
  //! - kPaper, kLbc2014: section 5 of the paper, norms at most N_p tolerance and 10 N_d tolerance;
  //!   by default the paper's 1e-7.
  std::optional<double> tolerance{};

  //! Certified relative gap (certificate.h) that ends a run as well, whichever is met first; > 0,
  //! or 0 for none. By default 1e-3 for kValue and kGradient where the tolerance is not set, else
  //! none. On cages whose optimum is flat, such as round ones, it is met long before the tolerance.
  //! Certified from iteration 500 on, each time a fifth later, for a few percent of the time.
  //! Refused where weights may be negative, because the bound is that of non-negative ones.
  std::optional<double> gap{};

  //! Whether kValue works only where weights are.
  ActiveSet active_set = ActiveSet::kAuto;

  //! Largest number of iterations, >= 1; reaching it is reported, not an error.
  int max_iterations = 20000;

  //! Penalty of the augmented Lagrangian, > 0, with the size of the cage (bounding_box_diagonal) as
  //! the unit of length. By default chosen from the mesh, but for kPaper. published_penalty()
  //! converts from the scale of the literature.
  std::optional<double> penalty{};

  //! Over-relaxation in (0, 2), 1 = none.
  std::optional<double> relaxation{};

  //! Iterations between two evaluations of the residuals, >= 1.
  int check_interval = 10;

  //! Whether to compute a lower bound of the optimal objective as well; refused for kHarmonic and
  //! kMeanValue.
  bool certify = false;

  //! Whether weights are delivered without their zeros (Solution::sparse_weights). With an active
  //! set no n x V matrix is made then.
  bool sparse = false;

  //! Number of threads, at most 1024; 0 = as many as OpenMP offers, but one where n V is below
  //! 100,000.
  int threads = 0;

  //! Of kGradient and kPaper.
  GradientOptions gradient{};
};

//! Refuses impossible options. solve() and Solver do this themselves, before anything else.
//! \throws OptionError naming the field and its valid range
void validate(const SolverOptions& options);

//! The options with everything filled in that does not depend on the problem: all but the penalty
//! and, for CoarseToFine::kAuto, the coarse levels.
//! \param options  valid
SolverOptions resolve(SolverOptions options);

}  // namespace flbc
