// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The report of a run.
#pragma once

#include <vector>

#include "flbc/certificate.h"
#include "flbc/options.h"
#include "flbc/quality.h"
#include "flbc/types.h"

namespace flbc {

//! How a run ended. Every status comes with usable weights.
enum class SolveStatus {
  kConverged,       //!< a Criterion was met
  kIterationLimit,  //!< max_iterations was reached first
  kStopped          //!< the progress callback asked to stop
};

//! What a run that converged has met.
enum class Criterion {
  kNone,       //!< it has not converged, or does not iterate
  kTolerance,  //!< both residuals, or the estimated error, fell below their thresholds
  kGap         //!< the certified gap is at most SolverOptions::gap
};

//! Wall-clock seconds of the stages.
struct StageSeconds {
  double setup = 0;    //!< topology, boundary values, phi
  double solve = 0;    //!< the iteration with its set-up and start
  double recover = 0;  //!< from gradients to weights, and making them non-negative
  double certify = 0;  //!< the lower bound
};

//! Where the distances behind phi come from.
struct DistanceReport {
  Distances source = Distances::kExact;  //!< kExact or kInterpolated
  Index vertices = 0;                    //!< of the coarser mesh they are interpolated from, else 0
  //! Root mean square error of interpolated phi, relative to its root mean square, as estimated
  //! from a few control points whose distances are computed on both meshes.
  double phi_error = 0;
};

//! The active set that an iteration worked on.
struct ActiveSetReport {
  double density = 1;  //!< its pairs relative to all pairs of interior vertices and control points;
                       //!< 1 if it worked on all
  int growths = 0;     //!< how often it was extended because weights had reached its ends
};

//! A coarser mesh that was solved for a start (coarse_to_fine.h).
struct LevelReport {
  Index vertices = 0;        //!< of the coarse mesh
  Index cells = 0;           //!< of the coarse mesh
  int iterations = 0;        //!< on it
  double mesh_seconds = 0;   //!< for making it
  double setup_seconds = 0;  //!< topology, boundary values, phi
  double solve_seconds = 0;  //!< the start and the iteration
};

//! Result of solve() beside the weights. Where the cage has several parts, numbers of elements,
//! seconds, objectives and bounds are sums, iterations, residuals and phi_error the largest of a part,
//! and what cannot be added up is that of the part that took most iterations.
struct SolveReport {
  Method method = Method::kAuto;                 //!< the method used, never kAuto
  SolveStatus status = SolveStatus::kConverged;  //!< how the run ended
  Criterion criterion = Criterion::kNone;        //!< what it has met, if it converged
  Index control_points = 0;                      //!< n
  Index vertices = 0;                            //!< V
  Index cells = 0;                               //!< F
  int iterations = 0;                            //!< 0 for methods that do not iterate
  double primal_residual = 0;    //!< |r_p|, or estimated error, divided by its threshold
  double dual_residual = 0;      //!< |r_d| divided by its threshold
  double penalty = 0;            //!< used last, in the unit of SolverOptions::penalty
  double published_penalty = 0;  //!< the same on the scale of the literature (published_penalty())
  //! Of the weights: sum_s sum_i phi A |grad w_i|, in units of the mesh^(dim - 1). NaN where phi
  //! was not computed: for kHarmonic and kMeanValue, unless the problem came with it.
  double objective = 0;
  Certificate certificate{};                 //!< if asked for or the criterion, in the same units
  double state_scalars_per_cell = 0;         //!< state of the iteration, per cell and control point
  DistanceReport distances{};                //!< behind phi, if solve() set the problem up
  ActiveSetReport active_set{};              //!< of Method::kValue
  StageSeconds seconds{};                    //!< wall-clock times
  Quality quality{};                         //!< of the weights
  std::vector<LevelReport> coarse_levels{};  //!< coarsest first; empty without coarse-to-fine start
  std::vector<SolveReport> parts{};          //!< if the cage has several, by their first control points
};

}  // namespace flbc
