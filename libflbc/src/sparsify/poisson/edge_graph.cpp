// SPDX-License-Identifier: BSD-3-Clause
#include "sparsify/poisson/edge_graph.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "base/instantiate.h"

namespace flbc {

template <int Dim>
std::vector<Index> find_representatives(const PointList<Dim>& points, const SparseWeights& weights,
                                        const PointMasks& masks) {
  std::vector<Index> order(points.cols()), representatives(points.cols());
  std::iota(order.begin(), order.end(), 0);
  const auto is_before = [&](Index a, Index b) {
    const auto* p = points.col(a).data();
    const auto* q = points.col(b).data();
    return std::lexicographical_compare(p, p + Dim, q, q + Dim);
  };
  std::stable_sort(order.begin(), order.end(), is_before);
  std::vector<Index> distinct;  // distinct weights at one position
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Index point = order[k];
    if (k == 0 || is_before(order[k - 1], point)) distinct.clear();
    const auto same = std::find_if(distinct.begin(), distinct.end(), [&](Index other) {
      return masks.same(other, point) && weights.at(other) == weights.at(point);
    });
    representatives[point] = same == distinct.end() ? point : *same;
    if (same == distinct.end()) distinct.push_back(point);
  }
  return representatives;
}

EdgeList welded_edges(const EdgeList& edges, const std::vector<Index>& number_of) {
  std::vector<std::pair<std::array<Index, 2>, double>> all;
  for (std::size_t e = 0; e < edges.ends.size(); ++e) {
    const auto [a, b] = std::minmax(number_of[edges.ends[e][0]], number_of[edges.ends[e][1]]);
    if (a != b) all.push_back({{a, b}, edges.weights.empty() ? 1 : edges.weights[e]});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& s, const auto& t) { return s.first < t.first; });
  EdgeList welded;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (k == 0 || all[k].first != all[k - 1].first) {
      welded.ends.push_back(all[k].first);
      welded.weights.push_back(0);
    }
    welded.weights.back() += all[k].second;
  }
  return welded;
}

template <int Dim>
EdgeGraph::EdgeGraph(const PointList<Dim>& points, const EdgeList& edges) {
  neighbours_ = items_by_vertex<Neighbour>(points.cols(), [&](const auto& visit) {
    for (std::size_t e = 0; e < edges.ends.size(); ++e) {
      const auto [a, b] = edges.ends[e];
      if (a == b) continue;
      const double weight = edges.weights.empty() ? 1 : edges.weights[e];
      visit(a, Neighbour{b, weight});
      visit(b, Neighbour{a, weight});
    }
  });
  masses_.assign(points.cols(), 0);
  for (Index a = 0; a < static_cast<Index>(points.cols()); ++a) {
    for (const auto& [b, weight] : neighbours_of(a)) {
      masses_[a] += weight * (points.col(a) - points.col(b)).squaredNorm() / 2;
    }
  }
  color(make_blocks());
}

std::vector<EdgeGraph::Block> EdgeGraph::make_blocks() const {
  constexpr std::size_t kBlock = 128;  // points: their weights fit into the cache of a core
  std::vector<Block> blocks;
  for (Index a = 0; a < static_cast<Index>(masses_.size()); ++a) {
    const auto neighbours = neighbours_of(a);
    if (neighbours.first == neighbours.last) continue;
    if (blocks.empty() || blocks.back().size() == kBlock) blocks.emplace_back();
    blocks.back().push_back(a);
  }
  return blocks;
}

// Greedy coloring: every block gets the first color that no neighbor has.
void EdgeGraph::color(const std::vector<Block>& blocks) {
  std::vector<std::size_t> block_of(masses_.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    for (const Index a : blocks[b]) block_of[a] = b;
  }
  std::vector<std::size_t> color_of(blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    std::vector<bool> is_taken(colors_.size() + 1, false);
    for (const Index a : blocks[b]) {
      for (const auto& neighbour : neighbours_of(a)) {
        if (block_of[neighbour.point] < b) is_taken[color_of[block_of[neighbour.point]]] = true;
      }
    }
    color_of[b] = static_cast<std::size_t>(std::find(is_taken.begin(), is_taken.end(), false) -
                                           is_taken.begin());
    if (color_of[b] == colors_.size()) colors_.emplace_back();
    colors_[color_of[b]].push_back(blocks[b]);
  }
}

template EdgeGraph::EdgeGraph(const PointList<2>&, const EdgeList&);
template EdgeGraph::EdgeGraph(const PointList<3>&, const EdgeList&);
FLBC_INSTANTIATE_FUNCTION(find_representatives)

}  // namespace flbc
