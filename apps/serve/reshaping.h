// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Weights for a cage whose resting shape a user changes in the page.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "flbc/solver.h"
#include "view/page.h"

namespace flbc::app {

//! Answers of `flbc view --serve`.
template <int Dim>
class Reshaping {
 public:
  //! Solves for the first shape. \param mesh  of the cage's interior
  //! \param model  Dim x P, which stays where it is; without points the mesh is shown and moves
  //! along \param mesher  makes coarser meshes of the cage; may be empty
  //! \throws InputError, OptionError, SolverError
  Reshaping(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh, PointList<Dim> model,
            const SolverOptions& options, const CoarseMesher<Dim>& mesher);

  //! Weights at the points shown, of few influences, for the present shape.
  SparseWeights weights() const;
  //! The points shown.
  const PointList<Dim>& points() const;
  //! The present shape.
  const Cage<Dim>& cage() const { return solver_.cage(); }

  //! Solves for another shape, or goes on with the present one, within a budget of time.
  //! \param request  JSON: {"points": Dim n numbers} or {"refine": true}
  //! \return JSON: "converged", "iterations", "residual" (1 = as wanted), "milliseconds", and
  //! "update" (view::make_update()); or "refused" with the reason, the shape being as it was then
  std::string answer(const std::string& request);

 private:
  void move(const PointList<Dim>& control_points);
  std::string update() const;

  PointList<Dim> model_;
  Vector<Dim> center_;
  Solver<Dim> solver_;
};

}  // namespace flbc::app
