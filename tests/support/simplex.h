// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Elementary geometry for the test support, written without the library's code on purpose.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "flbc/domain_mesh.h"
#include "support/dense_algebra.h"

namespace flbc::testing {

//! Columns of `points` at the given vertices, in this order.
template <int Dim, class Vertices>
PointList<Dim> corners_of(const PointList<Dim>& points, const Vertices& vertices) {
  PointList<Dim> corners(Dim, static_cast<Eigen::Index>(vertices.size()));
  for (Eigen::Index k = 0; k < corners.cols(); ++k) corners.col(k) = points.col(vertices[k]);
  return corners;
}

//! Corners of a cell.
template <int Dim>
PointList<Dim> cell_corners(const DomainMesh<Dim>& mesh, Index cell) {
  return corners_of<Dim>(mesh.points, mesh.cells.col(cell));
}

//! The vectors from the first corner to the others, Dim x (#corners - 1).
template <int Dim>
PointList<Dim> edges_of(const PointList<Dim>& corners) {
  return corners.rightCols(corners.cols() - 1).colwise() - Vector<Dim>(corners.col(0));
}

//! Length, area or volume of the simplex with these corners, from the Gram determinant.
template <int Dim>
double simplex_measure(const PointList<Dim>& corners) {
  const Eigen::MatrixXd edges = edges_of<Dim>(corners);
  const Eigen::MatrixXd gram = edges.transpose() * edges;
  return std::sqrt(std::max(0.0, determinant(gram))) / std::tgamma(double(corners.cols()));
}

//! Signed area or volume of a simplex of full dimension.
template <int Dim>
double signed_simplex_measure(const PointList<Dim>& corners) {
  const Eigen::MatrixXd edges = edges_of<Dim>(corners);
  return determinant(edges) / std::tgamma(Dim + 1.0);
}

//! Barycentric coordinates of points in a simplex of full dimension, a column per point.
template <int Dim>
Eigen::MatrixXd barycentric_coordinates(const PointList<Dim>& corners,
                                        const PointList<Dim>& points) {
  Eigen::MatrixXd system(Dim + 1, Dim + 1), right(Dim + 1, points.cols());
  system << corners, Eigen::RowVectorXd::Ones(Dim + 1);
  right << points, Eigen::RowVectorXd::Ones(points.cols());
  return solve_square(system, right);
}

//! Gradients of linear functions on a simplex of any dimension, tangential to it (least norm).
//! \param values  n x #corners, a function per row \return Dim x n
template <int Dim>
PointList<Dim> linear_gradients(const PointList<Dim>& corners, const Eigen::MatrixXd& values) {
  const Eigen::MatrixXd edges = edges_of<Dim>(corners);
  const Eigen::MatrixXd rises =
      values.rightCols(values.cols() - 1).colwise() - Eigen::VectorXd(values.col(0));
  return least_squares(edges.transpose(), rises.transpose());
}

//! Columns of an n x V matrix at the given vertices, n x #vertices.
template <class Vertices>
Eigen::MatrixXd columns_of(const Eigen::MatrixXd& matrix, const Vertices& vertices) {
  Eigen::MatrixXd columns(matrix.rows(), static_cast<Eigen::Index>(vertices.size()));
  for (Eigen::Index k = 0; k < columns.cols(); ++k) columns.col(k) = matrix.col(vertices[k]);
  return columns;
}

//! A facet, known by its vertices in ascending order.
template <int Dim>
using FacetKey = std::array<Index, Dim>;

//! Each facet of the mesh with its cells: two, or one on the boundary.
template <int Dim>
std::map<FacetKey<Dim>, std::vector<Index>> cells_by_facet(const DomainMesh<Dim>& mesh) {
  std::map<FacetKey<Dim>, std::vector<Index>> result;
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    for (int opposite = 0; opposite <= Dim; ++opposite) {
      FacetKey<Dim> key{};
      for (int k = 0, slot = 0; k <= Dim; ++k) {
        if (k != opposite) key[slot++] = mesh.cells(k, s);
      }
      std::sort(key.begin(), key.end());
      result[key].push_back(s);
    }
  }
  return result;
}

//! For each vertex, true if no boundary facet contains it.
template <int Dim>
std::vector<bool> interior_vertices(const DomainMesh<Dim>& mesh) {
  std::vector<bool> interior(mesh.num_vertices(), true);
  for (const auto& [facet, cells] : cells_by_facet(mesh)) {
    if (cells.size() > 1) continue;
    for (const Index v : facet) interior[v] = false;
  }
  return interior;
}

}  // namespace flbc::testing
