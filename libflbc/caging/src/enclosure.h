// SPDX-License-Identifier: BSD-3-Clause
// Tests whether facets intersect a model, and whether a cage encloses it.
#pragma once

#include <limits>
#include <vector>

#include "cage/box_tree.h"
#include "flbc/cage.h"
#include "flbc/types.h"
#include "meshing/cgal/exact_predicates.h"

namespace flbc {

//! A model as a set of points, segments, and triangles, for exact tests. If a surface does not
//! intersect them, each connected part of the model is on one side, so one point per part decides.
template <int Dim>
class Enclosure {
 public:
  using Box = Eigen::AlignedBox<double, Dim>;

  //! \param points  Dim x P \param facets  corners may repeat; points without a facet also count
  Enclosure(const PointList<Dim>& points, const FacetList<Dim>& facets);

  bool meets(const Simplex<Dim>& facet) const;

  //! Whether the cage does not intersect the model and encloses all of it.
  bool is_strictly_inside(const Cage<Dim>& cage) const;

  //! One point of each connected part, in the order of the model's points.
  const PointList<Dim>& representatives() const { return representatives_; }

  const std::vector<Simplex<Dim>>& simplices() const { return simplices_; }
  const BoxTree<Dim>& tree() const { return tree_; }  //!< of the simplices
  const Box& box() const { return box_; }

  Vector<Dim> nearest_point(const Vector<Dim>& point) const;
  //! Distance from the model. \param limit  upper bound of the result
  double distance(const Vector<Dim>& point, double limit = kFar) const;
  //! Whether the distance from the model is at most this one.
  bool is_within(const Vector<Dim>& point, double distance) const;

 private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();

  Index nearest(const Vector<Dim>& point, double limit) const;

  std::vector<Simplex<Dim>> simplices_;
  BoxTree<Dim> tree_;
  PointList<Dim> representatives_;
  Box box_;
};

//! Distances between a surface (2D: lines) and a model.
struct Distances {
  double mean = 0, largest = 0;
};

//! At control points (the largest only), and at points evenly distributed on every facet.
template <int Dim>
Distances distances(const Cage<Dim>& cage, const Enclosure<Dim>& model);

//! Unit vectors to try in order; none is along an axis or diagonal. \param axis  the vector has a
//! positive component along this axis; -1: any
template <int Dim>
Vector<Dim> ray_direction(int attempt, int axis = -1);

//! Whether a segment from the point to infinity crosses the facets an odd number of times. False if
//! the point lies on a facet.
//! \param directions_axis  the segment points toward larger coordinates of this axis; -1: any
//! direction
template <int Dim>
bool has_odd_crossings(const Vector<Dim>& point, const std::vector<Simplex<Dim>>& facets,
                       int directions_axis = -1);

}  // namespace flbc
