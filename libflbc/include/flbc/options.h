// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Options and callbacks of a solve.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "flbc/cage.h"
#include "flbc/distance_weights.h"
#include "flbc/domain_mesh.h"
#include "flbc/masks.h"
#include "flbc/types.h"

namespace flbc {

//! Solver method. Each minimizes the objective of local barycentric coordinates; other coordinates
//! are in coordinates.h. In this file, "the paper" is that of Tao, Deng, and Zhang (2019).
enum class Method {
  kWeights,          //!< ADMM on the weights, in the metric of the continuous problem
  kAuto = kWeights,  //!< the recommended method
  kGradient,  //!< gradient ADMM of the paper, started from harmonic coordinates, over-relaxed;
              //!< iterates on a mesh of OpenMesh, in programs that link flbc::openmesh
  kPaper,     //!< FLBC 2019: the same with the parameters of the paper
              //!< (docs/paper.md)
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
  kAuto,            //!< kSingle
  kSingle = kAuto,  //!< float
  kDouble           //!< double
};

//! Source of the geodesic distances for the functions phi.
enum class Distances {
  kAuto,         //!< kInterpolated for Method::kWeights on a refined mesh if it meets the tolerance
  kExact,        //!< computed on the mesh itself
  kInterpolated  //!< interpolated from the coarse mesh of a refined one (nested_mesh.h)
};

//! Whether the iteration works on the active set instead of all pairs of vertices and control
//! points. The active set contains the pairs whose weights may be positive at the optimum. The
//! solver finds, extends, and checks it. Memory then follows these pairs, except for 4 n V bytes of
//! distances, and 16 n V bytes of harmonic coordinates at a start without a coarse mesh.
enum class ActiveSet {
  kAuto,  //!< in 3D if it has at most 30% of all pairs, unless `certify` or `gap` is set. Without
          //!< masks, never with `reach`
  kOn,    //!< always; an error with `certify` or `gap`, which need the duals of all pairs, and with
          //!< more than 65,000 control points
  kOff    //!< all pairs
};

//! Options of solve(). The defaults suit every cage. The method chooses options that are not set.
struct SolverOptions {
  //! Solver method.
  Method method = Method::kAuto;

  //! Growth of the functions phi with distance.
  DistanceScheme phi = DistanceScheme::kSquare;

  //! epsilon / size of the cage (bounding_box_diagonal), >= 0. The objective is the sum over cells
  //! and control points of A (phi |grad w_i| + epsilon / 2 |grad w_i|^2). A positive epsilon makes
  //! the optimum unique and removes the kinks of total variation, which crease a model in poses. 0
  //! is the problem of the papers, whose optimum does not determine the weights. Useful values are
  //! 0.001 to 0.03. For kWeights and kGradient; an error for other methods. Default: 0.003, and 0
  //! for kPaper and kLbc2014.
  std::optional<double> smoothness{};

  //! Source of the distances for phi when solve() sets up the problem. kAuto interpolates if the
  //! estimated effect on the weights is below half the tolerance. The report contains the estimated
  //! error of phi.
  Distances distances = Distances::kAuto;

  //! Precision of the iteration.
  Precision precision = Precision::kAuto;

  //! Enforcement of w >= 0; kConstraint is available only for kWeights and kLbc2014.
  NonNegative non_negative = NonNegative::kAuto;

  //! Tolerance, > 0.
  //! - kWeights: estimated mean squared error of the weights (equation (5) of the paper). The
  //!   estimate extrapolates how changes shrink from iteration to iteration. Default: 1e-6, and
  //!   1e-8 with `certify`, whose bound is loose otherwise.
  //! - kGradient: the same, relative to the optimum without non-negativity. Default: 1e-6.
  //! - kPaper, kLbc2014: section 5 of the paper: residual norms at most N_p * tolerance and 10 *
  //!   N_d * tolerance. Default: 1e-7, as in the paper.
  //!
  //! With smoothness 0, a small change may be far from the optimum. There is no default then, and
  //! an explicit tolerance is an estimate only; the report has the certified gap.
  std::optional<double> tolerance{};

  //! Certified relative optimality gap (certificate.h) that also ends a run; > 0, or 0 for none.
  //! The run ends when either the gap or the tolerance is met. Default: none; with smoothness 0 and
  //! without a tolerance 1e-3, which alone ends the run. A certificate takes as long as ten
  //! iterations. An error if weights may be negative, because the bound holds for non-negative
  //! weights.
  std::optional<double> gap{};

  //! Whether kWeights works on an active set.
  ActiveSet active_set = ActiveSet::kAuto;

  //! Maximum number of iterations, >= 1. Reaching it is not an error; the status reports it.
  int max_iterations = 20000;

  //! Penalty of the augmented Lagrangian, > 0. The unit of length is cage size
  //! (bounding_box_diagonal). Default: chosen from the mesh, except for kPaper. published_penalty()
  //! converts values from the literature.
  std::optional<double> penalty{};

  //! Whether to compute a lower bound of the optimal objective, and keep its proof. A run with a
  //! gap, or that ends by the tolerance without smoothness, computes the bound anyway, if it has
  //! the duals of all pairs.
  bool certify = false;

  //! Masks of the V vertices of the mesh; see BindOptions::masks for those of a model. Weights are
  //! exactly 0 there, and masks are part of the problem: what is left is optimal, and a certificate
  //! proves it. For kWeights and a cage in one part. Vertices on the cage keep their known weights.
  //! solve() throws InputError where no weights >= 0 exist, and names the control points to free.
  std::vector<Mask> masks{};

  //! Factors in [1/16, 16] by which phi_i is divided, one per control point; empty if all are 1.
  //! Weights of a control point with a larger factor extend farther. It is a tendency; masks are a
  //! guarantee. For every method; a certificate holds for the divided phi.
  std::vector<double> reach{};

  //! Width of a band next to masks, as a part of cage size (bounding_box_diagonal), in [0, 1].
  //! There phi of the masked control points grows toward the mask, so that their weights fade out
  //! before it instead of ending in a crease. Masks stay exact. Useful values are 0.05 to 0.2; 0 is
  //! no band.
  double falloff = 0;

  //! Number of threads, at most 1024; 0 = as many as OpenMP offers, or one if n V < 100,000.
  int threads = 0;
};

//! Checks options. solve() and Solver call it first.
//! \throws OptionError naming the field and its valid range
void validate(const SolverOptions& options);

//! Replaces automatic options by the values that will be used. Options that depend on the problem
//! stay automatic: the penalty.
//! \param options  valid
SolverOptions resolve(SolverOptions options);

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

//! Converts a published penalty to the unit of SolverOptions::penalty. Publications state penalties
//! for a domain whose farthest vertex lies at radius 250. They use 10 for Method::kLbc2014 (Zhang
//! et al. 2014), and 100 in 2D and 10000 in 3D for Method::kPaper (section 5 of the paper).
//!
//! \param cage  n control points, in any unit of length
//! \param mesh  domain mesh of the cage, in the same unit
//! \param method  method of the penalty; the scaling with length depends on it
//! \param penalty  as published, > 0
//! \throws OptionError if the penalty is not positive and finite
template <int Dim>
double published_penalty(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh, Method method,
                         double penalty);

// CMake defines it for targets that link flbc::openmesh. Their solves have kGradient and kPaper.
#ifdef FLBC_LINKS_OPENMESH
namespace openmesh {
bool enable_gradient_methods() noexcept;
}
namespace internal {
inline const bool kHasGradientMethods = openmesh::enable_gradient_methods();
}
#endif

}  // namespace flbc
