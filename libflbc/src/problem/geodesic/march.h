// SPDX-License-Identifier: BSD-3-Clause
// The fast marching method on simplicial meshes, Kimmel and Sethian 1998, with point-source
// updates in cells, so that straight paths are exact. Distances grow outward from the source. In a
// cell with an obtuse angle, a vertex may be improved after it has been passed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "flbc/types.h"
#include "problem/geodesic/eikonal_mesh.h"

namespace flbc::distance {

//! Lookup tables indexed by the set of passed corners of a cell, as bits. They are used whenever a
//! vertex is passed in one of its cells.
struct CellTasks {
  static constexpr std::int8_t kAll = 4;
  std::int8_t missing[16];        //!< the only missing corner, or kAll if none is missing
  std::uint8_t is_something[16];  //!< 1 if at most one corner is missing, otherwise 0
};

template <int Dim>
constexpr CellTasks cell_tasks() {
  CellTasks tasks{};
  constexpr unsigned kFull = (1u << (Dim + 1)) - 1;
  tasks.missing[kFull] = CellTasks::kAll;
  tasks.is_something[kFull] = 1;
  for (int k = 0; k <= Dim; ++k) {
    tasks.missing[kFull - (1u << k)] = static_cast<std::int8_t>(k);
    tasks.is_something[kFull - (1u << k)] = 1;
  }
  return tasks;
}

//! A queue of vertices sorted by buckets of distances; within a bucket, last in, first out.
class BucketQueue {
 public:
  //! \param width  of the buckets
  explicit BucketQueue(float width) : per_distance_(1 / width) {}

  void push(Index vertex, float distance) {
    const auto bucket = std::max(current_, static_cast<int>(distance * per_distance_));
    if (static_cast<std::size_t>(bucket) >= top_.size()) {
      top_.resize(static_cast<std::size_t>(bucket) * 2 + 1, kEmpty);
    }
    entries_.push_back({vertex, top_[bucket]});
    top_[bucket] = static_cast<int>(entries_.size()) - 1;
  }

  //! \return -1 if it is empty
  Index pop() {
    for (; static_cast<std::size_t>(current_) < top_.size(); ++current_) {
      const int top = top_[current_];
      if (top == kEmpty) continue;
      top_[current_] = entries_[top].below;
      return entries_[top].vertex;
    }
    return -1;
  }

  //! The vertex that is popped next unless another is pushed, or -1 if unknown. Call only after a
  //! pop.
  Index next() const {
    const int top = top_[current_];
    return top == kEmpty ? -1 : entries_[top].vertex;
  }

  //! Resets the queue for another source.
  void restart() {
    std::fill(top_.begin(), top_.end(), kEmpty);
    current_ = 0;
    entries_.clear();
  }

 private:
  static constexpr int kEmpty = -1;
  struct Entry {
    Index vertex;
    int below;  // the entry below it in its bucket
  };

  float per_distance_;
  int current_ = 0;
  std::vector<int> top_;        // of each bucket
  std::vector<Entry> entries_;  // all entries since the start
};

enum class State : std::uint8_t { kFar, kWaiting, kPassed };

//! State of the front at a vertex.
struct Arrival {
  float distance = std::numeric_limits<float>::max();
  State state = State::kFar;
  bool along_edge = false;    // no ray found yet
  std::uint8_t improved = 0;  // number of improvements after it was passed
};

//! Computes distances, one source at a time.
template <int Dim>
class March {
 public:
  //! \param mesh  is kept by reference
  explicit March(const EikonalMesh<Dim>& mesh)
      : mesh_(mesh),
        cells_(mesh.cells.data()),
        // Narrow enough that vertices are popped nearly in order.
        queue_(0.02f * mesh.mean_length),
        tolerance_(2e-5f * mesh.mean_length) {}

