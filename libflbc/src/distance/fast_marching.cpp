// SPDX-License-Identifier: BSD-3-Clause
// The fast marching method on simplicial meshes, Kimmel and Sethian 1998, with cells that see the
// source as a point, so that straight ways are exact. Distances grow outward from the source;
// where a cell has an obtuse angle, a vertex may be improved again after it has been passed.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "distance/eikonal_cell.h"
#include "distance/reflex_edges.h"
#include "flbc/distance_weights.h"
#include "vertex_cells.h"

namespace flbc {
namespace {

using distance::EikonalCell;

// An edge as seen from one end.
struct Edge {
  Index to;
  float length;
};

// What all sources share.
template <int Dim>
struct EikonalMesh {
  const CellList<Dim>& corners;  // of each cell, apart from what is needed seldom
  std::vector<EikonalCell<Dim>> cells;
  std::vector<std::uint16_t> obtuse;  // angles of each cell
  VertexCells vertex_cells;
  std::vector<std::uint8_t> on_reflex_edge;  // V, 3D: where ways may bend
  std::vector<Index> first_edge;             // V + 1
  std::vector<Edge> edges;                   // of each vertex
  float bucket_width;                        // narrow enough for vertices to come nearly in order

  EikonalMesh(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& topology);
};

template <int Dim>
EikonalMesh<Dim>::EikonalMesh(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& topology)
    : corners(mesh.cells),
      cells(mesh.num_cells()),
      obtuse(mesh.num_cells()),
      vertex_cells(mesh),
      first_edge(1, 0) {
#pragma omp parallel for schedule(static)
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    cells[s] = distance::eikonal_cell(mesh, s);
    obtuse[s] = distance::obtuse_angles(cells[s]);
  }
  if constexpr (Dim == 3) on_reflex_edge = distance::on_reflex_edges(mesh, topology);
  std::vector<Index> seen_from(mesh.num_vertices(), -1);
  double total = 0;
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    seen_from[v] = v;
    for (const Index s : vertex_cells.cells_of(v)) {
      for (const Index w : corners.col(s)) {
        if (seen_from[w] == v) continue;
        seen_from[w] = v;
        const double length = (mesh.points.col(v) - mesh.points.col(w)).norm();
        edges.push_back({w, static_cast<float>(length)});
        total += length;
      }
    }
    first_edge.push_back(static_cast<Index>(edges.size()));
  }
  bucket_width = static_cast<float>(0.02 * total / static_cast<double>(edges.size()));
}

// A queue that is sorted by buckets of distances.
class BucketQueue {
 public:
  explicit BucketQueue(float width) : width_(width) {}

  void push(Index vertex, float distance) {
    const auto bucket = std::max(current_, static_cast<std::size_t>(distance / width_));
    if (bucket >= buckets_.size()) buckets_.resize(bucket + 1);
    buckets_[bucket].push_back(vertex);
  }

  // -1 if it is empty.
  Index pop() {
    for (; current_ < buckets_.size(); ++current_) {
      auto& bucket = buckets_[current_];
      if (bucket.empty()) continue;
      const Index vertex = bucket.back();
      bucket.pop_back();
      return vertex;
    }
    return -1;
  }

  void clear() { current_ = 0; }

 private:
  float width_;
  std::size_t current_ = 0;
  std::vector<std::vector<Index>> buckets_;
};

enum class State : std::uint8_t { kFar, kWaiting, kPassed };

struct Arrival {
  float distance = std::numeric_limits<float>::max();
  State state = State::kFar;
  bool along_edge = false;  // no ray has been found yet
};

// The distances from one source.
template <int Dim>
class March {
 public:
  explicit March(const EikonalMesh<Dim>& mesh)
      : mesh_(mesh), tolerance_(1e-3f * mesh.bucket_width), queue_(mesh.bucket_width) {}

  const std::vector<Arrival>& run(Index source) {
    arrivals_.assign(mesh_.first_edge.size() - 1, Arrival{});
    num_passed_.assign(mesh_.cells.size(), 0);
    lower(source, 0, false);
    for (Index v = queue_.pop(); v >= 0; v = queue_.pop()) {
      if (arrivals_[v].state != State::kWaiting) continue;
      if (Dim == 3 && arrivals_[v].along_edge) look_through_faces(v);
      arrivals_[v].state = State::kPassed;
      pass_on_along_edges(v);
      pass_on_through_cells(v);
    }
    queue_.clear();
    return arrivals_;
  }

 private:
  void lower(Index vertex, float distance, bool along_edge) {
    auto& arrival = arrivals_[vertex];
    if (!(distance < arrival.distance - tolerance_)) return;
    if (arrival.state == State::kPassed) {
      for (const Index s : mesh_.vertex_cells.cells_of(vertex)) --num_passed_[s];
    }
    arrival = {distance, State::kWaiting, along_edge};
    queue_.push(vertex, distance);
  }

  void pass_on_along_edges(Index vertex) {
    const float distance = arrivals_[vertex].distance;
    for (Index e = mesh_.first_edge[vertex]; e < mesh_.first_edge[vertex + 1]; ++e) {
      lower(mesh_.edges[e].to, distance + mesh_.edges[e].length, true);
    }
  }

