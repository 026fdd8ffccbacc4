// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! What can be done with coordinates on a mesh: measure them and evaluate them anywhere inside.
#pragma once

#include <memory>
#include <vector>

#include "flbc/cage.h"
#include "flbc/domain_mesh.h"
#include "flbc/report.h"

namespace flbc {

//! Measures weights from nothing but points and control points.
//! \param points  Dim x P \param weights  n x P
//! \throws InputError if the sizes do not belong together
template <int Dim>
Quality measure_quality(const PointList<Dim>& control_points, const PointList<Dim>& points,
                        const WeightMatrix& weights);

//! The paper's objective (7), sum_s sum_i phi_s^i A_s |grad w_i|_s, of weights n x V.
template <int Dim>
double objective(const DomainMesh<Dim>& mesh, const Eigen::MatrixXd& phi,
                 const WeightMatrix& weights);

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
  //! Builds the grid. \param mesh  valid (normalize_and_validate), outlives the locator
  explicit CellLocator(const DomainMesh<Dim>& mesh);
  ~CellLocator();

  //! The cell that contains the point or, if none does, the nearest one by its barycentric
  //! coordinates among those whose bounding box holds the point.
  //! \param tolerance  how far outside, in units of the mesh, a point may lie
  //! \return cell -1 if the point is outside
  Location<Dim> locate(const Vector<Dim>& point, double tolerance) const;

 private:
  struct Grid;
  const DomainMesh<Dim>& mesh_;
  std::unique_ptr<Grid> grid_;
};

//! Locates points inside the cage. \param points  Dim x P
//! \throws InputError naming the first point that lies outside the mesh by more than 1e-6 of its
//! size, and how many do
template <int Dim>
std::vector<Location<Dim>> locate_points(const DomainMesh<Dim>& mesh, const PointList<Dim>& points);

//! Weights at located points, by linear interpolation in the containing cell. Reproduction and
//! partition of unity carry over exactly.
//! \param weights  n x V
//! \return n x #places
template <int Dim>
WeightMatrix interpolate(const DomainMesh<Dim>& mesh, const WeightMatrix& weights,
                         const std::vector<Location<Dim>>& places);

}  // namespace flbc
