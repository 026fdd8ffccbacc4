// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Basic types of the library. Points are columns.
//! Eigen matrices cross the library interface, and Eigen allocates them differently depending on
//! the instruction set and on AddressSanitizer. Use such flags (-march=native) for a program only
//! if the library was compiled with them.
#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace flbc {

//! Index of a vertex, facet, cell or control point.
using Index = std::int32_t;

//! A point or vector in R^Dim.
template <int Dim>
using Vector = Eigen::Matrix<double, Dim, 1>;

//! Dim x #points, one point per column.
template <int Dim>
using PointList = Eigen::Matrix<double, Dim, Eigen::Dynamic>;

//! Dim x #facets, each column has the vertices of an edge (2D) or triangle (3D).
template <int Dim>
using FacetList = Eigen::Matrix<Index, Dim, Eigen::Dynamic>;

//! (Dim + 1) x #cells, each column has the vertices of a triangle (2D) or tetrahedron (3D).
template <int Dim>
using CellList = Eigen::Matrix<Index, Dim + 1, Eigen::Dynamic>;

//! n x #points: column v holds the n coordinates of point v, one per control point, contiguous.
//! With the control points C as columns, reproduction reads C W = X.
using WeightMatrix = Eigen::MatrixXd;

}  // namespace flbc
