// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Transfers duals to a start on a refined mesh, or on the same mesh after a move.
#pragma once

#include <array>
#include <vector>

#include "flbc/lbc_problem.h"
#include "solver/start/warm_start.h"

namespace flbc {

//! Evaluates the duals of one mesh on another. Keeps references to its arguments.
template <int Dim>
class Prolongation {
 public:
  //! To another rest cage of the same mesh. Flux densities are unchanged, because deforming them
  //! with their cells saves no iterations.
  Prolongation(const LbcProblem<Dim>& from, const WarmStart<Dim>& warm_start,
               const LbcProblem<Dim>& to)
      : from_(from), warm_start_(warm_start), to_(to) {}

  //! From a coarse mesh to its refinement. \param ends  CoarseMesh::ends, not empty
  Prolongation(const LbcProblem<Dim>& from, const WarmStart<Dim>& warm_start,
               const LbcProblem<Dim>& to, const std::vector<std::array<Index, 2>>& ends)
      : from_(from), warm_start_(warm_start), to_(to), ends_(&ends) {}

  //! The start on the other mesh; it refers to this object. Weights are interpolated. The flux
  //! density is that of the cell of which a cell is a part, made admissible.
  Start<Dim> start() const;

  //! The vertices between which a vertex of the other mesh lies; twice the same if it is one.
  std::array<Index, 2> ends_of(Index vertex) const {
    return ends_ == nullptr ? std::array{vertex, vertex} : (*ends_)[vertex];
  }

  const DomainMesh<Dim>& mesh() const { return from_.mesh; }
  const SparseWeights& weights() const { return warm_start_.weights; }

 private:
  const LbcProblem<Dim>& from_;
  const WarmStart<Dim>& warm_start_;
  const LbcProblem<Dim>& to_;
  const std::vector<std::array<Index, 2>>* ends_ = nullptr;
};

}  // namespace flbc
