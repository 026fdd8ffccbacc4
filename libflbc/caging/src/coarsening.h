// SPDX-License-Identifier: BSD-3-Clause
// Reduces control points by collapsing edges.
#pragma once

#include <functional>
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

  //! The minimizer; unique because at least one point has been added.
  Vector<Dim> minimiser() const { return matrix.inverse() * linear; }

  //! The minimizer among points whose coordinate `axis` has the given value.
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

//! Collapses edges of a surface that encloses a model, always the one with the smallest deviation
//! from the original surface. The model stays enclosed, which is checked exactly. If the best
//! position of the new vertex violates this, positions farther out are tried. The last one is
//! outside the planes of all facets around the edge, as in progressive hulls (Sander et al.,
//! "Silhouette clipping", 2000; Sacht, Vouga and Jacobson, "Nested cages", 2015).
template <int Dim>
class Coarsening {
 public:
  //! \param offset  distance that facets keep from the model if possible
  Coarsening(const Cage<Dim>& surface, const MirrorPlane& plane, const Enclosure<Dim>& enclosure,
             double offset, const CageLimits& limits);

  //! Collapses edges until the number of control points is reached, the measure would grow beyond
  //! its limit, or no edge can be collapsed.
  //! \param progress  receives the progress in [0, 1]
  void reduce_to(Index control_points, const std::function<void(double)>& progress = {});

  //! Moves vertices toward the smallest deviation from the original surface.
  void relax();

  Index num_control_points() const { return surface_.num_control_points(); }

  //! Closed, or half of a closed surface.
  Cage<Dim> surface() const { return surface_.surface(); }

 private:
  // A collapse of an edge with its cost, which is a lower bound until this position is allowed.
  struct Candidate {
    double cost;
    Index a, b;
    Index version_a, version_b;
    Vector<Dim> position;
    bool operator<(const Candidate& other) const {  // smallest first
      if (cost != other.cost) return cost > other.cost;
      return a != other.a ? a > other.a : b > other.b;
    }
  };

  Quadric<Dim> quadric(Index a, Index b) const;
  Vector<Dim> best_position(const Quadric<Dim>& quadric, bool is_in_plane) const;
  std::vector<Vector<Dim>> positions(const Quadric<Dim>& quadric,
                                     const Replacement<Dim>& change) const;
  Vector<Dim> outer_position(const Vector<Dim>& start, const Replacement<Dim>& change) const;
  double length_at(const Replacement<Dim>& change) const;
  bool keeps_lengths(const Replacement<Dim>& change, const Vector<Dim>& position) const;
  bool allows(const Replacement<Dim>& change, const Vector<Dim>& position) const;
  std::optional<Vector<Dim>> first_allowed(const Quadric<Dim>& quadric,
                                           const Replacement<Dim>& change,
                                           const Vector<Dim>& refused) const;
  bool is_current(const Candidate& candidate) const;
  void add_edge(Index a, Index b);
  void add_edges_at(Index vertex);
  bool take(Candidate candidate);
  void collapse_to(Index control_points, const std::function<void(double)>& progress);
  double measure_of(const Simplex<Dim>& facet) const;
  double growth(const Replacement<Dim>& change, const Vector<Dim>& position) const;

  EditableSurface<Dim> surface_;
  CollapseCheck<Dim> check_;
  double offset_;
  Vector<Dim> origin_;  // of the coordinates of the quadrics
  std::vector<Quadric<Dim>> quadrics_;
  std::vector<Index> versions_;
  std::priority_queue<Candidate> candidates_;
  double measure_ = 0;  // Dim! times the area or volume inside the closed surface or its half
  double most_;         // of this
  std::vector<double> lengths_;  // limits of edges at every vertex; empty: none
  bool lengths_grow_;
};

}  // namespace flbc
