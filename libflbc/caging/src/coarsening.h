// SPDX-License-Identifier: BSD-3-Clause
// Fewer control points, by collapsing edges.
#pragma once

#include <optional>
#include <queue>
#include <vector>

#include "caging/collapse_check.h"
#include "caging/quadric.h"

namespace flbc {

//! Collapses the edges of a surface that encloses a model one by one, always the one that departs
//! least from the surface there was at first. What is enclosed stays so, which is checked exactly;
//! where the best place for the new vertex does not allow it, places farther out are tried, last
//! one outside of the planes of all facets round the edge, as in progressive hulls (Sander et al.,
//! "Silhouette clipping", 2000; Sacht, Vouga and Jacobson, "Nested cages", 2015).
template <int Dim>
class Coarsening {
 public:
  //! \param offset  distance that facets keep from the model where they can
  Coarsening(const Cage<Dim>& surface, const MirrorPlane& plane, const Enclosure<Dim>& enclosure,
             double offset);

  //! Collapses edges until there are so few control points, or none can be collapsed.
  void reduce_to(Index control_points);

  //! Moves vertices towards where they depart least from the surface there was at first.
  void relax();

  Index num_control_points() const { return surface_.num_control_points(); }

  //! Closed, or half of a closed surface.
  Cage<Dim> surface() const { return surface_.surface(); }

 private:
  // A collapse of an edge with its cost: at least that until it has been tried.
  struct Candidate {
    double cost;
    Index a, b;
    Index version_a, version_b;
    bool is_tried;
    Vector<Dim> position;
    bool operator<(const Candidate& other) const {  // the least is taken first
      if (cost != other.cost) return cost > other.cost;
      return a != other.a ? a > other.a : b > other.b;
    }
  };

  Quadric<Dim> quadric(Index a, Index b) const;
  Vector<Dim> best_position(const Quadric<Dim>& quadric, bool is_in_plane) const;
  std::vector<Vector<Dim>> positions(const Quadric<Dim>& quadric,
                                     const Replacement<Dim>& change) const;
  Vector<Dim> outer_position(const Vector<Dim>& start, const Replacement<Dim>& change) const;
  std::optional<Vector<Dim>> first_allowed(const Quadric<Dim>& quadric,
                                           const Replacement<Dim>& change) const;
  bool is_current(const Candidate& candidate) const;
  void add_edge(Index a, Index b);
  void add_edges_at(Index vertex);
  bool take(Candidate candidate);

  EditableSurface<Dim> surface_;
  CollapseCheck<Dim> check_;
  double offset_;
  Vector<Dim> origin_;  // of the quadrics' coordinates
  std::vector<Quadric<Dim>> quadrics_;
  std::vector<Index> versions_;
  std::priority_queue<Candidate> candidates_;
};

}  // namespace flbc
