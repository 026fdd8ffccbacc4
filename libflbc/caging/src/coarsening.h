// SPDX-License-Identifier: BSD-3-Clause
// Fewer control points, by collapsing edges.
#pragma once

#include <optional>
#include <queue>
#include <vector>

#include <Eigen/LU>

#include "caging/collapse_check.h"
#include "caging/mirror_plane.h"
#include "flbc/types.h"

namespace flbc {

//! The quadric error of Garland and Heckbert ("Surface simplification using quadric error metrics",
//! 1997), squared distances from the planes of a surface: x^T matrix x - 2 linear^T x + constant.
template <int Dim>
struct Quadric {
  Eigen::Matrix<double, Dim, Dim> matrix = Eigen::Matrix<double, Dim, Dim>::Zero();
  Vector<Dim> linear = Vector<Dim>::Zero();
  double constant = 0;

  //! Adds weight * (squared distance from a plane). \param normal  of length 1
  void add_plane(const Vector<Dim>& normal, const Vector<Dim>& point, double weight) {
    const double height = normal.dot(point);
    matrix += weight * normal * normal.transpose();
    linear += weight * height * normal;
    constant += weight * height * height;
  }

  //! Adds weight * (squared distance from a point).
  void add_point(const Vector<Dim>& point, double weight) {
    matrix.diagonal().array() += weight;
    linear += weight * point;
    constant += weight * point.squaredNorm();
  }

  Quadric& operator+=(const Quadric& other) {
    matrix += other.matrix;
    linear += other.linear;
    constant += other.constant;
    return *this;
  }

  double operator()(const Vector<Dim>& x) const {
    return x.dot(matrix * x) - 2 * linear.dot(x) + constant;
  }

  //! Where it is least; some point has been added, so that there is one such place.
  Vector<Dim> minimiser() const { return matrix.inverse() * linear; }

  //! Where it is least among points whose coordinate `axis` has the given value.
  Vector<Dim> minimiser(int axis, double value) const {
    auto rest = matrix;
    Vector<Dim> right = linear - value * matrix.col(axis);
    rest.row(axis).setZero();
    rest.col(axis).setZero();
    rest(axis, axis) = 1;
    right(axis) = value;
    return rest.inverse() * right;
  }
};

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
