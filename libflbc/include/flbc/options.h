// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Options of solve().
#pragma once

#include <functional>
#include <iosfwd>
#include <optional>
#include <string_view>

#include "flbc/coarse_to_fine.h"
#include "flbc/distance_weights.h"
#include "flbc/types.h"

namespace flbc {

//! How the coordinates are computed.
enum class Method {
  kAuto,      //!< the method recommended for most uses, at present kValue
  kValue,     //!< splitting on the weights in the metric of the continuous problem: the fastest
  kGradient,  //!< the paper's gradient ADMM, started from harmonic coordinates, over-relaxed
  kPaper,  //!< the paper's gradient ADMM with its parameters (docs/method.md: what it leaves open)
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

//! Numbers of the iteration; set-up and recovery are always in double precision.
enum class Precision {
  kAuto,  //!< kHalf where the tolerance allows, for Method::kValue; else kSingle
  kHalf,  //!< Method::kValue only: duals of cells in half precision, all else and all arithmetic in
          //!< single; kSingle on meshes of less than 10,000 cells, from an estimated error of 1e-6
          //!< on, and after 300 iterations
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

//! Whether an iteration works on all pairs of vertices and control points, or on those alone whose
//! weights may be positive at the optimum: on supports that it finds, extends and checks.
enum class ActivePairs {
  kAuto,  //!< supports in 3D from 80 control points and 400,000 pairs on, unless a certificate or a
          //!< state is asked for
  kOn,  //!< supports; a certificate is left to some last iterations on all pairs
  kOff  //!< all pairs
};

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
  int finer_levels = 0;    //!< meshes still to come after this one, if coarser ones go before
  //! Objective of the present weights, in the units of SolveReport::objective; computed when
  //! called, which takes as long as an iteration or two. Empty for methods without weights at hand.
  std::function<double()> objective{};
  //! Writes the state of the whole run, for SolverOptions::resume_from; to be called by the
  //! callback or not at all. Empty on coarser meshes, and where solve() was given a problem.
  std::function<void(std::ostream&)> write_state{};
};

//! Parts of a solve besides the iteration that may take long.
enum class Stage {
  kDistances,    //!< those behind phi
  kNonNegative,  //!< weights of the last iteration are projected
  kCertificate   //!< the lower bound at the end
};

//! Options of solve(). The defaults suit every cage. Where a method does not read a field, its
//! value changes nothing.
struct SolverOptions {
  //! How the coordinates are computed.
  Method method = Method::kAuto;

  //! Growth of the weight functions phi. Read by all methods but kHarmonic and kMeanValue.
  DistanceScheme phi = DistanceScheme::kSquare;

  //! Where the distances behind phi come from. Read where solve() sets the problem up, by all
  //! methods but kHarmonic and kMeanValue, for which none are computed. kAuto interpolates if the
  //! estimated effect on the weights stays within half the tolerance; the report says how far phi
  //! is off.
  Distances distances = Distances::kAuto;

  //! Of the iteration. Read by kValue, kLbc2014, kGradient and kPaper.
  Precision precision = Precision::kAuto;

  //! How weights follow from gradients. Read by kGradient and kPaper.
  Recovery recovery = Recovery::kAuto;

  //! Treatment of w >= 0. Read by all methods; kConstraint is one of kValue and kLbc2014 only.
  NonNegative non_negative = NonNegative::kAuto;

  //! For the linear system of each iteration (kValue, kLbc2014) or of start and recovery
  //! (kGradient). Read by these and, as for kNone, by kPaper, which has no such system unless the
  //! recovery is kLeastSquares.
  LinearSolver linear_solver = LinearSolver::kAuto;

  //! Whether to start from coarser meshes, for which solve() takes a mesher. Read by kValue,
  //! kGradient and, where the penalty is chosen from the mesh, kLbc2014; other methods start as
  //! ever.
  CoarseToFine coarse_to_fine = CoarseToFine::kAuto;

