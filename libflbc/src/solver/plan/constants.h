// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Every automatic constant of a solve, with the measurement behind it.
#pragma once

#include "flbc/types.h"

namespace flbc::plan {

// ---- penalties, unit of length: diagonal of the cage bounding box --------------

//! `weights`: the penalty is the first plus the second times epsilon, because the best penalty for
//! the quadratic term alone is proportional to it. Iterations to true errors of 1e-4 to 1e-7 on
//! nine models, at epsilon 0 to 0.03, are within 5% of those of the best penalty for each epsilon.
constexpr double kPenalty = 1.0 / 40, kPenaltyOfSmoothness = 14;
//! `weights` on the active set uses this fraction of the penalty of all pairs. Fewer weights move,
//! and after a multilevel start they are nearly correct.
constexpr double kActivePenaltyCold = 0.5, kActivePenaltyWarm = 0.25;
//! `lbc2014` without a given penalty: on average, rho m is this times the measure of a cell. Best
//! value measured from 1/120 to 1/10.
constexpr double kLbc2014Penalty = 1.0 / 30;
//! `gradient`: mu is this times the measure of a typical facet. Scaled duals are then as large as
//! gradients. The multiplier of a facet is a potential of the order of cage size times facet
//! measure, and grows slowest. Best on all models.
constexpr double gradient_penalty(int dim) {
  return dim == 2 ? 1.0 / 3500 : 1.0 / 6000;
}
//! `paper`: section 5, in the published unit of length.
constexpr double published_gradient_penalty(int dim) {
  return dim == 2 ? 100 : 10000;
}

// ---- metric, relaxation, starts -----------------------------------------------------------------

//! Weight of u = w per vertex mass and squared size, relative to the cell metric. Iterations do not
//! depend on it between 3 and 10, and grow by 5% at 100.
constexpr double kVertexWeight = 10;
//! Over-relaxation: `weights` and tuned `lbc2014`; `gradient`; `lbc2014` as published.
constexpr double kRelaxation = 1.9, kGradientRelaxation = 1.8, kPublishedRelaxation = 1.65;
//! Steps of a Richardson iteration from zero to harmonic coordinates. The first is by far the
//! largest; the others only correct for the vertex metric.
constexpr int kHarmonicSteps = 8;

// ---- linear systems -----------------------------------------------------------------------------

//! Maximum number of vertices for a factorization. In 3D a larger factor takes longer than the
//! iteration.
constexpr Index most_factored(int dim) {
  return dim == 2 ? 2000000 : 20000;
}

// ---- when a run ends ----------------------------------------------------------------------------

//! Default smoothness. Compared with 0, influences grow by 7 to 30%, and creases of poses are
//! nearer to those of harmonic coordinates (docs/results/smoothness.csv).
constexpr double kSmoothness = 0.003;
//! Default tolerance.
constexpr double kTolerance = 1e-6;
//! The same of kWeights for a certificate. At 1e-6 the objective itself is up to 1.8% too high, and
//! gaps are 1.1 to 9.5%; at 1e-8 they are 0.08 to 0.56% (docs/results/gaps.csv).
constexpr double kCertifiedTolerance = 1e-8;
//! The same for `paper` and `lbc2014`, section 5 of the paper.
constexpr double kPublishedTolerance = 1e-7;
//! Weights below this factor times sqrt(tolerance) become 0 where the others carry the vertex
//! nearly alike. They are errors of the iteration.
constexpr double kNegligible = 0.1;
//! Default certified gap without smoothness, whose optimum does not determine the weights.
constexpr double kGap = 1e-3;
//! Iterations between two checks where single iterations cost more than those of a batch, and
//! between two reports of progress.
constexpr int kCheckInterval = 10;
//! First iteration with a certificate, and the factor to the next. A certificate takes as long as
//! ten iterations.
constexpr int kFirstCertified = 50;
constexpr double kCertifiedGrowth = 1.4;

// The estimate (run/stop_rule.h). On nine models, true errors at the end of a run are at most 0.4
// of tolerances from 1e-4 to 1e-7, and 1.6 of 1e-8 (docs/results/tolerance.csv). tolerance_test
// allows round cages 10.
//! Weights circle their limit, so the mean of this many changes counts.
constexpr int kCircle = 4;
//! The rate compares means this many iterations apart.
constexpr int kLag = 16;
//! The rate until there are that many, and the largest one.
constexpr double kFirstRate = 0.95, kLargestRate = 0.97;
//! Late in a run errors shrink at least like this power of the iterations, which allows rates
//! nearer to 1.
constexpr double kLeastPower = 2;
//! `gradient`: squared error of a weight per squared error of a gradient (Poincare constant; the
//! squared size of the cage is 1).
constexpr double kSquaredWeightOfGradient = 0.045;
//! Factor of the estimated squared error.
constexpr double kSafety = 4;
//! Minimum number of iterations.
constexpr int kFewestIterations = 8;

// ---- active set ---------------------------------------------------------------------------------

//! Maximum fraction of all pairs for which it is used. At fractions of 0.06 to 0.22 it takes 0.32
//! to 1.05 times as long as all pairs (docs/results/many.csv).
constexpr double kActiveDensity = 0.3;
//! With masks, a cold start with fewer pairs has them all.
constexpr double kActivePairs = 4e5;
//! Harmonic coordinates above this are initially active; they extend farther than the final
//! weights.
constexpr double kLeastHarmonic = 3e-3;
//! Weights above this factor times sqrt(tolerance), at most the second, are active.
constexpr double kActiveErrors = 3, kActiveMost = 1e-3;
//! Iterations between two checks of the border of the active set.
constexpr int kBetweenLooks = 30;
//! The active set grows if squared weights at its border exceed this fraction of the error.
constexpr double kEndsOfError = 0.1;

// ---- coarse meshes ------------------------------------------------------------------------------

//! Tolerance on the coarse mesh. A start does not depend on the tolerance, so a run can resume with
//! another.
constexpr double kCoarseTolerance = 1e-5;

//! Mean squared difference between the weights on a refined mesh and those on its coarse mesh,
//! divided by the error of the refined mesh. Measured against six to eight times the vertices: on
//! eight cages in 3D 18 to 31 at the vertices of the mesh, 6 to 20 at those of seven models; on
//! four in 2D 3 to 7, and 31 where the error is far below the tolerance.
constexpr double coarse_to_mesh_error(int dim) {
  return dim == 2 ? 5 : 15;
}

// ---- distances behind phi -----------------------------------------------------------------------

//! Control points whose distances are checked.
constexpr Index kCheckedControlPoints = 4;
//! Squared change of weights per squared relative error of phi: four times the maximum over all
//! models with an error of at least 0.4%. Interpolation is kept if the effect is at most this
//! fraction of the tolerance.
constexpr double kWeightsOfPhi = 3e-4, kPartOfTolerance = 0.5;

}  // namespace flbc::plan
