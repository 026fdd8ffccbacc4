// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Geodesic distances in the domain, and the functions phi_i of problem (1) of the paper. phi_i
//! grows with the distance from control point i, so variation of w_i costs more far away. This
//! keeps w_i local.
#pragma once

#include <utility>
#include <vector>

#include "flbc/domain_mesh.h"
#include "flbc/types.h"

namespace flbc {

//! n x V: column v holds the distances of vertex v from n sources. Single precision, because this
//! is one of the largest arrays of a solve.
using DistanceMatrix = Eigen::MatrixXf;

//! Geodesic distances in the domain, by fast marching (Sethian 1996) over the cells (Kimmel and
//! Sethian 1998) from point sources. They are exact to single precision where the shortest path is
//! straight, and first-order accurate in cell size where it bends around the boundary. Time and
//! memory are proportional to the number of cells.
//! \param mesh  valid, V vertices
//! \param topology  of the mesh
//! \param sources  vertices of the mesh, one per control point
//! \return #sources x V, in the units of the mesh, >= 0
template <int Dim>
DistanceMatrix geodesic_distances(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& topology,
                                  const std::vector<Index>& sources);

//! Growth of phi_i with the relative distance d_i in [0, 1] from control point i.
enum class DistanceScheme {
  kSquare,      //!< d^2, the usual default
  kLinear,      //!< d
  kSquareRoot,  //!< sqrt(d)
  kConstant     //!< 1, plain total variation
};

//! phi_i on each cell of a mesh, n x F. If made from distances, it stores only the distances, which
//! need about a sixth of the memory.
class WeightFunctions {
 public:
  //! Empty.
  WeightFunctions() = default;

  //! Takes given values. \param values  n x F, >= 0 and finite
  WeightFunctions(Eigen::MatrixXd values) : values_(std::move(values)) {}

  //! Divides distances by the largest one over all control points, averages them over the vertices
  //! of each cell, and applies the scheme.
  //! \param scheme  growth with the distance
  //! \param distances  n x V in any unit, or empty for kConstant
  //! \param mesh  F cells, V vertices
  //! \param num_control_points  n
  template <int Dim>
  WeightFunctions(DistanceScheme scheme, DistanceMatrix distances, const DomainMesh<Dim>& mesh,
                  Index num_control_points);

  //! n, or 0 if empty.
  Eigen::Index rows() const { return is_given() ? values_.rows() : num_control_points_; }

  //! F, or 0 if empty.
  Eigen::Index cols() const { return is_given() ? values_.cols() : cells_.cols(); }

  //! n F.
  Eigen::Index size() const { return rows() * cols(); }

  //! Whether the values were given instead of made from distances.
  bool is_given() const { return values_.size() > 0; }

  //! The distances that phi was made from, n x V; empty for kConstant and for given values.
  const DistanceMatrix& distances() const { return distances_; }

  //! Divides phi_i by SolverOptions::reach, in place of the factors before.
  //! \param reach  n factors > 0; or empty
  void set_reach(std::vector<double> reach) { reach_ = std::move(reach); }

  //! These factors; empty if all are 1.
  const std::vector<double>& reach() const { return reach_; }

  //! Adds to phi_i the square of how near a cell is to the mask of control point i, times the
  //! largest value of phi without reach, in place of what was added before
  //! (SolverOptions::falloff).
  //! \param rows  of each control point in `nearness`, -1 for none; n, or empty for no falloff
  //! \param nearness  K x V, in [0, 1]; the mean counts in a cell \param mesh  V vertices, F cells
  template <int Dim>
  void set_falloff(std::vector<Index> rows, DistanceMatrix nearness, const DomainMesh<Dim>& mesh) {
    rows_ = std::move(rows);
    nearness_ = std::move(nearness);
    if (rows_.empty()) return;
    cells_ = mesh.cells;
    if (is_given()) largest_ = values_.maxCoeff();
  }

  //! phi_i on one cell, in [0, 1] if made from distances without reach and falloff.
  //! \param i  control point \param s  cell
  double operator()(Eigen::Index i, Eigen::Index s) const {
    double value = is_given() ? values_(i, s) : from_distances(i, s);
    if (!reach_.empty()) value /= reach_[i];
    return rows_.empty() || rows_[i] < 0 ? value : value + from_mask(rows_[i], s);
  }

  //! phi on one cell, one value per control point. \param s  cell
  Eigen::VectorXd col(Eigen::Index s) const;

  //! All values, n x F.
  Eigen::MatrixXd dense() const;

 private:
  double from_distances(Eigen::Index i, Eigen::Index s) const;
  double from_mask(Eigen::Index row, Eigen::Index s) const;

  Eigen::MatrixXd values_;                                      // n x F, if phi was given
  DistanceMatrix distances_;                                    // n x V, otherwise
  DistanceMatrix nearness_;                                     // K x V, for falloff
  std::vector<Index> rows_;                                     // of it, by control point
  Eigen::Matrix<Index, Eigen::Dynamic, Eigen::Dynamic> cells_;  // if one of these needs them
  DistanceScheme scheme_ = DistanceScheme::kConstant;
  double scale_ = 1;
  double largest_ = 1;  // value without reach and falloff
  Eigen::Index num_control_points_ = 0;
  std::vector<double> reach_;
};

}  // namespace flbc
