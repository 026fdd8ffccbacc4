// SPDX-License-Identifier: BSD-3-Clause
#include "caging/coarsening.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "caging/surface_tools.h"

namespace flbc {

namespace {

// Weight of the squared distance from original vertices, relative to that from their planes.
constexpr double kWeightOfPoints = 3e-3;

// Facets keep this fraction of the offset from the model.
constexpr double kClearance = 0.3;

// Edges of length h end with the same cost everywhere. In 3D that is an area h^2 times squared
// distances (h^2)^2 of a curved surface from its planes; in 2D a length h times h^2, because lines
// along a grid are as far from the planes of their cells as from points. For h ~ d^(-1 / (Dim - 1))
// both are independent of the density d with a weight of d^3.
template <int Dim>
std::vector<Quadric<Dim>> collect_quadrics(const EditableSurface<Dim>& surface,
                                           const Vector<Dim>& origin,
                                           const std::vector<double>& densities) {
  std::vector<Quadric<Dim>> quadrics(static_cast<std::size_t>(surface.points().cols()));
  for (Index f = 0; f < static_cast<Index>(surface.facets().size()); ++f) {
    const auto corners = surface.facet(f).corners;
    const Vector<Dim> normal = facet_normal<Dim>(corners);
    const double measure = normal.norm();
    if (!(measure > 0)) continue;
    for (int k = 0; k < Dim; ++k) {
      const Vector<Dim> p = corners.col(k) - origin;
      const Index v = surface.facets()[f](k);
      const double weight = std::pow(densities[v], 3) * measure;
      quadrics[v].add_plane(normal / measure, p, weight);
      quadrics[v].add_point(p, kWeightOfPoints * weight);
    }
  }
  return quadrics;
}

}  // namespace

template <int Dim>
Coarsening<Dim>::Coarsening(const Cage<Dim>& surface, const MirrorPlane& plane,
                            const Enclosure<Dim>& enclosure, double offset,
                            const CageLimits& limits)
    : surface_(surface, plane),
      check_(surface_, enclosure, kClearance * offset, limits),
      offset_(offset),
      origin_(enclosure.box().center()),
      quadrics_(collect_quadrics(surface_, origin_, limits.densities)),
      versions_(quadrics_.size(), 0),
      lengths_(limits.lengths),
      lengths_grow_(limits.lengths_grow) {
  for (Index f = 0; f < surface.facets.cols(); ++f) measure_ += measure_of(surface_.facet(f));
  most_ = limits.growth * measure_;
}

// Half a surface needs no facets in the plane, because the origin is in it too.
template <int Dim>
double Coarsening<Dim>::measure_of(const Simplex<Dim>& facet) const {
  return facet_normal<Dim>(facet.corners).dot(facet.corners.col(0) - origin_);
}

template <int Dim>
double Coarsening<Dim>::growth(const Replacement<Dim>& change, const Vector<Dim>& position) const {
  double sum = 0;
  for (const auto& corners : change.new_facets) {
    sum += measure_of(surface_.facet_with(corners, change.vertex, position));
  }
  for (const Index f : change.old_facets) sum -= measure_of(surface_.facet(f));
  return sum;
}

template <int Dim>
Quadric<Dim> Coarsening<Dim>::quadric(Index a, Index b) const {
  Quadric<Dim> sum = quadrics_[a];
  return sum += quadrics_[b];
}

template <int Dim>
Vector<Dim> Coarsening<Dim>::best_position(const Quadric<Dim>& quadric, bool is_in_plane) const {
  const auto& plane = surface_.plane();
  if (!is_in_plane) return origin_ + quadric.minimiser();
  Vector<Dim> best = origin_ + quadric.minimiser(plane.axis, plane.position - origin_(plane.axis));
  best(plane.axis) = plane.position;
  return best;
}

// Moves the point out of the half-spaces below the planes of the old facets, one at a time.
template <int Dim>
Vector<Dim> Coarsening<Dim>::outer_position(const Vector<Dim>& start,
                                            const Replacement<Dim>& change) const {
  constexpr int kSweeps = 20;
  Vector<Dim> p = start;
  bool has_moved = true;
  for (int sweep = 0; sweep < kSweeps && has_moved; ++sweep) {
    has_moved = false;
    for (const Index f : change.old_facets) {
      const auto corners = surface_.facet(f).corners;
      Vector<Dim> normal = facet_normal<Dim>(corners).normalized();
      const double depth = normal.dot(corners.col(0) - p);
      if (change.is_in_plane) normal(surface_.plane().axis) = 0;
      const double steepness = normal.squaredNorm();
      if (!(depth > 0 && steepness > 1e-2)) continue;
      p += 1.01 * depth / steepness * normal;
      has_moved = true;
    }
  }
  return p;
}

// In the order of their costs.
template <int Dim>
std::vector<Vector<Dim>> Coarsening<Dim>::positions(const Quadric<Dim>& quadric,
                                                    const Replacement<Dim>& change) const {
  const Vector<Dim> best = best_position(quadric, change.is_in_plane);
  Vector<Dim> outwards = Vector<Dim>::Zero();
  for (const Index f : change.old_facets) {
    outwards += facet_normal<Dim>(surface_.facet(f).corners);
  }
  if (change.is_in_plane) outwards(surface_.plane().axis) = 0;
  outwards.normalize();
  std::vector<Vector<Dim>> all{best, outer_position(best, change)};
  for (const double height : {0.25, 0.5, 1.0, 2.0, 4.0}) {
    all.push_back(best + height * offset_ * outwards);
  }
  std::stable_sort(all.begin(), all.end(), [&](const Vector<Dim>& p, const Vector<Dim>& q) {
    return quadric(p - origin_) < quadric(q - origin_);
  });
  return all;
}

// The limit at the vertex of a collapse, which has that of both ends.
template <int Dim>
double Coarsening<Dim>::length_at(const Replacement<Dim>& change) const {
  return std::min(lengths_[change.vertex], lengths_[change.removed]);
}

// An edge may be as long as the mean of what is allowed at its ends.
template <int Dim>
bool Coarsening<Dim>::keeps_lengths(const Replacement<Dim>& change,
                                    const Vector<Dim>& position) const {
  if (lengths_.empty()) return true;
  const double own = length_at(change);
  for (const auto& corners : change.new_facets) {
    for (const Index other : corners) {
      if (other == change.vertex) continue;
      const double length = (surface_.points().col(other) - position).norm();
      if (length > (own + lengths_[other]) / 2) return false;
    }
  }
  return true;
}

template <int Dim>
bool Coarsening<Dim>::allows(const Replacement<Dim>& change, const Vector<Dim>& position) const {
  const double growth = this->growth(change, position);
  return !(growth > 0 && measure_ + growth > most_) && keeps_lengths(change, position) &&
         check_.allows(change, position);
}

template <int Dim>
std::optional<Vector<Dim>> Coarsening<Dim>::first_allowed(const Quadric<Dim>& quadric,
                                                          const Replacement<Dim>& change,
                                                          const Vector<Dim>& refused) const {
  for (const auto& position : positions(quadric, change)) {
    if (position != refused && allows(change, position)) return position;
  }
  return {};
}

template <int Dim>
bool Coarsening<Dim>::is_current(const Candidate& c) const {
  return c.version_a == versions_[c.a] && c.version_b == versions_[c.b];
}

template <int Dim>
void Coarsening<Dim>::add_edge(Index a, Index b) {
  const auto sum = quadric(a, b);
  const bool is_in_plane = surface_.is_in_plane(a) || surface_.is_in_plane(b);
  const Vector<Dim> best = best_position(sum, is_in_plane);
  candidates_.push({sum(best - origin_), a, b, versions_[a], versions_[b], best});
}

template <int Dim>
void Coarsening<Dim>::add_edges_at(Index vertex) {
  for (const Index other : surface_.neighbours(vertex)) {
    add_edge(std::min(vertex, other), std::max(vertex, other));
  }
}

// \return whether the edge has been collapsed; if only its cost was updated, it is queued again
template <int Dim>
bool Coarsening<Dim>::take(Candidate candidate) {
  const auto plan = surface_.plan_collapse(candidate.a, candidate.b);
  if (!plan) return false;
  const auto change = replacement_of(*plan);
  const auto sum = quadric(candidate.a, candidate.b);
  if (!allows(change, candidate.position)) {
    const auto position = first_allowed(sum, change, candidate.position);
    if (!position) return false;
    candidate.position = *position;
    candidate.cost = sum(*position - origin_);
    if (!candidates_.empty() && candidates_.top().cost < candidate.cost) {
      candidates_.push(candidate);
      return false;
    }
  }
  measure_ += growth(change, candidate.position);
  if (!lengths_.empty()) lengths_[candidate.a] = length_at(change);
  surface_.collapse(*plan, candidate.position);
  quadrics_[candidate.a] = sum;
  ++versions_[candidate.a];
  ++versions_[candidate.b];
  add_edges_at(candidate.a);
  return true;
}

template <int Dim>
void Coarsening<Dim>::reduce_to(Index control_points, const std::function<void(double)>& progress) {
  constexpr double kLonger = 1.2, kLongest = 20;
  collapse_to(control_points, progress);
  for (double longer = kLonger; lengths_grow_ && longer < kLongest; longer *= kLonger) {
    if (num_control_points() <= control_points) return;
    for (double& length : lengths_) length *= kLonger;
    collapse_to(control_points, progress);
  }
}

template <int Dim>
void Coarsening<Dim>::collapse_to(Index control_points,
                                  const std::function<void(double)>& progress) {
  const double first = num_control_points();
  bool has_progressed = true;
  while (num_control_points() > control_points && has_progressed) {
    has_progressed = false;
    candidates_ = {};
    for (Index a = 0; a < static_cast<Index>(versions_.size()); ++a) {
      if (!surface_.has_vertex(a)) continue;
      for (const Index b : surface_.neighbours(a)) {
        if (a < b) add_edge(a, b);
      }
    }
    while (num_control_points() > control_points && !candidates_.empty()) {
      const Candidate candidate = candidates_.top();
      candidates_.pop();
      if (!is_current(candidate) || !take(candidate)) continue;
      has_progressed = true;
      if (progress) progress((first - num_control_points()) / (first - control_points));
    }
  }
}

template <int Dim>
void Coarsening<Dim>::relax() {
  for (Index vertex = 0; vertex < static_cast<Index>(versions_.size()); ++vertex) {
    if (!surface_.has_vertex(vertex)) continue;
    const auto change = replacement_of(surface_, vertex);
    const Vector<Dim> now = surface_.points().col(vertex);
    const Vector<Dim> best = best_position(quadrics_[vertex], change.is_in_plane);
    for (const double part : {1.0, 0.5, 0.25}) {
      const Vector<Dim> position = now + part * (best - now);
      if (!check_.allows(change, position)) continue;
      surface_.move(vertex, position);
      break;
    }
  }
}

template class Coarsening<2>;
template class Coarsening<3>;

}  // namespace flbc