  //! Which coarser meshes. Read by kValue, kGradient and kLbc2014.
  CoarseLevels coarse_levels{};

  //! How accurate, > 0; 0 = by method.
  //! - kValue: mean squared error of the weights (the paper's (5)), as estimated from how much an
  //!   iteration changes them; 1e-7 by default.
  //! - kGradient: the same, of the optimum without non-negativity, as estimated from
  //!   weights that are recovered every 40 iterations
  //!   or so; 1e-6 by default.
  //! - kPaper, kLbc2014: as section 5 of the paper says, norms at most N_p tolerance and 10 N_d
  //!   tolerance; by default the paper's 1e-7.
  //! - kHarmonic, kMeanValue do not read it.
  double tolerance = 0;

  //! Certified relative gap (certificate.h) that ends a run as well, whichever is met first; > 0,
  //! or 0 for none. Absent: 1e-3 for kValue and kGradient where the tolerance is the method's own,
  //! else none. On cages whose optimum is flat, as on round ones, it is met long before the
  //! tolerance. Certified from iteration 500 on, each time a fifth later, for a few percent of the
  //! time. Read by kValue, kGradient, kLbc2014 and kPaper; refused where weights may be negative,
  //! since the bound is that of non-negative ones.
  std::optional<double> gap{};

  //! Work only where weights are. Read by kValue, but not where a state is kept (StateStorage).
  ActivePairs active_pairs = ActivePairs::kAuto;

  //! Largest number of iterations, >= 1; reaching it is reported, not an error. Read by kValue,
  //! kLbc2014, kGradient and kPaper.
  int max_iterations = 20000;

  //! Penalty of the augmented Lagrangian, > 0, with the cage's size (bounding_box_diagonal) as the
  //! unit of length; 0 = by method, which means chosen from the mesh, but for kPaper.
  //! published_penalty() converts from the scale of the literature. Read by kValue, kLbc2014,
  //! kGradient and kPaper.
  double penalty = 0;

  //! Over-relaxation in (0, 2), 1 = none; 0 = by method. Read by kValue, kLbc2014, kGradient and
  //! kPaper.
  double relaxation = 0;

  //! Iterations between two evaluations of the residuals, >= 1. Read by kValue, kLbc2014, kGradient
  //! and kPaper.
  int check_interval = 10;

  //! Whether to compute a lower bound of the optimal objective as well. Read by kValue, kLbc2014,
  //! kGradient and kPaper; refused for the others.
  bool certify = false;

  //! Number of threads, at most 1024; 0 = as many as OpenMP offers, but one where n V is below
  //! 100,000. Read by all methods.
  int threads = 0;

  //! Called whenever residuals are evaluated; returning false stops the run. Read by kValue,
  //! kLbc2014, kGradient and kPaper.
  std::function<bool(const Progress&)> progress{};

  //! State that Progress::write_state has written in a run of the same cage, mesh and options, but
  //! for threads, max_iterations and callbacks, by the same version of the library. The run goes on
  //! from there and ends with the same bits as if it had never stopped. The bytes must stay until
  //! solve() returns. Read by solve() of a cage and a mesh, refused by whoever else solves; empty
  //! to start afresh.
  std::string_view resume_from{};

  //! Called by the calling thread now and then during such a stage, with the part of it in [0, 1]
  //! that is done. Must not throw. Read by all methods that have the stage; distances tell where
  //! solve() sets the problem up.
  std::function<void(Stage stage, double done)> stage_progress{};
};

//! Refuses impossible options. solve() and the classes that solve do this themselves, before
//! anything else.
//! \param options  as a caller gives them
//! \throws OptionError naming the field and its valid range
void validate(const SolverOptions& options);

//! The options with every "by method" filled in, but for what depends on the problem: the penalty
//! and, for CoarseToFine::kAuto, the coarse levels.
//! \param options  valid
SolverOptions resolve(SolverOptions options);

}  // namespace flbc