  //! Runs to all vertices. \param sources  the nearest one counts
  //! \return distances of all vertices, valid until the next run
  const std::vector<Arrival>& run(const std::vector<Index>& sources) {
    arrivals_.assign(mesh_.num_vertices(), Arrival{});
    passed_.assign(mesh_.cells.size(), 0);
    queue_.restart();
    for (const Index source : sources) arrive(source, 0, false);
    for (Index v = queue_.pop(); v >= 0; v = queue_.pop()) {
      if (arrivals_[v].state != State::kWaiting) continue;
      if constexpr (Dim == 3) {
        if (arrivals_[v].along_edge) look_through_facets(v);
      }
      arrivals_[v].state = State::kPassed;
      fetch_lists(queue_.next());
      note_cells(v);
      pass_on_along_edges(v);
      if constexpr (Dim == 3) pass_on_round_bends(v);
      pass_on_through_cells(v);
    }
    return arrivals_;
  }

 private:
  // Prefetches, because larger meshes do not fit in the near caches and accesses are scattered.
  // Always inlined, because the compiler drops calls to a function that only prefetches.
  [[gnu::always_inline]] void fetch_lists(Index vertex) const {
    if (vertex < 0) return;
    constexpr int kEdgesPerLine = 64 / sizeof(EdgeTo);
    __builtin_prefetch(mesh_.corners.of(vertex).begin());
    __builtin_prefetch(mesh_.edges.of(vertex).begin());
    __builtin_prefetch(mesh_.edges.of(vertex).begin() + kEdgesPerLine);
  }

  void arrive(Index vertex, float distance, bool along_edge) {
    // In nearly flat cells, vertices could improve each other forever.
    constexpr std::uint8_t kMostImprovements = 30;
    auto& arrival = arrivals_[vertex];
    if (arrival.state == State::kPassed) {
      if (arrival.improved == kMostImprovements) return;
      ++arrival.improved;
      for (const Corner at : mesh_.corners.of(vertex)) {
        passed_[at.simplex()] = static_cast<std::uint8_t>(passed_[at.simplex()] & ~at.bit());
      }
    }
    arrival = {distance, State::kWaiting, along_edge, arrival.improved};
    queue_.push(vertex, distance);
  }

  // Marks the vertex as passed in its cells, and collects and prefetches cells with at most one
  // other corner.
  void note_cells(Index vertex) {
    static constexpr CellTasks kTasks = cell_tasks<Dim>();
    const auto corners = mesh_.corners.of(vertex);
    const auto most = static_cast<std::size_t>(corners.end() - corners.begin());
    if (noted_.size() < most) noted_.resize(most);
    // Byte pointers may alias anything, so members are copied to locals.
    std::uint8_t* const passed = passed_.data();
    Corner* const noted = noted_.data();
    std::size_t num_noted = 0;
    for (const Corner at : corners) {
      const unsigned set = passed[at.simplex()] | at.bit();
      passed[at.simplex()] = static_cast<std::uint8_t>(set);
      noted[num_noted] = at;
      num_noted += kTasks.is_something[set];  // branchless, because a branch would be unpredictable
    }
    for (std::size_t k = 0; k < num_noted; ++k) __builtin_prefetch(cells_ + noted[k].simplex());
    num_noted_ = num_noted;
  }

  void pass_on_along_edges(Index vertex) {
    const Arrival* const arrivals = arrivals_.data();
    const float distance = arrivals[vertex].distance;
    const float tolerance = tolerance_;
    for (const EdgeTo& edge : mesh_.edges.of(vertex)) {
      const float along = distance + edge.length;
      if (along < arrivals[edge.vertex].distance - tolerance) arrive(edge.vertex, along, true);
    }
  }

  // Paths bend around reflex edges of the boundary; rays leave these edges within facets.
  void pass_on_round_bends(Index vertex) {
    for (const Corner at : mesh_.bends.of(vertex)) {
      const Index* corners = corners_of_facet(at.simplex());
      const int first = next(at.corner());
      const Index other = corners[corners[first] == vertex ? next(first) : first];
      if (arrivals_[other].state != State::kPassed) continue;
      const Index apex = corners[at.corner()];
      const float within = distance_within_facet(at, arrivals_[apex].distance - tolerance_);
      if (within >= 0) arrive(apex, within, false);
    }
  }

