// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Basic types of the library. Points are columns.
#pragma once

#if __cplusplus < 201703L && (!defined(_MSVC_LANG) || _MSVC_LANG < 201703L)
#error flbc needs C++17
#endif

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

#if defined(__GNUC__) && !defined(FLBC_ISA)
namespace abi {

//! Eigen matrices cross the library interface, and Eigen allocates them differently depending on
//! the instruction set (-march) and on AddressSanitizer. If the linker does not find this for a
//! program, compile it with -DEIGEN_MAX_ALIGN_BYTES=16 -DEIGEN_MALLOC_ALREADY_ALIGNED=1, or with
//! the flags of the library.
template <int max_align_bytes, bool malloc_already_aligned>
struct EigenAlignment {
  static const char is_not_that_of_libflbc;
};

extern template struct EigenAlignment<EIGEN_MAX_ALIGN_BYTES, EIGEN_MALLOC_ALREADY_ALIGNED != 0>;

[[gnu::used]] static const char* const kEigenAlignment =
    &EigenAlignment<EIGEN_MAX_ALIGN_BYTES,
                    EIGEN_MALLOC_ALREADY_ALIGNED != 0>::is_not_that_of_libflbc;

}  // namespace abi
#endif

}  // namespace flbc
