// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Coordinates on a mesh of OpenMesh, or a TetMesh, that follow a cage while its rest shape is
//! being edited.
#pragma once

#include <string>
#include <utility>

#include "flbc/editing.h"
#include "flbc/openmesh/convert.h"
#include "flbc/openmesh/lbc.h"

namespace flbc::openmesh {

//! EditableCoordinates on a mesh: after every step the vertices stand where the reshaped cage takes
//! them, and the weights property holds the coordinates for that shape. Steps go on from the double
//! precision points that are kept here, not from the mesh's, which may have single precision.
//!
//! The mesh has to live as long as this object; its elements must not change meanwhile.
//! \tparam Mesh  a triangle mesh in the plane, or a TetMesh
template <class Mesh>
class EditableMesh {
 public:
  static constexpr int kDim = kDimension<Mesh>;

  //! Solves for the first shape.
  //! \param mesh  of the cage's interior, V vertices
  //! \param cage  n control points
  //! \param options  of all solves
  //! \param weights  name of the property, a row of n doubles per vertex
  //! \param mesher  makes coarser meshes of the cage (see EditableCoordinates); {} for none. By
  //! default that of the component which the program links, as in solve()
  //! \throws InputError if mesh and cage do not belong together; OptionError, SolverError
  EditableMesh(
      Mesh& mesh, const Cage<kDim>& cage, const SolverOptions& options = {},
      std::string weights = kWeights,
      const MesherArgument<kDim>& mesher = internal::coarse_mesher(internal::linked_mesher<kDim>()))
      : mesh_(mesh),
        weights_(std::move(weights)),
        coordinates_(cage, snapped_domain(mesh, cage).mesh, options, mesher) {
    set_weights(mesh_, coordinates_.solution().weights, weights_);
    set_rest_cage(mesh_, cage.points, weights_);
  }

  //! Moves the control points there, the mesh with them, and solves. After an exception mesh and
  //! weights are as they were.
  //! \param control_points  kDim x n, in the units of the cage
  //! \param budget  of this step
  //! \return the report of this step alone
  //! \throws as EditableCoordinates::move()
  const SolveReport& move(const PointList<kDim>& control_points, const EditBudget& budget = {}) {
    coordinates_.move(control_points, budget);
    set_points(mesh_, coordinates_.mesh().points);
    set_rest_cage(mesh_, control_points, weights_);
    return left_on_mesh();
  }

  //! Goes on where the last step ended, for example because of its budget.
  //! \param budget  of this step
  //! \return the report of this step alone
  //! \throws OptionError, SolverError; the weights are then as they were
  const SolveReport& refine(const EditBudget& budget = {}) {
    coordinates_.refine(budget);
    return left_on_mesh();
  }

  //! The coordinates behind the properties, with the cage and the mesh as they are now.
  EditableCoordinates<kDim>& coordinates() { return coordinates_; }

 private:
  const SolveReport& left_on_mesh() {
    set_weights(mesh_, coordinates_.solution().weights, weights_);
    return coordinates_.solution().report;
  }

  Mesh& mesh_;
  std::string weights_;
  EditableCoordinates<kDim> coordinates_;
};

}  // namespace flbc::openmesh
