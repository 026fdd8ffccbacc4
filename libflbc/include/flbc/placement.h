// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Weights at any points: inside the cage, within tolerance of it, or outside.
#pragma once

#include <vector>

#include "flbc/cage.h"
#include "flbc/cell_locator.h"
#include "flbc/domain_mesh.h"
#include "flbc/sparse_weights.h"

namespace flbc {

//! Treatment of points outside the cage.
enum class OutsidePoints {
  kFail,     //!< an InputError reports their number, the farthest one and its distance
  kNearest,  //!< the weights of the nearest point of the cage: >= 0, with sum 1; they reproduce
             //!< that point
  kExtend    //!< those plus an affine function of the offset from it: the offset follows the affine
             //!< map that fits the control points around best. The sum is 1 and the point is
             //!< reproduced; weights may be negative. Continuous across the cage.
};

//! A point outside the cage and the nearest point of the cage.
template <int Dim>
struct PointBeside {
  Index point = -1;
  Index facet = -1;
  Vector<Dim> coordinates = Vector<Dim>::Zero();  //!< barycentric in the facet: >= 0, sum 1
  double distance = 0;
};

//! Where points are.
template <int Dim>
struct Placement {
  OutsidePoints policy = OutsidePoints::kFail;
  PointList<Dim> points;              //!< Dim x P, where the weights put them
  std::vector<Location<Dim>> places;  //!< of P points, coordinates >= 0; cell -1: not inside
  //! Outside by at most kBoundaryTolerance, and moved onto the cage; ascending.
  std::vector<PointBeside<Dim>> on_cage;
  std::vector<PointBeside<Dim>> outside;  //!< by more; ascending
};

//! Finds points with respect to a cage.
//! \param cage  n control points, has passed validate()
//! \param mesh  valid, of the cage's interior
//! \param points  Dim x P, finite, in the units of the cage
//! \param policy  how to handle points outside by more than kBoundaryTolerance
//! \throws InputError if there are such and the policy is OutsidePoints::kFail
template <int Dim>
Placement<Dim> place_points(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                            const PointList<Dim>& points,
                            OutsidePoints policy = OutsidePoints::kFail);

//! The nearest points of a cage.
//! \param cage  has passed validate()
//! \param points  Dim x P, finite, in the units of the cage
//! \param which  of them, in [0, P)
//! \return one for each of `which`
template <int Dim>
std::vector<PointBeside<Dim>> nearest_on_cage(const Cage<Dim>& cage, const PointList<Dim>& points,
                                              const std::vector<Index>& which);

//! Weights at placed points: linear in the cells and facets, and outside by the policy. Not
//! negative where the mesh's are not, except for OutsidePoints::kExtend.
//! \param cage, mesh  as for place_points()
//! \param weights  n x V, of the mesh's vertices
//! \param placement  as place_points() gives it
//! \tparam Weights  WeightMatrix or SparseWeights
//! \return n x P
template <int Dim, class Weights>
Weights weights_at(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh, const Weights& weights,
                   const Placement<Dim>& placement);

}  // namespace flbc
