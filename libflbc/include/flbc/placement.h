// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Weights at any point: inside the cage, within a tolerance of it, or outside.
#pragma once

#include <vector>

#include "flbc/cage.h"
#include "flbc/cell_locator.h"
#include "flbc/domain_mesh.h"
#include "flbc/sparse_weights.h"

namespace flbc {

//! Treatment of points outside the cage. The policy chooses the weights w of a point x. Control
//! points that move from c to c' move it to x + sum_i w_i (c'_i - c_i), so that nothing moves at
//! rest. Inside, this is sum_i w_i c'_i, because the weights reproduce x.
enum class OutsidePoints {
  kFail,     //!< throws InputError with their number, the farthest one, and its distance
  kNearest,  //!< the weights of the nearest point of the cage: non-negative, sum 1. The point
             //!< follows that point at a constant offset
  kKeep,     //!< no weights: the point stays where it is
  kExtend    //!< as kNearest, plus an affine function of the offset from the nearest point. The
             //!< offset follows the affine map that best fits the nearby control points. The sum is
             //!< 1 and the point is reproduced; weights may be negative. Continuous across the
             //!< cage.
};

//! The policy for points that may be outside by rounding.
//! \return OutsidePoints::kNearest instead of kFail, any other policy as it is
constexpr OutsidePoints without_failure(OutsidePoints policy) {
  return policy == OutsidePoints::kFail ? OutsidePoints::kNearest : policy;
}

//! A point outside the cage and the nearest point of the cage.
template <int Dim>
struct NearestOnCage {
  Index point = -1;
  Index facet = -1;
  Vector<Dim> coordinates = Vector<Dim>::Zero();  //!< barycentric in the facet: >= 0, sum 1
  Vector<Dim> offset = Vector<Dim>::Zero();       //!< from the nearest point of the cage

  double distance() const { return offset.norm(); }
};

//! Locations of points relative to a cage.
template <int Dim>
struct Placement {
  OutsidePoints policy = OutsidePoints::kFail;
  PointList<Dim> points;              //!< Dim x P, as reproduced by the weights, if there are any
  std::vector<Location<Dim>> places;  //!< P locations, coordinates >= 0; cell -1: not inside
  //! Points outside by at most kBoundaryTolerance, which were moved onto the cage; ascending.
  std::vector<NearestOnCage<Dim>> on_cage;
  std::vector<NearestOnCage<Dim>> outside;  //!< points farther outside; ascending
};

//! Locates points relative to a cage.
//! \param cage  n control points, has passed validate()
//! \param mesh  valid domain mesh of the cage
//! \param points  Dim x P, finite, in the units of the cage
//! \param policy  how to handle points outside by more than kBoundaryTolerance
//! \throws InputError if there are such points and the policy is OutsidePoints::kFail
template <int Dim>
Placement<Dim> place_points(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                            const PointList<Dim>& points,
                            OutsidePoints policy = OutsidePoints::kFail);

//! The same with a locator that serves many calls.
//! \param locator  of the mesh
template <int Dim>
Placement<Dim> place_points(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                            const CellLocator<Dim>& locator, const PointList<Dim>& points,
                            OutsidePoints policy = OutsidePoints::kFail);

//! The same without a mesh, for coordinates that need none (pointwise.h): all places have cell -1.
//! Time is proportional to the number of points times the number of facets.
template <int Dim>
Placement<Dim> place_points(const Cage<Dim>& cage, const PointList<Dim>& points,
                            OutsidePoints policy = OutsidePoints::kFail);

//! The policy where the caller wants none. Points without an edge belong to no face, so nobody sees
//! them: they follow the nearest point of the cage.
//! \param cage  has passed validate() \param points  Dim x P, finite \param edges  of the model
//! \return OutsidePoints::kNearest if points are outside by more than kBoundaryTolerance and none of
//! them has an edge, otherwise kFail, also for a model without edges
template <int Dim>
OutsidePoints usual_policy(const Cage<Dim>& cage, const PointList<Dim>& points,
                           const EdgeList& edges);

//! Finds the nearest points of a cage.
//! \param cage  has passed validate()
//! \param points  Dim x P, finite, in the units of the cage
//! \param which  indices of the points to use, in [0, P)
//! \return one result per entry of `which`
template <int Dim>
std::vector<NearestOnCage<Dim>> nearest_on_cage(const Cage<Dim>& cage, const PointList<Dim>& points,
                                                const std::vector<Index>& which);

//! The points that weights should reproduce: the nearest point of the cage, or a mean of several
//! equally near ones, for a point outside that has the weights of OutsidePoints::kNearest, else the
//! point itself.
//! \param cage  its facets may be missing; then all points are unchanged
//! \param points  Dim x P, finite, in the units of the cage
//! \param weights  of P points
//! \return Dim x P
template <int Dim>
PointList<Dim> attached_points(const Cage<Dim>& cage, const PointList<Dim>& points,
                               const SparseWeights& weights);

//! Weights at placed points: linear in cells and facets; outside, by the policy. They are
//! non-negative if the given weights are, except for OutsidePoints::kExtend.
//! \param cage, mesh  as for place_points()
//! \param weights  of the V vertices of the mesh
//! \param placement  as returned by place_points()
//! \return weights of P points
template <int Dim>
SparseWeights weights_at(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                         const SparseWeights& weights, const Placement<Dim>& placement);

//! The same from weights of the inner points themselves.
//! \param inside  weights of P points; those of points in `on_cage` or `outside` are not used
//! \param placement  with or without a mesh
//! \return weights of P points
template <int Dim>
SparseWeights weights_at(const Cage<Dim>& cage, const SparseWeights& inside,
                         const Placement<Dim>& placement);

}  // namespace flbc
