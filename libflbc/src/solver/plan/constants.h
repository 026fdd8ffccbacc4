// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Every automatic constant of a solve, with the measurement behind it. docs/benchmarks and
//! docs/contributing/lab_book.md have the tables.
#pragma once

#include <cstddef>

#include "flbc/types.h"

namespace flbc::plan {

// ---- penalties, unit of length: diagonal of the cage bounding box --------------

//! `value`, initial penalty. 1/40 roughly suits all models; balancing adapts it.
constexpr double kFirstPenalty = 1.0 / 40;
//! `value`, maximum penalty. Balancing compares norms of all changes. On round cages the start is
//! already nearly correct, so balancing alone would exceed the range in which the iteration
//! converges.
constexpr double kLargestPenalty = 1.0 / 30;
//! `value`: a balanced penalty is this times |dual| / |motion since the start|.
constexpr double kBalance = 0.3;
//! `value`: smoothness adds this times epsilon to the penalty, because the best penalty for the
//! quadratic term alone is proportional to it. Iterations to a true error of 1e-7 on five models
//! are least for 3 to 30 (lab book).
constexpr double kPenaltyOfSmoothness = 10;
constexpr double with_smoothness(double penalty, double smoothness) {
  return penalty + kPenaltyOfSmoothness * smoothness;
}
//! `value` balances after these iterations.
constexpr int kBalancedAfter[] = {5, 10, 20, 40};
//! `value` on all pairs looks at its residuals after this many iterations, and whenever their
//! number has grown by the factor.
constexpr int kFirstLook = 80;
constexpr double kLookGrowth = 1.5;
//! `value`: the penalty is lowered if the violation of the constraints is less than the first of
//! these times the change of gradients in an iteration, both in the metric and the latter times the
//! penalty, and raised if it is more than the second. On slits, combs, and stars the ratio is 15 to
//! 60, and half to a fifth of the balanced penalty is best. On round cages it is 60 to 450, and a
//! smaller penalty harms. It grows to thousands where the penalty is too small in the end (lab
//! book).
constexpr double kLeastViolation = 120, kMostViolation = 500;
//! `value`: a run must not end within this number of iterations after the penalty was lowered.
constexpr int kAfterLook = 32;
//! `value`: factors by which the penalty changes at most then, and the smallest penalty.
constexpr double kMostLowered = 0.3, kMostRaised = 3, kSmallestPenalty = 1.0 / 400;
//! `value` on the active set uses this fraction of the penalty of all pairs. Fewer weights move,
//! and after a multilevel start they are nearly correct.
constexpr double kActivePenaltyCold = 0.5, kActivePenaltyWarm = 0.25;
//! `lbc2014` without a given penalty: on average, rho m is this times the measure of a cell. Best
//! value measured from 1/120 to 1/10 (lab book).
constexpr double kLbc2014Penalty = 1.0 / 30;
//! `gradient`: mu is this times the measure of a typical facet. Scaled duals are then as large as
//! gradients. The multiplier of a facet is a potential of the order of cage size times facet
//! measure, and grows slowest. Best on all models (lab book).
constexpr double gradient_penalty(int dim) {
  return dim == 2 ? 1.0 / 3500 : 1.0 / 6000;
}
//! `paper`: section 5, in the published unit of length.
constexpr double published_gradient_penalty(int dim) {
  return dim == 2 ? 100 : 10000;
}

// ---- metric, relaxation, starts -----------------------------------------------------------------

//! Weight of u = w per vertex mass and squared size, relative to the cell metric. Iterations hardly
//! depend on it between 10 and 300.
constexpr double kVertexWeight = 100;
//! Over-relaxation: `value` and tuned `lbc2014`; `gradient`; `lbc2014` as published.
constexpr double kRelaxation = 1.9, kGradientRelaxation = 1.8, kPublishedRelaxation = 1.65;
//! Steps of a Richardson iteration from zero to harmonic coordinates. The first is by far the
//! largest; the others only correct for the vertex metric.
constexpr int kHarmonicSteps = 8;
//! Mean squared change of a weight below which they end.
constexpr double kHarmonicChange = 1e-9;

// ---- precision ----------------------------------------------------------------------------------

//! Largest tolerance at which half precision of cell duals is too inaccurate. Radii are rounded by
//! 1.4e-4 on average, which moves weights by a few 1e-11 squared on models.
constexpr double kHalfIsEnough = 1e-7;
//! Minimum number of cells for half precision. On smaller meshes rounding moves weights more, and a
//! solve is fast anyway.
constexpr Index kHalfCells = 10000;
//! Maximum smoothness for half precision. Duals grow with it, and might overflow.
constexpr double kHalfSmoothness = 0.1;
//! Half precision ends at this estimated error or after this number of iterations. Rounding duals
//! in each iteration makes weights fluctuate, which the estimate cannot distinguish from progress.
constexpr double kHalfEndsAtError = 3e-6;
constexpr int kHalfIterations = 300;
constexpr bool ends_half_precision(int iterations, double error) {
  return iterations >= kHalfIterations || error < kHalfEndsAtError;
}

// ---- linear systems -----------------------------------------------------------------------------

//! Maximum number of vertices for a factorization. In 3D a larger factor takes longer than the
//! iteration.
constexpr Index most_factored(int dim) {
  return dim == 2 ? 2000000 : 20000;
}

// ---- when a run ends ----------------------------------------------------------------------------

//! Default tolerances and certified gap. The gap is as close to the optimum as the tolerances are
//! on other cages; in half precision gaps of about 4e-4 remain.
constexpr double kTolerance = 1e-7, kGradientTolerance = 1e-6, kGap = 1e-3;
//! The default gap ends a run only if the estimated error of the weights is at most so many
//! tolerances, or if the gap is at most the second. Weights of round cages still drift at a gap of
//! 1e-3 (lab book).
constexpr double kSettled = 10, kSmallGap = 1e-4;
//! Minimum number of iterations, and iterations between two reports of progress.
constexpr int kFewestIterations = 8;
constexpr int kCheckInterval = 10;
//! Maximum number of vertices whose weights are compared; larger meshes are sampled.
constexpr std::size_t kFewestSampled = 4096;
//! First iteration with a certificate, and the factor to the next. A certificate takes as long as
//! ten iterations, and most runs meet their tolerance before.
constexpr int kFirstCertified = 500;
constexpr double kCertifiedGrowth = 1.2;
//! An unknown error counts as this many tolerances.
constexpr double kUnknownError = 2;
//! `gradient`: iterations between two recoveries, each of which takes as long as one or two
//! iterations; recoveries that are judged together; and the least error relative to the squared
//! residual that it had on all meshes tried.
constexpr int kRecoveryInterval = 40;
constexpr std::size_t kRecoveriesJudged = 3;
constexpr double kErrorOfResidual = 2;

//! The estimate (run/error_estimate.h), as measured on 46 cages and meshes with known optima (lab
//! book).
namespace error_estimate {
//! The weights of an iteration are compared with the latest kept ones of at most the first of these
//! times its number. Weights are kept whenever the number has grown by the second.
constexpr double kLag = 0.8, kKeptGrowth = 1.2;
constexpr double kSafety = 1.5;  //!< factor of the extrapolated squared error
//! Maximum factor by which movements shrink in the extrapolation.
constexpr double kLeastProgress = 0.97;
//! A start from a similar problem counts as so many iterations.
constexpr int kMadeBefore = 100;
constexpr double kOfChange = 400;  //!< minimum error relative to a single squared change
//! Weights whose gradients are off by the residual are off by the Poincare constant times that,
//! 0.025 of the squared size on a square or a few times as much; more if it decays slowly.
constexpr double kPoincare = 0.045;
constexpr double kPerIteration = 7e-4;
constexpr int kFirstMeasured = 48;  //!< earlier differences still include the start and are large
//! Cold starts end before the first look at the penalty only with an estimate that is so many times
//! smaller: a penalty that is too large hides weights in slits and spikes.
constexpr double kEarlySafety = 1000;
//! The same before kFirstMeasured where there are no looks, and while weights have moved by less
//! than so many tolerances since a cold start (mean squares). Those of round cages are nearly right
//! at the start, rest for some hundred iterations, and move on.
constexpr double kRestingSafety = 10, kFewMoved = 10;
//! Above this tolerance both do not matter: errors at the start are 2e-5 to 2e-3.
constexpr double kLooseTolerance = 1e-4;
constexpr int kInterval = 32;  //!< between two measurements, relative to the iterations so far
}  // namespace error_estimate

// ---- active set ---------------------------------------------------------------------------------

//! Minimum number of control points and pairs. Below, lists are not much shorter than all control
//! points. In 2D, lists are too short for the iteration.
constexpr Index kActiveControlPoints = 80;
constexpr double kActivePairs = 4e5;
//! Maximum fraction of all pairs for which it is faster.
constexpr double kActiveDensity = 0.5;
//! Harmonic coordinates above this are initially active; they extend farther than the final
//! weights.
constexpr double kLeastHarmonic = 3e-3;
//! Weights above this factor times sqrt(tolerance), within these limits, are active.
constexpr double kActiveErrors = 3, kActiveLeast = 1e-5, kActiveMost = 1e-3;
//! Iterations between two checks of the border of the active set, and between its growth and the
//! end of a run. New weights need this time to settle.
constexpr int kBetweenLooks = 30, kAfterGrowth = 20;
//! The active set grows if squared weights at its border exceed this fraction of the error.
constexpr double kEndsOfError = 0.1;
//! Iterations in which duals grow from zero. During these, small changes do not imply a small
//! error.
constexpr int kUntilDualsAreThere = 100;

// ---- coarser meshes -----------------------------------------------------------------------------

//! Minimum ratio of vertices between a level and the next coarser one.
constexpr double kClearlyFiner = 1.7;
//! CoarseToFine::kOn: minimum number of vertices of a coarse mesh.
constexpr Index kCoarsest = 500;
//! 3D, `value` on all pairs: below this tolerance a cold start is faster. A multilevel start saves
//! only the first iterations, and at such tolerances most iterations are late ones.
constexpr double kCoarseStartTolerance = 3e-7;

//! Tolerance on coarse meshes relative to the final one.
constexpr double kLooseness = 4;

//! When a multilevel start pays. `value` needs few iterations, so coarse meshes must be cheap: one
//! level with a tenth of the vertices.
struct Worthwhile {
  double numbers;  //!< minimum of vertices times control points
  Index coarsest;  //!< vertices
  double factor;   //!< from mesh to mesh
};
//! \param on_active_set  after a multilevel start, it need not grow and takes a third of the
//! iterations
constexpr Worthwhile worthwhile(int dim, bool on_active_set) {
  return on_active_set ? Worthwhile{kActivePairs, 500, 12}
         : dim == 2    ? Worthwhile{2.5e5, 900, 10}
                       : Worthwhile{7e5, 1000, 12};
}

// ---- distances behind phi -----------------------------------------------------------------------

//! Minimum number of vertices (3D) and minimum tolerance for interpolated distances. On smaller
//! meshes, the coarse mesh takes as long as exact distances. The largest squared change of weights
//! on any model was 9e-8, and it is not always predicted.
constexpr Index kInterpolatedVertices = 3000;
constexpr double kInterpolatedTolerance = 1e-7;
//! Convex cages have exact distances below this tolerance. On spheres of 26 and 102 control points,
//! interpolated phi with an error of 2.5e-4 moves weights by 2 to 3e-7 (squared).
constexpr double kConvexTolerance = 1e-6;
//! Vertices of a mesh used only for distances: the minimum for the cage at this tolerance or a
//! larger one, otherwise a twelfth.
constexpr double kCoarsestDistances = 1e-6;
constexpr Index kDistancesRatio = 12;
//! Control points whose distances are checked: two, and one in 32, at most ten.
constexpr Index kCheckedOneIn = 32, kCheckedMost = 10;
//! Squared change of weights per squared relative error of phi: four times the maximum over all
//! models with an error of at least 0.4%. Interpolation is kept if the effect is at most this
//! fraction of the tolerance.
constexpr double kWeightsOfPhi = 3e-4, kPartOfTolerance = 0.5;

}  // namespace flbc::plan