  // A ray through a cell is known once all corners but one have been passed. One that has been
  // passed before `vertex` can only profit from it at an obtuse angle.
  void pass_on_through_cells(Index vertex) {
    for (const Index s : mesh_.vertex_cells.cells_of(vertex)) {
      if (Dim == 3 && mesh_.on_reflex_edge[vertex] != 0) pass_on_from_reflex_edge(s, vertex);
      const int num_passed = ++num_passed_[s];
      if (num_passed < Dim || (num_passed > Dim && mesh_.obtuse[s] == 0)) continue;
      const Index* corners = corners_of(s);
      float known[Dim + 1];
      int waiting = 0;
      for (int k = 0; k <= Dim; ++k) {
        known[k] = arrivals_[corners[k]].distance;
        if (arrivals_[corners[k]].state != State::kPassed) waiting = k;
      }
      if (num_passed == Dim) {
        look_through(s, waiting, known);
      } else {
        look_back(s, vertex, known);
      }
    }
  }

  void look_through(Index s, int corner, const float (&known)[Dim + 1]) {
    const float through = distance_through(mesh_.cells[s], corner, known);
    if (through >= 0) lower(corners_of(s)[corner], through, false);
  }

  void look_back(Index s, Index vertex, const float (&known)[Dim + 1]) {
    const int own = corner_of(s, vertex);
    for (int k = 0; k <= Dim; ++k) {
      if ((mesh_.obtuse[s] >> (4 * k + own) & 1) != 0) look_through(s, k, known);
    }
  }

  // The ray within a face of a cell.
  float distance_within_face(Index s, int corner, int first, int second) {
    using Cell = EikonalCell<Dim>;
    const auto& lengths2 = mesh_.cells[s].lengths2;
    const auto face = distance::eikonal_triangle({lengths2[Cell::pair(corner, first)],
                                                  lengths2[Cell::pair(corner, second)],
                                                  lengths2[Cell::pair(first, second)]});
    const Index* corners = corners_of(s);
    return distance_through(
        face, 0, {0, arrivals_[corners[first]].distance, arrivals_[corners[second]].distance});
  }

  // Ways bend round reflex edges of the boundary: rays leave these within faces.
  void pass_on_from_reflex_edge(Index s, Index vertex) {
    const Index* corners = corners_of(s);
    const int own = corner_of(s, vertex);
    for (int other = 0; other <= Dim; ++other) {
      if (other == own || mesh_.on_reflex_edge[corners[other]] == 0) continue;
      if (arrivals_[corners[other]].state != State::kPassed) continue;
      for (int k = 0; k <= Dim; ++k) {
        if (k == own || k == other) continue;
        const float within = distance_within_face(s, k, own, other);
        if (within >= 0) lower(corners[k], within, false);
      }
    }
  }

  // For a vertex that no ray has reached through a cell.
  void look_through_faces(Index vertex) {
    auto& arrival = arrivals_[vertex];
    for (const Index s : mesh_.vertex_cells.cells_of(vertex)) {
      const Index* corners = corners_of(s);
      const int own = corner_of(s, vertex);
      for (int side = 1; side <= Dim; ++side) {
        const int first = (own + side) % 4;
        const int second = (own + side % 3 + 1) % 4;
        if (arrivals_[corners[first]].state != State::kPassed) continue;
        if (arrivals_[corners[second]].state != State::kPassed) continue;
        const float within = distance_within_face(s, own, first, second);
        if (within >= 0) arrival.distance = std::min(arrival.distance, within);
      }
    }
  }

  const Index* corners_of(Index s) const {
    return mesh_.corners.data() + std::size_t(s) * (Dim + 1);
  }

  int corner_of(Index s, Index vertex) const {
    const Index* corners = corners_of(s);
    return static_cast<int>(std::find(corners, corners + Dim, vertex) - corners);
  }

  const EikonalMesh<Dim>& mesh_;
  const float tolerance_;  // smaller improvements are not passed on
  BucketQueue queue_;
  std::vector<Arrival> arrivals_;
  std::vector<std::uint8_t> num_passed_;  // corners of each cell
};

}  // namespace

template <int Dim>
Eigen::MatrixXd geodesic_distances(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& topology,
                                   const std::vector<Index>& sources) {
  const EikonalMesh<Dim> eikonal(mesh, topology);
  const auto num_sources = static_cast<Index>(sources.size());
  Eigen::MatrixXd distances(num_sources, mesh.num_vertices());
#pragma omp parallel
  {
    March<Dim> march(eikonal);
#pragma omp for schedule(dynamic, 1)
    for (Index i = 0; i < num_sources; ++i) {
      const auto& arrivals = march.run(sources[i]);
      for (Index v = 0; v < mesh.num_vertices(); ++v) distances(i, v) = arrivals[v].distance;
    }
  }
  return distances;
}

template Eigen::MatrixXd geodesic_distances(const DomainMesh<2>&, const MeshTopology<2>&,
                                            const std::vector<Index>&);
template Eigen::MatrixXd geodesic_distances(const DomainMesh<3>&, const MeshTopology<3>&,
                                            const std::vector<Index>&);

}  // namespace flbc
