// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The report of a run, and names of options and statuses, as used on the command line.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flbc/cage.h"
#include "flbc/certificate.h"
#include "flbc/options.h"
#include "flbc/placement.h"
#include "flbc/pointwise.h"
#include "flbc/quality.h"
#include "flbc/types.h"

namespace flbc {

//! How a run ended. Weights are usable with every status.
enum class SolveStatus {
  kConverged,       //!< a Criterion was met
  kIterationLimit,  //!< max_iterations was reached first
  kStopped          //!< the progress callback asked to stop
};

//! The criterion that a converged run met.
enum class Criterion {
  kNone,       //!< the run did not converge, or it was compute_coordinates()
  kTolerance,  //!< both residuals, or the estimated error, fell below their thresholds
  kGap         //!< the certified gap is at most SolverOptions::gap
};

//! Wall-clock times of the phases, in seconds.
struct StageSeconds {
  double setup = 0;    //!< topology, boundary values, phi
  double solve = 0;    //!< iteration, including its setup and start
  double recover = 0;  //!< recovery of weights from gradients, and projection
  double certify = 0;  //!< lower bound
};

//! Source of the distances for phi.
struct DistanceReport {
  Distances source = Distances::kExact;  //!< kExact or kInterpolated
  Index vertices = 0;                    //!< of the coarse mesh; 0 for kExact
  //! Estimated root mean square error of interpolated phi, relative to its root mean square. The
  //! estimate computes the distances of a few control points on both meshes.
  double phi_error = 0;
};

//! The active set of the iteration.
struct ActiveSetReport {
  double density = 1;  //!< pairs in the active set / all pairs of interior vertices and control
                       //!< points; 1 without an active set
  int growths = 0;     //!< number of extensions, made when weights reached its border
};

//! The solve on the coarse mesh of a refined one (nested_mesh.h).
struct LevelReport {
  Index vertices = 0;        //!< of the coarse mesh
  Index cells = 0;           //!< of the coarse mesh
  int iterations = 0;        //!< on the coarse mesh
  double solve_seconds = 0;  //!< start and iteration
};

//! Report of solve() or compute_coordinates(). If the cage has several parts:
//! - numbers of elements, seconds, objectives, and bounds are sums over the parts;
//! - iterations, residuals, phi_error, and mesh_error are the maximum over the parts;
//! - all other fields come from the part with the most iterations.
struct SolveReport {
  Method method = Method::kWeights;  //!< method used; kWeights for compute_coordinates()
  SolveStatus status = SolveStatus::kConverged;  //!< how the run ended
  Criterion criterion = Criterion::kNone;        //!< the criterion met, if the run converged
  Index control_points = 0;                      //!< n
  Index vertices = 0;                            //!< V
  Index cells = 0;                               //!< F
  int iterations = 0;                            //!< 0 for compute_coordinates()
  double relative_primal_residual = 0;  //!< |r_p| or estimated error, divided by its threshold
  double relative_dual_residual = 0;    //!< |r_d| divided by its threshold
  double penalty = 0;                   //!< final penalty, in the unit of SolverOptions::penalty
  double published_penalty = 0;  //!< the same in the scale of the literature (published_penalty())
  //! Objective of the weights (SolverOptions::smoothness), in units of the mesh^(dim - 1). NaN for
  //! compute_coordinates().
  double objective = 0;
  Certificate certificate{};                 //!< if requested or used as the criterion; same units
  double state_scalars_per_cell = 0;         //!< size of the iteration state
  DistanceReport distances{};                //!< for phi, if solve() set up the problem
  ActiveSetReport active_set{};              //!< of Method::kWeights
  StageSeconds seconds{};                    //!< wall-clock times of the phases
  Quality quality{};                         //!< of the weights
  std::vector<LevelReport> coarse_levels{};  //!< none or one
  //! Estimated mean squared difference of a weight from that on a much finer mesh, by the weights
  //! on the coarse mesh; 0 without one. Four times the vertices make it about a tenth.
  double mesh_error = 0;
  std::vector<SolveReport> parts{};  //!< if the cage has several parts, ordered by first
                                     //!< control point
};

//! The name of a value, such as "weights" or "lbc2014".
//! \tparam Enum  Method, Coordinates, NonNegative, DistanceScheme, Distances, Precision, ActiveSet,
//! SolveStatus, Criterion, DefectKind, or OutsidePoints
template <class Enum>
const char* name_of(Enum value);

//! All names of an enumeration, default first.
//! \tparam Enum  as for name_of()
template <class Enum>
std::vector<std::string> names_of();

//! The value with a name; inverse of name_of().
//! \tparam Enum  as for name_of()
//! \param name  as returned by name_of()
//! \return no value if the name is unknown
template <class Enum>
std::optional<Enum> value_named(const std::string& name);

}  // namespace flbc
