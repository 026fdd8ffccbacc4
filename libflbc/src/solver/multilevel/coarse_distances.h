// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Distances from a coarser mesh where they are good enough, and while the cage and its mesh move.
#pragma once

#include <vector>

#include "flbc/options.h"
#include "flbc/report.h"
#include "solver/multilevel/coarse_problem.h"

namespace flbc {

//! Interpolates distances, checks them against exact ones of some control points, and for
//! Distances::kAuto computes all of them if they change the weights too much.
//! \param coarse  with the places of the problem's vertices
//! \param problem  whose phi is not asked for
//! \param report  becomes what was done
//! \return n x V
template <int Dim>
DistanceMatrix choose_distances(const CoarseProblem<Dim>& coarse, const LbcProblem<Dim>& problem,
                                const SolverOptions& options, DistanceReport& report);

//! A coarse mesh that moves along with a finer one of the same cage, which takes its distances from
//! there instead of computing all of them for every shape.
template <int Dim>
class MovingDistances {
 public:
  //! \param coarse  with the places of the fine vertices \param fine  of the same shape
  MovingDistances(CoarseProblem<Dim> coarse, const LbcProblem<Dim>& fine);

  //! From now on the coarse mesh follows the control points by these weights.
  //! \param weights  n x V of the fine mesh, by which that one follows
  void anchor(const DomainMesh<Dim>& fine, const WeightMatrix& weights);

  //! Distances for another shape, as choose_distances(); exact where the coarse mesh folds.
  //! \param fine  of that shape, whose phi is not asked for \return n x V
  DistanceMatrix operator()(const LbcProblem<Dim>& fine, const SolverOptions& options,
                            DistanceReport& report);

 private:
  CoarseProblem<Dim> coarse_;          // as the last shape had it
  DomainMesh<Dim> first_;              // scaled as all are
  std::vector<Location<Dim>> places_;  // of the coarse vertices in the fine mesh
  WeightMatrix weights_;               // of the coarse vertices
};

}  // namespace flbc
