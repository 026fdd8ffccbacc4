// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Distances inside the domain, and the weight functions phi_i of the problem (1) of the paper.
//! They make variation of w_i cost more the farther it is from its control point, which keeps w_i
//! local.
#pragma once

#include <utility>
#include <vector>

#include "flbc/domain_mesh.h"
#include "flbc/types.h"

namespace flbc {

//! n x V: column v holds the distances of point v from n sources, in single precision, as they are
//! computed: they take as much memory as anything in a solve.
using DistanceMatrix = Eigen::MatrixXf;

//! Geodesic distances inside the domain, by fast marching (Sethian 1996) over the cells (Kimmel and
//! Sethian 1998), which see the source as a point: exact to single precision where the way is
//! straight, of first order in the size of the cells where it bends round the boundary. Time and
//! memory grow with the mesh as its number of cells.
//! \param mesh  valid, V vertices
//! \param topology  of the mesh
//! \param sources  vertices of the mesh, one per control point
//! \return #sources x V, in the units of the mesh, >= 0
template <int Dim>
DistanceMatrix geodesic_distances(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& topology,
                                  const std::vector<Index>& sources);

//! How phi_i grows with the relative distance d_i in [0, 1] from its control point.
enum class DistanceScheme {
  kSquare,      //!< d^2, the usual default
  kLinear,      //!< d
  kSquareRoot,  //!< sqrt(d)
  kConstant     //!< 1, plain total variation
};

//! phi_i on each cell of a mesh, n x F. Made from distances it keeps these, which are a number per
//! vertex instead of some six.
class WeightFunctions {
 public:
  //! None.
  WeightFunctions() = default;

  //! Given one by one. \param values  n x F, >= 0 and finite
  WeightFunctions(Eigen::MatrixXd values) : values_(std::move(values)) {}

  //! Divides by the largest distance over all control points, averages over each cell's vertices
  //! and applies the scheme.
  //! \param scheme  growth with the distance
  //! \param distances  n x V in any unit, or empty for kConstant
  //! \param mesh  F cells, V vertices
  //! \param num_control_points  n
  template <int Dim>
  WeightFunctions(DistanceScheme scheme, DistanceMatrix distances, const DomainMesh<Dim>& mesh,
                  Index num_control_points);

  //! n, 0 if there are none.
  Eigen::Index rows() const { return cells_.cols() > 0 ? num_control_points_ : values_.rows(); }

  //! F, 0 if there are none.
  Eigen::Index cols() const { return cells_.cols() > 0 ? cells_.cols() : values_.cols(); }

  //! n F.
  Eigen::Index size() const { return rows() * cols(); }

  //! Those it was made of, n x V; empty for kConstant, and if phi was given one by one.
  const DistanceMatrix& distances() const { return distances_; }

  //! phi_i on one cell, in [0, 1] if made from distances. \param i  control point \param s  cell
  double operator()(Eigen::Index i, Eigen::Index s) const {
    return cells_.cols() > 0 ? from_distances(i, s) : values_(i, s);
  }

  //! Of all control points on one cell, n numbers. \param s  cell
  Eigen::VectorXd col(Eigen::Index s) const;

  //! All of them, n x F.
  Eigen::MatrixXd dense() const;

 private:
  double from_distances(Eigen::Index i, Eigen::Index s) const;

  Eigen::MatrixXd values_;                                      // n x F, if given
  DistanceMatrix distances_;                                    // n x V, else
  Eigen::Matrix<Index, Eigen::Dynamic, Eigen::Dynamic> cells_;  // empty if given
  DistanceScheme scheme_ = DistanceScheme::kConstant;
  double scale_ = 1;
  Eigen::Index num_control_points_ = 0;
};

}  // namespace flbc
