// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Types of the whole library: points are columns.
//! Eigen's matrices cross the interface, and how Eigen allocates them depends on the instruction
//! set and on AddressSanitizer: give a program such flags (-march=native) only if the library was
//! compiled with them too.
#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace flbc {

//! Index of a vertex, facet, cell or control point.
using Index = std::int32_t;

//! A point or vector in R^Dim.
template <int Dim>
using Vector = Eigen::Matrix<double, Dim, 1>;

//! Dim x #points, a point per column.
template <int Dim>
using PointList = Eigen::Matrix<double, Dim, Eigen::Dynamic>;

//! Dim x #facets, the vertices of an edge (2D) or triangle (3D) per column.
template <int Dim>
using FacetList = Eigen::Matrix<Index, Dim, Eigen::Dynamic>;

//! (Dim + 1) x #cells, the vertices of a triangle (2D) or tetrahedron (3D) per column.
template <int Dim>
using CellList = Eigen::Matrix<Index, Dim + 1, Eigen::Dynamic>;

//! n x #points: column v holds the n coordinates of point v, one per control point, contiguous.
//! With the control points C as columns, reproduction reads C W = X.
using WeightMatrix = Eigen::MatrixXd;

//! How Method::kValue and kLbc2014 solve the linear system of each iteration, and Method::kGradient
//! those of its start and its recovery.
enum class LinearSolver {
  kAuto,       //!< by what is faster: kMultigrid for kValue and kGradient on large meshes, else
               //!< kDirect
  kDirect,     //!< one factorisation, exact solves
  kMultigrid,  //!< time and memory grow as the mesh: a cycle of algebraic multigrid per iteration;
               //!< for kGradient conjugate gradients with such cycles
  kNone  //!< kGradient and kPaper only: no global system. The start is the least-norm solution
         //!< of the local constraints, the recovery breadth-first, as in the paper
};

}  // namespace flbc
