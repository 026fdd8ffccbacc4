// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Measures weights and finds violations of what coordinates must satisfy.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "flbc/cage.h"
#include "flbc/domain_mesh.h"
#include "flbc/quality.h"
#include "flbc/types.h"

namespace flbc {

//! An extreme value of a measure, and its location.
template <int Dim>
struct Extreme {
  double value = 0;                         //!< largest or smallest
  Index point = -1;                         //!< -1: nothing to measure
  Index control_point = -1;                 //!< -1: the value depends on all control points
  Vector<Dim> place = Vector<Dim>::Zero();  //!< coordinates of the point
};

//! Measures that need the domain mesh: local extrema, variation, and locality.
template <int Dim>
struct MeshCheck {
  Index interior_vertices = 0;  //!< number of vertices off the boundary
  //! Per control point: number of interior vertices where w_i is lower by more than 1e-6 than at
  //! all neighbors. Local barycentric coordinates have no local extrema (Conjecture 1 of the
  //! paper).
  std::vector<Index> local_minima;
  std::vector<Index> local_maxima;  //!< as for minima
  Extreme<Dim> deepest_minimum;     //!< the value is the difference from the nearest neighbor
  Extreme<Dim> highest_maximum;     //!< as for minima
  double total_variation = 0;       //!< sum_s sum_i A_s |grad w_i|, in units of the mesh^(Dim - 1)
  double harmonic_total_variation = 0;  //!< of harmonic coordinates on this mesh
  //! What local coordinates minimize, sum_s sum_i phi_s^i A_s |grad w_i|, with phi = kSquare. 0
  //! for meshes of several parts, because each part has its own phi.
  double weighted_variation = 0;
  double harmonic_weighted_variation = 0;  //!< of harmonic coordinates on this mesh
  double gradient_jump = 0;                //!< see gradient_jump() in quality.h
  double harmonic_gradient_jump = 0;       //!< of harmonic coordinates on this mesh
  double harmonic_mean_influences = 0;     //!< mean influences per vertex of harmonic coordinates
  double influence_ratio = 0;              //!< mean influences / those of harmonic coordinates
};

//! Measures of weights at points. Points with a non-finite weight count in `non_finite` only.
template <int Dim>
struct PointCheck {
  Quality quality{};         //!< as returned by measure_quality()
  Index points = 0;          //!< P
  Index control_points = 0;  //!< n

  Index without_weights = 0;      //!< number of points without weights, which do not move
  std::int64_t non_finite = 0;    //!< number of non-finite weights
  Extreme<Dim> first_non_finite;  //!< the first of them
  std::int64_t negative = 0;      //!< number of weights below -1e-12
  Extreme<Dim> min_weight;        //!< smallest weight
  Extreme<Dim> max_weight;        //!< largest weight
  Extreme<Dim> partition;         //!< largest |sum_i w_i - 1|
  Extreme<Dim> reproduction;      //!< largest |sum_i w_i c_i - x| / cage size
  Extreme<Dim> influences;        //!< largest number of |w_i| > 1e-4

  Index control_points_found = 0;  //!< control points that coincide with a point
  Extreme<Dim> lagrange;           //!< largest |w_i(c_j) - delta_ij| at those
  Index points_on_cage = 0;        //!< including those at control points
  Extreme<Dim>
      linearity;  //!< largest deviation there from the barycentric coordinates in the facet
};

//! Measures of weights.
template <int Dim>
struct WeightCheck : PointCheck<Dim> {
  std::optional<MeshCheck<Dim>> mesh{};  //!< only for weights at the vertices of a mesh
};

//! Measures weights at any points. Points without weights are only counted. Points outside that
//! have the weights of the nearest point of the cage are measured there (attached_points()). A
//! point within 1e-10 of cage size from the cage or from a control point counts as on it.
//! \param cage  has passed validate()
//! \param points  Dim x P, in the units of the cage
//! \param weights  of P points
//! \throws InputError if the sizes do not match
template <int Dim>
WeightCheck<Dim> check_weights(const Cage<Dim>& cage, const PointList<Dim>& points,
                               const SparseWeights& weights);

//! Measures weights at the vertices of a domain mesh, whose boundary lies on the cage.
//! \param cage  has passed validate()
//! \param domain  valid domain mesh of the cage
//! \param weights  of V points
//! \throws InputError if sizes do not match or the mesh does not fill the cage (see
//! boundary_values); SolverError if the harmonic coordinates for comparison fail
template <int Dim>
WeightCheck<Dim> check_weights(const Cage<Dim>& cage, const DomainMesh<Dim>& domain,
                               const SparseWeights& weights);

//! How far away the nearest control points that can carry a point are: the least radius within
//! which control points have it in their convex hull, relative to cage size. Nearer ones alone have
//! no weights >= 0 that reproduce it. It is large where a cage has too few control points.
template <int Dim>
struct LeastReach {
  Extreme<Dim> maximum{};  //!< with the farthest of these control points
  double median = 0;       //!< over the points
};

//! Measures points, except for those outside the convex hull of all control points.
//! \param points  Dim x P, in the units of the cage
template <int Dim>
LeastReach<Dim> least_reach(const Cage<Dim>& cage, const PointList<Dim>& points);

//! Local extrema up to this depth are within the accuracy of a solve.
constexpr double kSolverAccuracy = 2e-3;

//! A property that fails by more than this is a violation.
constexpr double kCheckTolerance = 1e-6;

//! Lists the properties that the weights violate. All coordinates must be finite and satisfy
//! partition of unity, reproduction, the Lagrange property, and linearity on facets. Negative
//! weights are not a violation.
//! \param check  as returned by check_weights()
//! \return one sentence per violation, with location and value; empty if there are none
template <int Dim>
std::vector<std::string> find_violations(const WeightCheck<Dim>& check);

}  // namespace flbc
