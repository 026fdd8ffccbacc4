// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Measures coordinates by their values alone, with independent loops that share no code with the
//! library.
#pragma once

#include <vector>

#include <gtest/gtest.h>

#include "flbc/cage.h"
#include "flbc/domain_mesh.h"
#include "flbc/quality.h"

namespace flbc::testing {

//! How far weights are from the paper's properties 1 to 5 and from having no local extrema. A
//! weight that is no number makes the measures it enters infinite.
template <int Dim>
struct Judgement {
  double partition_error = 0;     //!< max |sum_i w_i - 1|
  double reproduction_error = 0;  //!< max |sum_i w_i c_i - x| / diagonal of the cage's bounding box
  Vector<Dim> worst_reproduced = Vector<Dim>::Zero();  //!< the x where reproduction is worst
  double min_weight = 0;                               //!< smallest weight of all
  double lagrange_error = 0;   //!< max |w_i(c_j) - delta_ij| over mesh vertices at control points
  double linearity_error = 0;  //!< max deviation at boundary vertices from the barycentric
                               //!< coordinates in their cage facets
  Index control_points_found = 0;        //!< control points at which there is a mesh vertex
  Index boundary_vertices_off_cage = 0;  //!< boundary vertices that lie on no cage facet
  std::vector<Index> local_minima;  //!< per control point: interior vertices below all neighbors
  std::vector<Index> local_maxima;  //!< per control point: interior vertices above all neighbors
};

//! \param weights  n x V
//! \param extremum_margin  an extremum counts if it differs by more than this from every neighbor
//! \throws std::invalid_argument if the sizes do not fit
template <int Dim>
Judgement<Dim> judge(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                     const Eigen::MatrixXd& weights, double extremum_margin = 0);

//! Expects the properties 1, 2, 4, and 5 of the paper, and a mesh whose boundary is on the cage.
//! \param rounding  largest error of sums and of reproduced points
template <int Dim>
Judgement<Dim> expect_coordinates(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                                  const Eigen::MatrixXd& weights, double rounding = 1e-13) {
  const auto judgement = judge(cage, mesh, weights);
  EXPECT_LT(judgement.partition_error, rounding);
  EXPECT_LT(judgement.reproduction_error, rounding);
  EXPECT_EQ(judgement.lagrange_error, 0);
  EXPECT_LT(judgement.linearity_error, 1e-11);
  EXPECT_EQ(judgement.boundary_vertices_off_cage, 0);
  return judgement;
}

//! The weights that the Lagrange property and linearity demand at the mesh's boundary vertices, by
//! comparing every boundary vertex with every cage facet.
//! \return n x V; zero columns for interior vertices and those on no facet (farther than 1e-6 of
//! the cage's size from all)
template <int Dim>
Eigen::MatrixXd demanded_boundary_weights(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh);

//! sum_s sum_i A_s (phi_i^s |grad w_i|_s + smoothness / 2 |grad w_i|_s^2). \param phi  n x F
template <int Dim>
double objective(const DomainMesh<Dim>& mesh, const Eigen::MatrixXd& weights,
                 const Eigen::MatrixXd& phi, double smoothness = 0);

//! The paper's (5): mean of (a - b)^2 over interior vertices and control points.
//! \throws std::invalid_argument if there are no interior vertices
template <int Dim>
double mean_squared_difference(const DomainMesh<Dim>& mesh, const Eigen::MatrixXd& a,
                               const Eigen::MatrixXd& b);

}  // namespace flbc::testing
