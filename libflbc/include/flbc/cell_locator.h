// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Which cell of a mesh contains a point.
#pragma once

#include <memory>
#include <vector>

#include "flbc/domain_mesh.h"

namespace flbc {

//! A place in a mesh: a cell and barycentric coordinates in it.
template <int Dim>
struct Location {
  Index cell = -1;                                //!< -1 = nowhere in the mesh
  Eigen::Matrix<double, Dim + 1, 1> coordinates;  //!< sum to 1; may be below 0 by the tolerance
};

//! Finds the cell that contains a point, by a uniform grid over the mesh. Keeps a reference to the
//! mesh.
template <int Dim>
class CellLocator {
 public:
  //! Builds the grid.
  //! \param mesh  valid (normalize_and_validate), outlives the locator
  explicit CellLocator(const DomainMesh<Dim>& mesh);
  ~CellLocator();

  //! The cell that contains the point or, if none does, the nearest one by its barycentric
  //! coordinates among those whose bounding box holds the point.
  //! \param point  in the units of the mesh
  //! \param tolerance  how far outside, in units of the mesh, a point may lie
  //! \return cell -1 if the point is outside
  Location<Dim> locate(const Vector<Dim>& point, double tolerance) const;

 private:
  struct Grid;
  const DomainMesh<Dim>& mesh_;
  std::unique_ptr<Grid> grid_;
};

//! Locates points inside the cage.
//! \param mesh  valid
//! \param points  Dim x P, in the units of the mesh
//! \return P places; points within tolerance of the mesh are in the nearest cell
//! \throws InputError naming the first point that lies outside the mesh by more than 1e-6 of its
//! size, and how many do
template <int Dim>
std::vector<Location<Dim>> locate_points(const DomainMesh<Dim>& mesh, const PointList<Dim>& points);

}  // namespace flbc
