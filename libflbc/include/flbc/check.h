// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Whether cages, models and weights are what they must be, and where they are not.
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

//! The largest or smallest value of something and where it is.
template <int Dim>
struct Extreme {
  double value = 0;                         //!< largest or smallest
  Index point = -1;                         //!< -1 if there is nothing to measure
  Index control_point = -1;                 //!< -1 if all control points together give the value
  Vector<Dim> place = Vector<Dim>::Zero();  //!< coordinates of the point
};

//! Measures that need the mesh of the cage's interior: local extrema, variation and locality.
template <int Dim>
struct MeshCheck {
  Index interior_vertices = 0;  //!< number of vertices off the boundary
  //! Per control point, the interior vertices at which w_i is below, or above, its values at all
  //! neighbours by more than 1e-6. By the paper's Conjecture 1 local barycentric coordinates
  //! have none.
  std::vector<Index> local_minima;
  std::vector<Index> local_maxima;  //!< likewise
  Extreme<Dim> deepest_minimum;     //!< the value is the distance from the neighbours
  Extreme<Dim> highest_maximum;     //!< likewise
  double total_variation = 0;       //!< sum_s sum_i A_s |grad w_i|, in units of the mesh^(Dim - 1)
  double harmonic_total_variation = 0;  //!< that of harmonic coordinates on this mesh
  double harmonic_mean_influences = 0;  //!< mean number of their |w_i| > 1e-4 per vertex
  double influence_ratio = 0;           //!< mean influences / those of harmonic coordinates
};

//! Measures of weights. Points with a weight that is not finite count in `non_finite` only.
template <int Dim>
struct WeightCheck {
  Quality quality{};         //!< as measure_quality() gives it
  Index points = 0;          //!< P
  Index control_points = 0;  //!< n

  std::int64_t non_finite = 0;    //!< number of weights that are not finite
  Extreme<Dim> first_non_finite;  //!< the first of them
  std::int64_t negative = 0;      //!< number of weights below -1e-12, which is more than rounding
  Extreme<Dim> min_weight;        //!< smallest weight
  Extreme<Dim> max_weight;        //!< largest weight
  Extreme<Dim> partition;         //!< largest |sum_i w_i - 1|
  Extreme<Dim> reproduction;      //!< largest |sum_i w_i c_i - x| / size of the cage
  Extreme<Dim> influences;        //!< largest number of |w_i| > 1e-4

  Index control_points_found = 0;  //!< control points with which a point coincides
  Extreme<Dim> lagrange;           //!< largest |w_i(c_j) - delta_ij| at those
  Index points_on_cage = 0;        //!< the ones at control points included
  Extreme<Dim>
      linearity;  //!< largest deviation there from the barycentric coordinates in the facet

  std::optional<MeshCheck<Dim>> mesh;  //!< if they are weights at the vertices of a mesh
};

//! Measures weights at any points. Those that lie on the cage, or coincide with a control point, up
//! to 1e-10 of the cage's size are found by geometry.
//! \param cage  has passed validate()
//! \param points  Dim x P, in the units of the cage
//! \param weights  n x P
//! \throws InputError if the sizes do not belong together
template <int Dim>
WeightCheck<Dim> check_weights(const Cage<Dim>& cage, const PointList<Dim>& points,
                               const WeightMatrix& weights);

//! Measures weights at the vertices of a mesh of the cage's interior; the boundary of the mesh is
//! on the cage.
//! \param cage  has passed validate()
//! \param domain  mesh of the cage's interior, valid
//! \param weights  n x V
//! \throws InputError if sizes do not belong together or the mesh does not fill the interior of the cage
//!     (see boundary_values), SolverError if the harmonic coordinates for comparison fail
template <int Dim>
WeightCheck<Dim> check_weights(const Cage<Dim>& cage, const DomainMesh<Dim>& domain,
                               const WeightMatrix& weights);

//! Errors above this are violations of what coordinates must satisfy.
constexpr double kCheckTolerance = 1e-6;

//! Properties of all coordinates of a cage that the weights lack: being finite, partition of unity,
//! reproduction, Lagrange property and linearity on facets. Negative weights are no violation.
//! \param check  as check_weights() gives it
//! \return a sentence each, with place and value; empty if there are none
template <int Dim>
std::vector<std::string> find_violations(const WeightCheck<Dim>& check);

}  // namespace flbc
