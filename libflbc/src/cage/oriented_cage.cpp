// SPDX-License-Identifier: BSD-3-Clause
#include "cage/oriented_cage.h"

#include <array>
#include <utility>

#include <Eigen/LU>

#include "cage/point_in_cage.h"

namespace flbc {
namespace {

// Orients the edges of a loop consistently; the input may have any directions.
void align_edges(Cage<2>& cage) {
  std::vector<std::array<Index, 2>> edges_at(cage.size(), {-1, -1});
  for (Index edge = 0; edge < cage.facets.cols(); ++edge) {
    for (const Index vertex : cage.facets.col(edge)) {
      auto& edges = edges_at[vertex];
      edges[edges[0] < 0 ? 0 : 1] = edge;
    }
  }
  std::vector<bool> is_aligned(cage.facets.cols(), false);
  for (Index first = 0; first < cage.facets.cols(); ++first) {
    // An open loop ends at -1.
    for (Index edge = first; edge >= 0 && !is_aligned[edge];) {
      is_aligned[edge] = true;
      const Index end = cage.facets(1, edge);
      const auto& edges = edges_at[end];
      edge = edges[0] == edge ? edges[1] : edges[0];
      if (edge >= 0 && !is_aligned[edge] && cage.facets(0, edge) != end) {
        std::swap(cage.facets(0, edge), cage.facets(1, edge));
      }
    }
  }
}

// Signed measure of the cone or pyramid over a facet. A nearby apex keeps the sum accurate if the
// cage is far from the origin.
template <int Dim>
double cone_measure(const Cage<Dim>& cage, Index facet, const Vector<Dim>& apex) {
  Eigen::Matrix<double, Dim, Dim> edges;
  for (int k = 0; k < Dim; ++k) edges.col(k) = cage.points.col(cage.facets(k, facet)) - apex;
  return edges.determinant() / (Dim == 2 ? 2 : 6);
}

// Whether an odd number of other shells enclose the shell. Shells do not intersect, so one corner
// decides.
template <int Dim>
bool is_in_others(const OrientedCage<Dim>& oriented, Index shell, Index facet_of_shell) {
  const auto& all = oriented.cage;
  Cage<Dim> others{all.points, FacetList<Dim>(Dim, all.facets.cols())};
  Index count = 0;
  for (Index f = 0; f < all.facets.cols(); ++f) {
    if (oriented.shell_of_facet[f] != shell) others.facets.col(count++) = all.facets.col(f);
  }
  others.facets.conservativeResize(Dim, count);
  const CageLocator<Dim> locator(others, 0);
  return locator.locate(all.points.col(all.facets(0, facet_of_shell))) == Containment::kInside;
}

}  // namespace

template <int Dim>
OrientedCage<Dim> orient(const Cage<Dim>& cage) {
  OrientedCage<Dim> oriented{cage, facet_shells(cage), {}, 0};
  if constexpr (Dim == 2) align_edges(oriented.cage);
  auto& facets = oriented.cage.facets;
  const auto& shell_of_facet = oriented.shell_of_facet;

  std::vector<Index> first_facet;
  std::vector<double> measure;
  const Vector<Dim> apex = cage.points.col(facets(0, 0));
  for (Index f = 0; f < facets.cols(); ++f) {
    if (shell_of_facet[f] == static_cast<Index>(measure.size())) {
      first_facet.push_back(f);
      measure.push_back(0);
    }
    measure[shell_of_facet[f]] += cone_measure(oriented.cage, f, apex);
  }
  const auto num_shells = static_cast<Index>(measure.size());
  for (Index shell = 0; shell < num_shells; ++shell) {
    oriented.is_hole.push_back(num_shells > 1 && is_in_others(oriented, shell, first_facet[shell]));
    oriented.measure +=
        oriented.is_hole[shell] ? -std::abs(measure[shell]) : std::abs(measure[shell]);
  }
  for (Index f = 0; f < facets.cols(); ++f) {
    const Index shell = shell_of_facet[f];
    if ((measure[shell] < 0) != oriented.is_hole[shell]) std::swap(facets(0, f), facets(1, f));
  }
  return oriented;
}

template OrientedCage<2> orient(const Cage<2>&);
template OrientedCage<3> orient(const Cage<3>&);

}  // namespace flbc
