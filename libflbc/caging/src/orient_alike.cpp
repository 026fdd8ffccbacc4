// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "caging/repair_steps.h"
#include "caging/ridges.h"

namespace flbc {

namespace {

// Whether a triangle traverses an edge from its smaller to its larger end.
bool runs_forward(const FacetCorners<3>& corners, const Ridge<3>& edge) {
  for (int k = 0; k < 3; ++k) {
    if (corners(k) == edge[0]) return corners((k + 1) % 3) == edge[1];
  }
  return false;
}

// A shell, with its triangles of orientation opposite to the first.
struct Shell {
  std::vector<Index> facets{}, reversed{};
};

// Traverses edges shared by two triangles.
Shell collect_shell(const CageDraft<3>& draft, const RidgeMap<3>& ridges, Index first,
                    std::vector<bool>& is_seen) {
  Shell shell;
  std::map<Index, bool> is_reversed{{first, false}};
  shell.facets.push_back(first);
  is_seen[first] = true;
  for (std::size_t next = 0; next < shell.facets.size(); ++next) {
    const Index f = shell.facets[next];
    const auto& corners = draft.facets[f].corners;
    for (int k = 0; k < 3; ++k) {
      const auto edge = ridge_of<3>(corners, k);
      const auto& meeting = ridges.at(edge);
      if (meeting.size() != 2) continue;
      const Index other = meeting[0] == f ? meeting[1] : meeting[0];
      if (is_seen[other]) continue;
      is_seen[other] = true;
      shell.facets.push_back(other);
      const bool same =
          runs_forward(corners, edge) == runs_forward(draft.facets[other].corners, edge);
      is_reversed[other] = is_reversed[f] != same;
    }
  }
  for (const auto& [f, reversed] : is_reversed) {
    if (reversed) shell.reversed.push_back(f);
  }
  return shell;
}

}  // namespace

void orient_alike(CageDraft<2>&) {
}

void orient_alike(CageDraft<3>& draft) {
  const auto ridges = collect_ridges(draft);
  std::vector<bool> is_seen(draft.facets.size(), false);
  for (Index f = 0; f < static_cast<Index>(draft.facets.size()); ++f) {
    if (is_seen[f]) continue;
    const Shell shell = collect_shell(draft, ridges, f, is_seen);
    std::vector<bool> is_turned(draft.facets.size(), false);
    for (const Index other : shell.reversed) is_turned[other] = true;
    const bool most_are = 2 * shell.reversed.size() > shell.facets.size();
    for (const Index other : shell.facets) {
      if (is_turned[other] == most_are) continue;
      auto& facet = draft.facets[other];
      std::swap(facet.corners(0), facet.corners(1));
      draft.changes.push_back("triangle " + std::to_string(facet.number) + " is reversed");
    }
  }
}

}  // namespace flbc
