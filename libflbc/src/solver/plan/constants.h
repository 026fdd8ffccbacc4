// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Every constant that a solve chooses on its own, with the measurement behind it. docs/benchmarks
//! and docs/contributing/lab_book.md have the tables.
#pragma once

#include <cstddef>

#include "flbc/types.h"

namespace flbc::plan {

// ---- penalties, with the diagonal of the cage's bounding box as the unit of length --------------

//! `value`, first penalty. A fortieth suits all models roughly; balancing does the rest.
constexpr double kFirstPenalty = 1.0 / 40;
//! `value`, largest penalty. Balancing compares lengths of all that moves. On round cages the start
//! is nearly right everywhere, and the balance alone leaves the range in which the rest converges.
constexpr double kLargestPenalty = 1.0 / 30;
//! `value`: a balanced penalty is this times |dual| / |motion since the start|.
constexpr double kBalance = 0.3;
//! `value` on all pairs balances after these iterations.
constexpr int kBalancedAfter[] = {5, 10, 20, 40};
//! `value` on the active set balances after these, by rebuilding the iteration.
constexpr int kFirstBalance = 10, kLastBalance = 40;
//! `value` on the active set takes this part of the penalty of all pairs: fewer weights move, and
//! after a start from a coarser mesh they are nearly right already.
constexpr double kActivePenaltyCold = 0.5, kActivePenaltyWarm = 0.25;
//! `lbc2014`, where no penalty is given: rho m is on average this times the measure of a cell. The
//! best of those measured from 1/120 to 1/10 (lab book).
constexpr double kLbc2014Penalty = 1.0 / 30;
//! `gradient`: mu is this times the measure of a typical facet. Scaled duals are then
//! as large as gradients. The multiplier of a facet is a potential, of the order of the size times
//! the facet, and takes longest to build up. Best on all models (lab book).
constexpr double gradient_penalty(int dim) {
  return dim == 2 ? 1.0 / 3500 : 1.0 / 6000;
}
//! `paper`: section 5, in the published unit of length.
constexpr double published_gradient_penalty(int dim) {
  return dim == 2 ? 100 : 10000;
}

// ---- metric, relaxation, starts -----------------------------------------------------------------

//! Weight of u = w per vertex mass and squared size, relative to the cells' metric. Iterations
//! hardly depend on it between 10 and 300.
constexpr double kVertexWeight = 100;
//! Over-relaxation: `value` and tuned `lbc2014`; `gradient`; `lbc2014` as published.
constexpr double kRelaxation = 1.9, kGradientRelaxation = 1.8, kPublishedRelaxation = 1.65;
//! Steps of a Richardson iteration from zero to harmonic coordinates. The first is by far the
//! longest; the others only make up for the vertex metric.
constexpr int kHarmonicSteps = 8;
//! Mean squared change of a weight below which they end.
constexpr double kHarmonicChange = 1e-9;

// ---- precision ----------------------------------------------------------------------------------

//! Largest tolerance that half precision of the cells' duals cannot serve. Radii are rounded by
//! 1.4e-4 on average, which moves weights by a few 1e-11 squared on models.
constexpr double kHalfIsEnough = 1e-7;
//! Fewest cells for half precision: on smaller meshes roundings move weights more, and a solve is
//! fast anyway.
constexpr Index kHalfCells = 10000;
//! Half precision ends at this estimated error or after so many iterations: duals rounded in each
//! iteration make weights tremble, and the estimate cannot tell that from progress.
constexpr double kTremblingError = 1e-6;
constexpr int kTremblingIterations = 300;
constexpr bool trembles(int iterations, double error) {
  return iterations >= kTremblingIterations || error < kTremblingError;
}

// ---- linear systems -----------------------------------------------------------------------------

//! Most vertices that are factored. In 3D a factor of more takes longer than the iteration.
constexpr Index most_factored(int dim) {
  return dim == 2 ? 2000000 : 20000;
}

// ---- when a run ends ----------------------------------------------------------------------------

//! Default tolerances and certified gap. The gap is as near the optimum as tolerances bring other
//! cages; in half precision gaps of about 4e-4 remain.
constexpr double kTolerance = 1e-7, kGradientTolerance = 1e-6, kGap = 1e-3;
//! `value` makes at least so many iterations.
constexpr int kFewestIterations = 8;
//! Vertices whose weights are compared: all of them up to this number, a sample of more.
constexpr std::size_t kFewestSampled = 4096;
//! First iteration that may be certified, and the factor to the next: a certificate takes as long
//! as ten iterations, and most runs meet their tolerance before.
constexpr int kFirstCertified = 500;
constexpr double kCertifiedGrowth = 1.2;
//! An error that is not known counts as so many tolerances.
constexpr double kUnknownError = 2;
//! `gradient`: iterations between two recoveries, each of which takes as long as one or two of
//! them; recoveries that are judged together; and the least error relative to the squared residual
//! that it had on all meshes tried.
constexpr int kRecoveryInterval = 32;
constexpr std::size_t kRecoveriesJudged = 3;
constexpr double kErrorOfResidual = 2;

//! The estimate of `value` (run/error_estimate.h), as measured on all test models, round cages and
//! warm starts.
namespace error_estimate {
constexpr double kOfChange = 400;     //!< least error relative to a single squared change
constexpr double kLeast = 0.5;        //!< of the rest, relative to the last squared difference
constexpr double kMost = 30;          //!< the same
constexpr double kPowerSafety = 0.4;  //!< the promise allows an error of 3 tolerances
constexpr double kFarthest = 1.5;     //!< looked ahead, relative to the iterations so far
constexpr double kPart = 0.2;         //!< of the iterations so far, for the regression
constexpr double kFall = 0.5;         //!< least rate to come, relative to the present one, squared
//! Weights whose gradients are off by the residual are off by the Poincare constant times that,
//! 0.025 of the squared size on a square or a few times as much; by more the longer it takes to
//! fade.
constexpr double kPoincare = 0.06;
constexpr double kPerIteration = 9e-4;
constexpr int kFirstMeasured = 48;  //!< differences still see the start, and are large, before
constexpr int kInterval = 32;       //!< between two measurements, relative to the iterations so far

//! At first rates alone are not trusted in 3D; in 2D they were right on every model.
struct Early {
  int iterations;  //!< in which they are not
  double part;     //!< of k^2 changes, up to then
  double safety;   //!< of the squared rest by the rate
};
constexpr Early early(int dim) {
  return dim == 2 ? Early{0, 0, 1.25} : Early{104, 0.4, 1.5};
}
}  // namespace error_estimate

// ---- active set ---------------------------------------------------------------------------------

//! Fewest control points and pairs. Below, lists are not much shorter than all control points; in
//! 2D they hold too few to leave the iteration freedom.
constexpr Index kActiveControlPoints = 80;
constexpr double kActivePairs = 4e5;
//! Largest part of all pairs for which it is faster.
constexpr double kActiveDensity = 0.5;
//! Harmonic coordinates above this are active at first: they reach farther than the weights that
//! follow from them.
constexpr double kLeastHarmonic = 3e-3;
//! Weights above errors times sqrt(tolerance), within these limits, are active.
constexpr double kActiveErrors = 3, kActiveLeast = 1e-5, kActiveMost = 1e-3;
//! Iterations between two looks at the ends of the active set, and before a run may end after it
//! grew: weights spread to a neighbor and settle there.
constexpr int kBetweenLooks = 30, kAfterGrowth = 20;
//! It grows where squared weights at its ends are more than this part of the error.
constexpr double kEndsOfError = 0.1;
//! Iterations in which duals grow from nothing. Before, small changes do not show a small error.
constexpr int kUntilDualsAreThere = 100;

// ---- coarser meshes -----------------------------------------------------------------------------

//! A mesh is a level of its own if it has so many times the vertices of the next coarser one.
constexpr double kClearlyFiner = 1.7;
//! CoarseToFine::kOn: fewest vertices of a coarse mesh.
constexpr Index kCoarsest = 500;
//! 3D, `value` on all pairs: below this tolerance a cold start is faster. A coarse start saves the
//! first iterations and none of the last, which are most of them then.
constexpr double kCoarseStartTolerance = 3e-7;

//! Where a coarse start pays. Iterations of `value` are few, so that a coarse mesh must cost
//! little: a tenth of the vertices, and once.
struct Worthwhile {
  double numbers;  //!< least number of vertices times control points
  Index coarsest;  //!< vertices
  double factor;   //!< from mesh to mesh
};
//! \param on_active_set  needs no growth after a coarse start, and a third of the iterations
constexpr Worthwhile worthwhile(int dim, bool on_active_set) {
  return on_active_set ? Worthwhile{kActivePairs, 500, 12}
         : dim == 2    ? Worthwhile{2.5e5, 900, 10}
                       : Worthwhile{7e5, 1000, 12};
}

// ---- distances behind phi -----------------------------------------------------------------------

//! Interpolated from a coarser mesh: in 3D from so many vertices on (below, the mesh for the
//! distances alone takes as long as they do), and not for smaller tolerances: the largest change of
//! the weights of any model was 9e-8 squared, and it is not foreseen everywhere.
constexpr Index kInterpolatedVertices = 3000;
constexpr double kInterpolatedTolerance = 1e-7;
//! Vertices of a mesh for distances alone: as few as the cage allows at this tolerance or a larger
//! one, else a twelfth.
constexpr double kCoarsestDistances = 1e-6;
constexpr Index kDistancesRatio = 12;
//! Control points whose distances are checked: two, and one in 32, at most ten.
constexpr Index kCheckedOneIn = 32, kCheckedMost = 10;
//! Squared change of weights per squared relative error of phi: four times what it was on any model
//! where the error was 0.4% and more. Kept if at most this part of the tolerance.
constexpr double kWeightsOfPhi = 3e-4, kPartOfTolerance = 0.5;

}  // namespace flbc::plan
