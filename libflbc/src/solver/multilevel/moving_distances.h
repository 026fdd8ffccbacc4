// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Distances while the cage and its mesh move.
#pragma once

#include <vector>

#include "flbc/options.h"
#include "flbc/report.h"
#include "solver/multilevel/coarse_problem.h"

namespace flbc {

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
