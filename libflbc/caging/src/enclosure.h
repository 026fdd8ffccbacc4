// SPDX-License-Identifier: BSD-3-Clause
// Whether facets meet a model, and whether a cage encloses all of it.
#pragma once

#include <vector>

#include "caging/cgal/exact_predicates.h"
#include "caging/overlap_tree.h"
#include "flbc/cage.h"

namespace flbc {

//! A model as a set of points, segments and triangles, for exact questions. A surface that meets
//! none of them has each connected part of the model on one side, so that one point of every part
//! decides the rest.
template <int Dim>
class Enclosure {
 public:
  using Box = Eigen::AlignedBox<double, Dim>;

  //! \param points  Dim x P \param facets  corners may repeat; points of no facet count as well
  Enclosure(const PointList<Dim>& points, const FacetList<Dim>& facets);

  //! Whether a facet has a point in common with the model.
  bool meets(const Simplex<Dim>& facet) const;

  //! Whether the cage meets the model nowhere and has all of it inside.
  bool is_strictly_inside(const Cage<Dim>& cage) const;

  //! One point of each connected part, in the order of the model's points.
  const PointList<Dim>& representatives() const { return representatives_; }

  const std::vector<Simplex<Dim>>& simplices() const { return simplices_; }
  const Box& box() const { return box_; }

  //! Distance from the model. \param limit  the answer where it is larger
  double distance(const Vector<Dim>& point, double limit) const;

 private:
  std::vector<Simplex<Dim>> simplices_;
  OverlapTree<Dim> tree_;
  PointList<Dim> representatives_;
  Box box_;
};

//! Whether a segment from the point to far away meets the facets an odd number of times. No if the
//! point lies on one of them.
//! \param directions_axis  the segment runs towards larger coordinates of this axis; any if -1
template <int Dim>
bool has_odd_crossings(const Vector<Dim>& point, const std::vector<Simplex<Dim>>& facets,
                       int directions_axis = -1);

}  // namespace flbc
