// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Distances from a coarser mesh, if accurate enough, also while the cage and its mesh move.
#pragma once

#include <vector>

#include "flbc/report.h"
#include "solver/multilevel/coarse_problem.h"
#include "solver/plan/settings.h"

namespace flbc {

//! Interpolates distances and compares them with exact distances of some control points. For
//! Distances::kAuto, computes all distances exactly if the effect on the weights is too large.
//! \param coarse  with the locations of the vertices of the problem
//! \param problem  phi is not needed
//! \param report  output
//! \return n x V
template <int Dim>
DistanceMatrix choose_distances(const CoarseProblem<Dim>& coarse, const LbcProblem<Dim>& problem,
                                const plan::Settings& settings, DistanceReport& report);

//! A coarse mesh that moves with a finer mesh of the same cage. The finer mesh interpolates its
//! distances instead of computing them for every rest cage.
template <int Dim>
class MovingDistances {
 public:
  //! \param coarse  with the locations of the fine vertices \param fine  of the same rest cage
  MovingDistances(CoarseProblem<Dim> coarse, const LbcProblem<Dim>& fine);

  //! Sets the weights by which the coarse mesh follows the control points.
  //! \param weights  of V points, by which the fine mesh follows
  void anchor(const DomainMesh<Dim>& fine, const SparseWeights& weights);

  //! Distances for another rest cage, as choose_distances(); exact if the coarse mesh folds.
  //! \param fine  of that rest cage, phi is not needed \return n x V
  DistanceMatrix operator()(const LbcProblem<Dim>& fine, const plan::Settings& settings,
                            DistanceReport& report);

 private:
  CoarseProblem<Dim> coarse_;          // for the last rest cage
  DomainMesh<Dim> first_;              // scaled like all problems
  std::vector<Location<Dim>> places_;  // of the coarse vertices in the fine mesh
  WeightMatrix weights_;               // of the coarse vertices
};

}  // namespace flbc
