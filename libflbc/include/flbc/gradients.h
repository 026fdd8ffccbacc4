// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Gradients of weights, and the Jacobians of a deformation, which rotate and stretch what moves:
//! normals, tangents, covariances.
//!
//! Gradients of n weights at P points are stored as weights of Dim n control points are. Number
//! Dim i + d of a point is the derivative of w_i in direction d, in 1 / units of the
//! mesh. The derivatives in a direction sum to 0 over all control points.
#pragma once

#include <vector>

#include "flbc/placement.h"

namespace flbc {

//! The means over the cells around each vertex, weighted by area or volume. They are exact where
//! the weights are affine.
//! \param mesh  V vertices
//! \param weights  of V points
//! \return Dim n numbers per vertex
template <int Dim>
SparseWeights vertex_gradients(const DomainMesh<Dim>& mesh, const SparseWeights& weights);

//! Smooth gradients at located points: those of the vertices, interpolated linearly in each cell.
//! \param mesh  V vertices
//! \param weights  of V points
//! \param places  P locations, as returned by locate_points() or places_in_mesh(); gradients are
//! 0 where the cell is -1
//! \return Dim n numbers per location
template <int Dim>
SparseWeights gradients_at(const DomainMesh<Dim>& mesh, const SparseWeights& weights,
                           const std::vector<Location<Dim>>& places);

//! A location in a cell for every placed point that moves. Points outside the mesh get the location
//! of the nearest point of the cage, except for OutsidePoints::kKeep: cell -1.
//! \param cage, mesh  as for place_points()
//! \param placement  as returned by place_points(), P points
//! \return P locations
//! \throws InputError if the boundary of the mesh is not the cage
template <int Dim>
std::vector<Location<Dim>> places_in_mesh(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                                          const Placement<Dim>& placement);

//! Jacobians J = sum_i c_i (grad w_i)^T of a deformation. An affine pose c_i = A v_i + b of the
//! rest cage v_i gives J = A. A point without gradients does not move, so its J is the identity.
//! \param gradients  of P points
//! \param control_points  Dim x n, the pose
//! \return (Dim Dim) x P: each column has J column by column, in units of the pose / units of the
//! mesh
//! \throws InputError if the numbers of control points differ
template <int Dim>
Eigen::MatrixXd jacobians(const SparseWeights& gradients, const PointList<Dim>& control_points);

//! Smooth Jacobians at fixed points for many poses. They cost little per pose: they are made at the
//! vertices of the mesh and interpolated.
template <int Dim>
class PointJacobians {
 public:
  //! \param cage, mesh  as for place_points() \param weights  of V points \param placement  P points
  //! \throws InputError as places_in_mesh() and vertex_gradients()
  PointJacobians(const Cage<Dim>& cage, DomainMesh<Dim> mesh, const SparseWeights& weights,
                 const Placement<Dim>& placement);

  //! \param control_points  Dim x n, the pose \return as jacobians()
  Eigen::MatrixXd at(const PointList<Dim>& control_points) const;

 private:
  DomainMesh<Dim> mesh_;
  SparseWeights gradients_;  // at its vertices
  std::vector<Location<Dim>> places_;
};

}  // namespace flbc
