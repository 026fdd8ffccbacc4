// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/nested_mesh.h"

#include <algorithm>
#include <cstdint>
#include <unordered_map>

#include "base/instantiate.h"

namespace flbc {
namespace {

template <int Dim>
constexpr int kParts = 1 << Dim;

// Numbers the edges of a mesh in the order in which they are found.
class EdgeNumbers {
 public:
  explicit EdgeNumbers(Index cells) { numbers_.reserve(2 * static_cast<std::size_t>(cells)); }

  Index operator()(Index a, Index b) {
    const auto key = static_cast<std::uint64_t>(std::min(a, b)) << 32 | std::max(a, b);
    const auto [entry, is_new] = numbers_.try_emplace(key, static_cast<Index>(ends_.size()));
    if (is_new) ends_.push_back({a, b});
    return entry->second;
  }

  const std::vector<std::array<Index, 2>>& ends() const { return ends_; }

 private:
  std::unordered_map<std::uint64_t, Index> numbers_;
  std::vector<std::array<Index, 2>> ends_;
};

template <int Dim>
EdgeNumbers number_edges(const DomainMesh<Dim>& mesh) {
  EdgeNumbers numbers(mesh.num_cells());
  for (const auto& cell : mesh.cells.colwise()) {
    for (int k = 1; k <= Dim; ++k) {
      for (int l = 0; l < k; ++l) numbers(cell[l], cell[k]);
    }
  }
  return numbers;
}

// The vertices of a cell's corners (on the diagonal) and of the midpoints between them.
template <int Dim>
using Midpoints = Eigen::Matrix<Index, Dim + 1, Dim + 1>;

// The parts of a triangle that have none of its corners.
void cut_inside(const DomainMesh<2>&, const Midpoints<2>& mid, Eigen::Ref<CellList<2>> parts) {
  parts.col(0) << mid(1, 2), mid(0, 2), mid(0, 1);
}

// The four tetrahedra around the shortest diagonal of the octahedron.
void cut_inside(const DomainMesh<3>& refined, const Midpoints<3>& mid,
                Eigen::Ref<CellList<3>> parts) {
  // Per diagonal: its ends, then the other vertices around it.
  const std::array<std::array<Index, 6>, 3> cuts{{
      {mid(0, 1), mid(2, 3), mid(0, 2), mid(0, 3), mid(1, 3), mid(1, 2)},
      {mid(0, 2), mid(1, 3), mid(0, 1), mid(1, 2), mid(2, 3), mid(0, 3)},
      {mid(0, 3), mid(1, 2), mid(0, 1), mid(0, 2), mid(2, 3), mid(1, 3)},
  }};
  const auto length = [&](const auto& cut) {
    return (refined.points.col(cut[0]) - refined.points.col(cut[1])).squaredNorm();
  };
  const auto& cut = *std::min_element(cuts.begin(), cuts.end(), [&](const auto& a, const auto& b) {
    return length(a) < length(b);
  });
  for (int k = 0; k < 4; ++k) {
    parts.col(k) << cut[0], cut[1], cut[2 + k], cut[2 + (k + 1) % 4];
  }
}

}  // namespace

template <int Dim>
Index refined_vertices(const DomainMesh<Dim>& mesh) {
  return mesh.num_vertices() + static_cast<Index>(number_edges(mesh).ends().size());
}

template <int Dim>
DomainMesh<Dim> refine(const DomainMesh<Dim>& mesh) {
  const Index num_coarse = mesh.num_vertices();
  auto numbers = number_edges(mesh);
  DomainMesh<Dim> refined;
  refined.points.resize(Dim, num_coarse + static_cast<Index>(numbers.ends().size()));
  refined.points.leftCols(num_coarse) = mesh.points;
  for (std::size_t e = 0; e < numbers.ends().size(); ++e) {
    const auto [a, b] = numbers.ends()[e];
    refined.points.col(num_coarse + static_cast<Index>(e)) =
        (mesh.points.col(a) + mesh.points.col(b)) / 2;
  }
  refined.cells.resize(Dim + 1, kParts<Dim> * mesh.num_cells());
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    Midpoints<Dim> mid;
    for (int k = 0; k <= Dim; ++k) {
      mid(k, k) = mesh.cells(k, s);
      for (int l = 0; l < k; ++l) {
        mid(k, l) = mid(l, k) = num_coarse + numbers(mesh.cells(l, s), mesh.cells(k, s));
      }
    }
    auto parts = refined.cells.middleCols(kParts<Dim> * s, kParts<Dim>);
    parts.leftCols(Dim + 1) = mid;
    cut_inside(refined, mid, parts.rightCols(kParts<Dim> - Dim - 1));
  }
  return refined;
}

template <int Dim>
std::optional<CoarseMesh<Dim>> coarse_mesh(const DomainMesh<Dim>& mesh) {
  constexpr double kLeast = 0.1;  // of the measure of the parts
  const Index num_cells = mesh.num_cells() / kParts<Dim>;
  if (kParts<Dim> * num_cells != mesh.num_cells()) return {};
  CoarseMesh<Dim> coarse;
  coarse.mesh.cells.resize(Dim + 1, num_cells);
  for (Index s = 0; s < num_cells; ++s) {
    coarse.mesh.cells.col(s) =
        mesh.cells.template block<Dim + 1, Dim + 1>(0, kParts<Dim> * s).diagonal();
  }
  const Index num_coarse = coarse.mesh.cells.maxCoeff() + 1;
  coarse.mesh.points = mesh.points.leftCols(num_coarse);
  coarse.ends.assign(mesh.num_vertices(), {-1, -1});
  for (Index v = 0; v < num_coarse; ++v) coarse.ends[v] = {v, v};
  for (Index s = 0; s < num_cells; ++s) {
    const auto parts = mesh.cells.middleCols(kParts<Dim> * s, kParts<Dim>);
    double measure = 0;
    for (int part = 0; part < kParts<Dim>; ++part) {
      measure += signed_measure(mesh, kParts<Dim> * s + part);
      if (part > Dim && parts.col(part).minCoeff() < num_coarse) return {};
    }
    if (signed_measure(coarse.mesh, s) < kLeast * measure) return {};
    for (int k = 1; k <= Dim; ++k) {
      for (int l = 0; l < k; ++l) {
        const Index middle = parts(k, l);
        if (middle < num_coarse || middle != parts(l, k)) return {};
        auto ends = std::array{coarse.mesh.cells(l, s), coarse.mesh.cells(k, s)};
        if (ends[0] > ends[1]) std::swap(ends[0], ends[1]);
        if (coarse.ends[middle][0] < 0) coarse.ends[middle] = ends;
        if (coarse.ends[middle] != ends) return {};
      }
    }
  }
  return coarse;
}

FLBC_INSTANTIATE_FUNCTION(refined_vertices)
FLBC_INSTANTIATE_FUNCTION(refine)
FLBC_INSTANTIATE_FUNCTION(coarse_mesh)

}  // namespace flbc
