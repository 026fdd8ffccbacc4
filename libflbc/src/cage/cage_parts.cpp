// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/cage_facts.h"

#include <algorithm>
#include <utility>

#include "cage/oriented_cage.h"
#include "cage/point_in_cage.h"

namespace flbc {
namespace {

// The part of a cage that has these facets.
template <int Dim>
CagePart<Dim> extract(const Cage<Dim>& cage, const std::vector<Index>& facets) {
  CagePart<Dim> part;
  std::vector<Index> number(cage.size(), -1);
  for (const Index f : facets) {
    for (const Index i : cage.facets.col(f)) number[i] = 0;
  }
  for (Index i = 0; i < cage.size(); ++i) {
    if (number[i] < 0) continue;
    number[i] = static_cast<Index>(part.control_points.size());
    part.control_points.push_back(i);
  }
  part.cage = {cage.points(Eigen::all, part.control_points), cage.facets(Eigen::all, facets)};
  for (Index& corner : part.cage.facets.reshaped()) corner = number[corner];
  return part;
}

// Which shells enclose which.
template <int Dim>
class Nesting {
 public:
  explicit Nesting(const OrientedCage<Dim>& oriented) {
    std::vector<std::vector<Index>> facets_of_shell(oriented.is_hole.size());
    for (std::size_t f = 0; f < oriented.shell_of_facet.size(); ++f) {
      facets_of_shell[oriented.shell_of_facet[f]].push_back(static_cast<Index>(f));
    }
    for (const auto& facets : facets_of_shell) {
      auto shell = extract(oriented.cage, facets).cage;
      corners_.push_back(shell.points.col(0));
      shells_.emplace_back(std::move(shell), 0);
    }
  }

  // Shells do not meet, so one corner decides.
  bool encloses(std::size_t outer, std::size_t inner) const {
    return outer != inner && shells_[outer].locate(corners_[inner]) == Containment::kInside;
  }

 private:
  std::vector<CageLocator<Dim>> shells_;
  std::vector<Vector<Dim>> corners_;
};

// Per shell the outer one that bounds the same part: itself, or of those around a hole the
// innermost.
template <int Dim>
std::vector<std::size_t> outer_shells(const OrientedCage<Dim>& oriented) {
  const Nesting<Dim> nesting(oriented);
  const auto num_shells = oriented.is_hole.size();
  std::vector<std::size_t> outer(num_shells);
  for (std::size_t shell = 0; shell < num_shells; ++shell) {
    outer[shell] = shell;
    if (!oriented.is_hole[shell]) continue;
    for (std::size_t other = 0; other < num_shells; ++other) {
      if (oriented.is_hole[other] || !nesting.encloses(other, shell)) continue;
      if (outer[shell] == shell || nesting.encloses(outer[shell], other)) outer[shell] = other;
    }
  }
  return outer;
}

}  // namespace

template <int Dim>
std::vector<CagePart<Dim>> cage_parts(const Cage<Dim>& cage) {
  const auto oriented = orient(cage);
  const auto outer = outer_shells(oriented);
  std::vector<std::vector<Index>> facets_of_part(outer.size());  // by outer shell
  for (Index f = 0; f < cage.facets.cols(); ++f) {
    facets_of_part[outer[oriented.shell_of_facet[f]]].push_back(f);
  }
  std::vector<CagePart<Dim>> parts;
  for (const auto& facets : facets_of_part) {
    if (!facets.empty()) parts.push_back(extract(cage, facets));
  }
  std::sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) {
    return a.control_points.front() < b.control_points.front();
  });
  return parts;
}

template std::vector<CagePart<2>> cage_parts(const Cage<2>&);
template std::vector<CagePart<3>> cage_parts(const Cage<3>&);

}  // namespace flbc