  // A ray through a cell is known when all corners but one have been passed. An intermediate
  // improvement may also have changed a complete cell into such a cell.
  void pass_on_through_cells(Index vertex) {
    static constexpr CellTasks kTasks = cell_tasks<Dim>();
    const float distance = arrivals_[vertex].distance;
    const Corner* const end = noted_.data() + num_noted_;
    for (const Corner* at = noted_.data(); at != end; ++at) {
      const unsigned set = passed_[at->simplex()];
      if (kTasks.is_something[set] == 0) continue;
      if (kTasks.missing[set] == CellTasks::kAll) {
        look_back(*at, distance);
      } else {
        look_through(at->simplex(), kTasks.missing[set]);
      }
    }
  }

  // This corner can improve a previously passed corner only at an obtuse angle.
  void look_back(Corner at, float distance) {
    const auto& bounds = mesh_.look_back[at.simplex()];
    for (unsigned left = bounds.obtuse_beside(at.corner()); left != 0; left &= left - 1) {
      const int k = __builtin_ctz(left);
      const float present = arrivals_[cells_[at.simplex()].corners[k]].distance;
      if (bounds.can_help(present, distance)) look_through(at.simplex(), k);
    }
  }

  void look_through(std::size_t s, int corner) {
    const auto& cell = cells_[s];
    const auto of = [&](int k) { return arrivals_[cell.corners[k]].distance; };
    const float limit = of(corner) - tolerance_;
    float through;
    if constexpr (Dim == 3) {
      through =
          distance_through(cell, corner, {of(corner ^ 1), of(corner ^ 2), of(corner ^ 3)}, limit);
    } else {
      through = distance_through(cell, corner, of(next(corner)), of(next(next(corner))), limit);
    }
    if (through >= 0) arrive(cell.corners[corner], through, false);
  }

  // Handles a vertex that no ray has reached through a cell.
  void look_through_facets(Index vertex) {
    for (const Corner at : mesh_.corners.of(vertex)) {
      const unsigned others = 15u - at.bit();
      const unsigned waiting = others & ~passed_[at.simplex()];
      if ((waiting & (waiting - 1)) != 0) continue;  // more than one
      // A facet is opposite to one corner and needs the others. Only its first cell evaluates it.
      const auto s = static_cast<Index>(at.simplex());
      for (unsigned left = waiting == 0 ? others : waiting; left != 0; left &= left - 1) {
        const Index facet = mesh_.topology.cell_facets(__builtin_ctz(left), s);
        if (mesh_.topology.sides(0, facet) == s) look_through_facet(facet, vertex);
      }
    }
  }

  void look_through_facet(Index facet, Index vertex) {
    const Index* corners = corners_of_facet(static_cast<std::size_t>(facet));
    const int corner = corners[0] == vertex ? 0 : corners[1] == vertex ? 1 : 2;
    float& distance = arrivals_[vertex].distance;
    const float within = distance_within_facet({facet, corner}, distance);
    if (within >= 0) distance = within;
  }

  float distance_within_facet(Corner at, float limit) const {
    const Index* corners = corners_of_facet(at.simplex());
    const auto of = [&](int k) { return arrivals_[corners[k]].distance; };
    const int first = next(at.corner());
    return distance_through(mesh_.facets[at.simplex()], at.corner(), of(first), of(next(first)),
                            limit);
  }

  const Index* corners_of_facet(std::size_t facet) const {
    return mesh_.topology.facets.data() + facet * Dim;
  }

  // Of a triangle.
  static int next(int corner) { return corner == 2 ? 0 : corner + 1; }

  const EikonalMesh<Dim>& mesh_;
  const EikonalCell<Dim>* const cells_;
  BucketQueue queue_;
  const float tolerance_;  // smaller improvements are not propagated
  std::vector<Arrival> arrivals_;
  std::vector<std::uint8_t> passed_;  // corners of each cell, as bits
  std::vector<Corner> noted_;         // cells to evaluate after the current vertex: the first
  std::size_t num_noted_ = 0;         // number of used entries
};

}  // namespace flbc::distance
