// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Coordinates that follow a cage while its rest shape is being edited.
#pragma once

#include <memory>

#include "flbc/solver.h"

namespace flbc {

//! How much one step of an edit may cost, so that a user who drags a control point gets a result
//! per frame. At least one iteration is made.
struct EditBudget {
  int iterations = 0;  //!< at most so many, >= 1; 0 = as options say
  double seconds = 0;  //!< none begins later, set-up included; 0 = no limit. Results then depend on
                       //!< how fast the machine is.
};

//! A cage and a mesh of its interior that change shape together, with coordinates for the present
//! shape. Each solve starts from the weights and duals of the one before, which saves most
//! iterations if the cage moved little.
//!
//! The mesh follows the control points by weights of its own: x' = C' w. These are the coordinates
//! of the first shape (or of the one that anchor() chose), so that where vertices go depends on
//! where the control points are and not on how they came there, or how exactly the shapes in
//! between were solved; vertices on the cage stay on it. Cage facets that pass through each other
//! without turning a cell over are not noticed.
template <int Dim>
class EditableCoordinates {
 public:
  //! Solves for the first shape.
  //! \param cage  n control points
  //! \param mesh  V vertices, a mesh of the cage's interior (see normalize_and_validate)
  //! \param options  of all solves; kValue and kGradient start from the solve before, other methods
  //! afresh
  //! \param mesher  makes coarser meshes for the first solve; one of them then moves along, and
  //! distances come from there where SolverOptions::distances allow. Empty for none
  //! \throws InputError if mesh and cage do not belong together; OptionError, SolverError
  EditableCoordinates(Cage<Dim> cage, DomainMesh<Dim> mesh, const SolverOptions& options = {},
                      const CoarseMesher<Dim>& mesher = {});
  ~EditableCoordinates();
  EditableCoordinates(EditableCoordinates&&) noexcept;
  EditableCoordinates& operator=(EditableCoordinates&&) noexcept;

  //! Moves the control points there, the mesh with them, and solves. After any exception all is as
  //! it was.
  //! \param control_points  Dim x n, in the units of the cage
  //! \param budget  of this step
  //! \return the coordinates, with status kIterationLimit where the budget ended the solve; its
  //! report is of this step alone
  //! \throws InputError if their number differs, one is not finite, the cage becomes defective, or
  //! a cell would turn over, naming the cell and its place; OptionError for an impossible budget;
  //! SolverError
  const Solution& move(const PointList<Dim>& control_points, const EditBudget& budget = {});

  //! Goes on where the last step ended, for example because of its budget, without set-up of the
  //! weight functions.
  //! \param budget  of this step
  //! \return the coordinates; their report is of this step alone
  //! \throws OptionError, SolverError; the coordinates are then as they were
  const Solution& refine(const EditBudget& budget = {});

  //! From now on the mesh follows by the present coordinates, from the present shape. For edits so
  //! large that cells would turn over on the direct way; the mesh of a cage that is moved back
  //! then no longer is exactly what it was.
  void anchor();

  //! The coordinates of the present shape, n x V, and the report of the last step.
  const Solution& solution() const;

  //! As it is now.
  const Cage<Dim>& cage() const;

  //! As it is now; its cells never change.
  const DomainMesh<Dim>& mesh() const;

 private:
  struct Shape;
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace flbc
