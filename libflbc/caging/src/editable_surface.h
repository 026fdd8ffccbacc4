// SPDX-License-Identifier: BSD-3-Clause
// A surface (2D: closed lines) whose edges can be collapsed.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "cage/box_tree.h"
#include "caging/mirror_plane.h"
#include "flbc/cage.h"
#include "meshing/cgal/exact_predicates.h"

namespace flbc {

//! The facets around an edge whose ends are merged.
template <int Dim>
struct Collapse {
  Index kept = -1, removed = -1;             //!< the ends; vertex `kept` remains
  bool is_in_plane = false;                  //!< the vertex must be in the mirror plane
  std::vector<Index> dying{};                //!< facets with both ends
  std::vector<Index> ring{};                 //!< facets with one end
  std::vector<FacetCorners<Dim>> corners{};  //!< of the ring facets after the collapse
};

template <int Dim>
class EditableSurface {
 public:
  using Box = Eigen::AlignedBox<double, Dim>;

  //! \param surface  closed, or half of a closed one with its border in the plane
  EditableSurface(const Cage<Dim>& surface, const MirrorPlane& plane);

  const PointList<Dim>& points() const { return points_; }
  const std::vector<FacetCorners<Dim>>& facets() const { return facets_; }
  bool has_vertex(Index vertex) const { return !facets_at_[vertex].empty(); }
  const std::vector<Index>& facets_at(Index vertex) const { return facets_at_[vertex]; }
  const MirrorPlane& plane() const { return plane_; }
  bool is_in_plane(Index vertex) const { return plane_.contains(points_.col(vertex)); }

  //! Ascending.
  std::vector<Index> neighbours(Index vertex) const;

  //! Vertices of the closed surface, including mirror images.
  Index num_control_points() const { return num_control_points_; }

  //! The collapse of an edge; empty if the surface would not stay manifold.
  std::optional<Collapse<Dim>> plan_collapse(Index a, Index b) const;
  void collapse(const Collapse<Dim>& plan, const Vector<Dim>& position);
  void move(Index vertex, const Vector<Dim>& position);

  //! Corners of a facet with one vertex moved.
  Simplex<Dim> facet_with(const FacetCorners<Dim>& corners, Index vertex,
                          const Vector<Dim>& position) const;
  Simplex<Dim> facet(Index number) const;
  const Box& box(Index facet) const { return boxes_[facet]; }  //!< empty: the facet is gone

  //! Calls `visit` with the facets whose boxes intersect this one, until it returns true. May visit
  //! one twice. \return whether it did
  template <class Visit>
  bool any_near(const Box& query, const Visit& visit) const {
    const auto is_hit = [&](Index f) { return boxes_[f].intersects(query) && visit(f); };
    return std::any_of(changed_.begin(), changed_.end(), is_hit) ||
           tree_.any_of(query, [&](Index k) { return is_hit(in_tree_[k]); });
  }

  Cage<Dim> surface() const;

 private:
  void update_tree();
  bool keeps_border(const Collapse<Dim>& plan) const;
  void update_boxes(Index vertex);

  PointList<Dim> points_;
  std::vector<FacetCorners<Dim>> facets_;
  std::vector<std::vector<Index>> facets_at_;
  std::vector<Box> boxes_;
  std::vector<Index> in_tree_, changed_{};  // facets, those that have changed since
  BoxTree<Dim> tree_{std::vector<Box>{}};
  MirrorPlane plane_;
  Index num_control_points_ = 0;
};

}  // namespace flbc
