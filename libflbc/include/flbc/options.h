// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Options of a solve.
#pragma once

#include <optional>

#include "flbc/coarse_to_fine.h"
#include "flbc/distance_weights.h"
#include "flbc/types.h"

namespace flbc {

//! Solver method. Each minimizes the objective of local barycentric coordinates; other coordinates
//! are in coordinates.h. In this file, "the paper" is that of Tao, Deng, and Zhang (2019).
enum class Method {
  kAuto,      //!< recommended method, currently kValue
  kValue,     //!< default method: weight-splitting ADMM in the metric of the continuous problem;
              //!< fastest
  kGradient,  //!< gradient ADMM of the paper, started from harmonic coordinates, over-relaxed
  kPaper,     //!< FLBC 2019: gradient ADMM with the parameters of the paper
              //!< (docs/explanation/method/differences_from_papers.md)
  kLbc2014    //!< LBC 2014: the original solver (Zhang et al. 2014; section 3 of the paper)
};

//! Enforcement of w >= 0. Without it, the optimum on a mesh may be negative, in 3D noticeably.
enum class NonNegative {
  kAuto,        //!< kConstraint if the method supports it, kProject for kGradient, otherwise kOff
  kConstraint,  //!< a constraint of the iteration; the final weights are also projected
  kProject,     //!< replaces the weights of each vertex by the nearest feasible, non-negative ones
  kOff          //!< not enforced, as in the paper
};

//! Floating-point precision of the iteration. Setup and recovery always use double precision.
enum class Precision {
  kAuto,    //!< kSingle; Method::kValue stores cell duals in half precision where that is safe
  kSingle,  //!< float
  kDouble   //!< double
};

//! Source of the geodesic distances for the functions phi.
enum class Distances {
  kAuto,         //!< kInterpolated for Method::kValue if it is faster and meets the tolerance
  kExact,        //!< computed on the mesh itself
  kInterpolated  //!< interpolated from a coarser mesh; needs a mesher
};

//! Whether the iteration works on the active set instead of all pairs of vertices and control
//! points. The active set contains the pairs whose weights may be positive at the optimum. The
//! solver finds, extends, and checks it. Memory then follows these pairs, except for 4 n V bytes of
//! distances, and 16 n V bytes of harmonic coordinates at a start without a coarser mesh.
enum class ActiveSet {
  kAuto,  //!< in 3D with at least 80 control points and 400,000 pairs, unless `certify` or `gap` is
          //!< set
  kOn,    //!< always; an error with `certify` or `gap`, which need the duals of all pairs
  kOff    //!< all pairs
};

//! Smoothness for deforming models, the default of flbc run and openmesh::bind(): poses crease a
//! model no more than with harmonic coordinates, for 6% to 42% more influences
//! (docs/explanation/smooth_weights.md).
constexpr double kDeformationSmoothness = 0.003;

//! Options of solve(). The defaults suit every cage. The method chooses options that are not set.
struct SolverOptions {
  //! Solver method.
  Method method = Method::kAuto;

  //! Growth of the functions phi with distance.
  DistanceScheme phi = DistanceScheme::kSquare;

  //! Trades locality for smoothness: epsilon / size of the cage (bounding_box_diagonal), >= 0. The
  //! objective gets the term epsilon / 2 |grad w_i|^2, which removes the kinks of total variation
  //! and makes the optimum unique. 0 is the problem of the paper. Useful values are 0.001 to 0.03.
  //! For kValue and kGradient; an error for other methods. Default: 0 for solve() and Solver;
  //! kDeformationSmoothness for openmesh::bind().
  std::optional<double> smoothness{};

  //! Source of the distances for phi when solve() sets up the problem. kAuto interpolates if the
  //! estimated effect on the weights is below half the tolerance. The report contains the estimated
  //! error of phi.
  Distances distances = Distances::kAuto;

  //! Precision of the iteration.
  Precision precision = Precision::kAuto;

  //! Enforcement of w >= 0; kConstraint is available only for kValue and kLbc2014.
  NonNegative non_negative = NonNegative::kAuto;

  //! Solver of the linear systems in each iteration (kValue, kLbc2014), or in start and recovery
  //! (kGradient, kPaper). kNone is available only for the gradient methods.
  LinearSolver linear_solver = LinearSolver::kAuto;

  //! Whether kValue uses a multilevel start, which needs a mesher as an argument of solve().
  CoarseToFine coarse_to_fine = CoarseToFine::kAuto;

  //! Coarse meshes of the multilevel start.
  CoarseLevels coarse_levels{};

  //! Tolerance, > 0.
  //! - kValue: estimated mean squared error of the weights (equation (5) of the paper). The
  //!   estimate extrapolates how far the weights move. Default: 1e-7.
  //! - kGradient: the same, relative to the optimum without non-negativity. The estimate uses
  //!   weights recovered every 40 iterations. Default: 1e-6.
  //! - kPaper, kLbc2014: section 5 of the paper: residual norms at most N_p * tolerance and 10 *
  //!   N_d * tolerance. Default: 1e-7, as in the paper.
  std::optional<double> tolerance{};

  //! Certified relative optimality gap (certificate.h) that also ends a run; > 0, or 0 for none.
  //! The run ends when either the gap or the tolerance is met. Default: 1e-3 for kValue and
  //! kGradient if the tolerance is not set, otherwise none; none on an active set. A flat optimum,
  //! for example of a round cage, meets the gap long before the tolerance. The default gap also
  //! waits until the estimated error of the weights is at most ten tolerances, or the gap at most
  //! 1e-4. The gap is evaluated at iteration 500 and then after every 20% more iterations, which
  //! costs a few percent of the time. An error if weights may be negative, because the bound holds
  //! for non-negative weights.
  std::optional<double> gap{};

  //! Whether kValue works on an active set.
  ActiveSet active_set = ActiveSet::kAuto;

  //! Maximum number of iterations, >= 1. Reaching it is not an error; the status reports it.
  int max_iterations = 20000;

  //! Penalty of the augmented Lagrangian, > 0. The unit of length is cage size
  //! (bounding_box_diagonal). Default: chosen from the mesh, except for kPaper. published_penalty()
  //! converts values from the literature.
  std::optional<double> penalty{};

  //! Over-relaxation in (0, 2), 1 = none.
  std::optional<double> relaxation{};

  //! Whether to compute a lower bound of the optimal objective, and keep its proof. A run that ends
  //! by the gap, or by the tolerance with neither gap nor smoothness, computes the bound anyway, if
  //! it has the duals of all pairs.
  bool certify = false;

  //! Number of threads, at most 1024; 0 = as many as OpenMP offers, or one if n V < 100,000.
  int threads = 0;
};

//! Checks options. solve() and Solver call it first.
//! \throws OptionError naming the field and its valid range
void validate(const SolverOptions& options);

//! Sets the smoothness to kDeformationSmoothness if it is not set and the method supports it.
void make_smooth(SolverOptions& options);

//! Replaces automatic options by the values that will be used. Options that depend on the problem
//! stay automatic: the penalty and, for CoarseToFine::kAuto, the coarse levels.
//! \param options  valid
SolverOptions resolve(SolverOptions options);

}  // namespace flbc
