// SPDX-License-Identifier: BSD-3-Clause
// Finds the nearest of many segments or triangles to a point.
#pragma once

#include "cage/box_tree.h"
#include "flbc/types.h"
#include "polytope/nearest_point_in_hull.h"

namespace flbc {

//! Finds the place on simplices of K corners that is nearest to a point.
template <int Dim, int K>
class NearestSimplex {
 public:
  //! \param points  Dim x P \param corners  K x E; both are kept by reference
  NearestSimplex(const PointList<Dim>& points, const FacetList<K>& corners)
      : points_(points), corners_(corners), tree_(boxes_of<Dim, K>(points, corners)) {}

  //! \param place  its weights refer to the corners of the simplex
  //! \return the simplex; ties go to the smallest index
  Index operator()(const Vector<Dim>& point, HullPoint<Dim>& place) const {
    const Index simplex = tree_.nearest(
        point, [&](Index e) { return nearest_point_in_hull<Dim>(corners_of(e), point).distance; });
    place = nearest_point_in_hull<Dim>(corners_of(simplex), point);
    return simplex;
  }

 private:
  PointList<Dim> corners_of(Index simplex) const {
    return points_(Eigen::all, corners_.col(simplex));
  }

  const PointList<Dim>& points_;
  const FacetList<K>& corners_;
  BoxTree<Dim> tree_;
};

}  // namespace flbc
