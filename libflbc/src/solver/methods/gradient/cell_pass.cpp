// SPDX-License-Identifier: BSD-3-Clause
#include "solver/methods/gradient/cell_pass.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesh/hilbert_order.h"

namespace flbc::gradient {
namespace {

template <int Dim>
class PassBuilder {
 public:
  PassBuilder(const MeshTopology<Dim>& topology, const std::vector<Index>& order, int num_parts)
      : topology_(topology), order_(order), part_(order.size()), state_(order.size()) {
    const std::size_t num_cells = order.size();
    for (int p = 0; p < num_parts; ++p) {
      first_.push_back(num_cells * p / num_parts);
      const std::size_t end = num_cells * (p + 1) / num_parts;
      for (std::size_t k = first_.back(); k < end; ++k) part_[order[k]] = p;
    }
    first_.push_back(num_cells);
  }

  CellPass build() {
    CellPass pass;
    for (std::size_t p = 0; p + 1 < first_.size(); ++p) pass.parts.push_back(build_part(p));
    for (Index f = 0; f < topology_.num_facets(); ++f) {
      if (is_seam(f)) pass.seams.push_back(f);
    }
    return pass;
  }

 private:
  // State of a cell during the pass.
  struct State {
    Place place = 0;
    std::int8_t open_facets = 0;  // that still need its extrapolated gradient
    bool visited = false;
  };

  bool is_seam(Index facet) const {
    return !topology_.is_boundary(facet) &&
           part_[topology_.sides(0, facet)] != part_[topology_.sides(1, facet)];
  }

  bool at_seam(Index cell) const {
    for (int k = 0; k <= Dim; ++k) {
      if (is_seam(topology_.cell_facets(k, cell))) return true;
    }
    return false;
  }

  PassPart build_part(std::size_t p) {
    PassPart part;
    // Reuses the most recently released slot, which is still in the cache.
    std::vector<Place> free;
    const auto take = [&] {
      if (free.empty()) return part.num_slots++;
      const Place slot = free.back();
      free.pop_back();
      return slot;
    };
    const auto release = [&](State& state) {
      if (--state.open_facets == 0 && state.place >= 0) free.push_back(state.place);
    };
    for (std::size_t k = first_[p]; k < first_[p + 1]; ++k) {
      const Index cell = order_[k];
      State& own = state_[cell];
      own = {at_seam(cell) ? ~cell : take(), Dim + 1, true};
      std::int32_t num_closings = 0;
      for (int j = 0; j <= Dim; ++j) {
        const Index facet = topology_.cell_facets(j, cell);
        const Index first = topology_.sides(0, facet);
        const Index other = first == cell ? topology_.sides(1, facet) : first;
        if (other >= 0 && (is_seam(facet) || !state_[other].visited)) continue;
        const Place others = other >= 0 ? state_[other].place : own.place;
        part.closings.push_back(
            {facet, first == cell ? own.place : others, first == cell ? others : own.place});
        ++num_closings;
        release(own);
        if (other >= 0) release(state_[other]);
      }
      part.visits.push_back({cell, own.place, num_closings});
    }
    return part;
  }

  const MeshTopology<Dim>& topology_;
  const std::vector<Index>& order_;
  std::vector<int> part_;
  std::vector<State> state_;
  std::vector<std::size_t> first_;
};

template <int Dim>
std::vector<Index> order_in_space(const DomainMesh<Dim>& mesh) {
  PointList<Dim> centers = PointList<Dim>::Zero(Dim, mesh.num_cells());
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    for (int k = 0; k <= Dim; ++k) centers.col(s) += mesh.points.col(mesh.cells(k, s));
  }
  return spatial_order<Dim>(centers);
}

// Whether more cells wait for neighbors than in any order with locality.
template <int Dim>
bool is_scattered(const CellPass& pass) {
  const auto num_seams = static_cast<double>(pass.seams.size());
  const double at_seams = 2 * num_seams / static_cast<double>(pass.parts.size());
  return std::any_of(pass.parts.begin(), pass.parts.end(), [&](const PassPart& part) {
    const double surface = std::pow(static_cast<double>(part.visits.size()), (Dim - 1.0) / Dim);
    return part.num_slots + at_seams > 12 * surface;
  });
}

}  // namespace

// Meshes from flbc, and many others, are already ordered; their own order streams memory best.
template <int Dim>
CellPass make_cell_pass(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& topology,
                        int num_parts) {
  constexpr int kSmallestPart = 512;
  num_parts = std::clamp(mesh.num_cells() / kSmallestPart, 1, num_parts);
  std::vector<Index> order(mesh.num_cells());
  std::iota(order.begin(), order.end(), 0);
  auto pass = PassBuilder<Dim>(topology, order, num_parts).build();
  if (is_scattered<Dim>(pass)) {
    order = order_in_space(mesh);
    pass = PassBuilder<Dim>(topology, order, num_parts).build();
  }
  return pass;
}

template CellPass make_cell_pass(const DomainMesh<2>&, const MeshTopology<2>&, int);
template CellPass make_cell_pass(const DomainMesh<3>&, const MeshTopology<3>&, int);

}  // namespace flbc::gradient
