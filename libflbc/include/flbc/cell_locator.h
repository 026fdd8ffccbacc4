// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Finds the cell of a mesh that contains a point, and interpolates weights there.
#pragma once

#include <memory>
#include <vector>

#include "flbc/domain_mesh.h"
#include "flbc/sparse_weights.h"

namespace flbc {

//! A place in a mesh: a cell and barycentric coordinates in it.
template <int Dim>
struct Location {
  Index cell = -1;                                //!< -1: outside the mesh
  Eigen::Matrix<double, Dim + 1, 1> coordinates;  //!< sum to 1; may be negative within the
                                                  //!< tolerance
};

//! Finds the cell that contains a point, with a uniform grid.
template <int Dim>
class CellLocator {
 public:
  //! Builds the grid.
  //! \param mesh  valid (normalize_and_validate)
  //! \param boxes_per_cell  fineness of the grid. With 8 instead of 1, searches are twice as fast,
  //! but building takes four times as long, which pays above about a million points
  explicit CellLocator(const DomainMesh<Dim>& mesh, double boxes_per_cell = 1);
  ~CellLocator();

  //! Returns the cell that contains the point. If no cell does, returns the nearest one by
  //! barycentric coordinates among the cells whose bounding box contains the point.
  //! \param point  in the units of the mesh
  //! \param tolerance  maximum distance of a point outside the mesh, in units of the mesh
  //! \return cell -1 if the point is outside or not finite
  Location<Dim> locate(const Vector<Dim>& point, double tolerance) const;

 private:
  struct Grid;
  std::unique_ptr<Grid> grid_;
};

//! Locates points inside the cage.
//! \param mesh  valid
//! \param points  Dim x P, in the units of the mesh
//! \return P locations; a point within the tolerance outside the mesh is in the nearest cell
//! \throws InputError if a point is not finite, or if points lie outside the mesh by more than 1e-6
//! of its size, with the first such point and their number
template <int Dim>
std::vector<Location<Dim>> locate_points(const DomainMesh<Dim>& mesh, const PointList<Dim>& points);

//! Interpolates weights linearly in the cell of each located point. This preserves reproduction and
//! partition of unity exactly.
//! \param mesh  mesh of the weights, V vertices
//! \param weights  of V points
//! \param places  as returned by locate_points()
//! \return weights of the places
template <int Dim>
SparseWeights interpolate(const DomainMesh<Dim>& mesh, const SparseWeights& weights,
                          const std::vector<Location<Dim>>& places);

//! The same at one location: n weights.
template <int Dim>
Eigen::VectorXd interpolate(const DomainMesh<Dim>& mesh, const SparseWeights& weights,
                            const Location<Dim>& place);

}  // namespace flbc
