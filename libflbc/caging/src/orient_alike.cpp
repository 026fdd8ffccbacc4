// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
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

}  // namespace

void orient_alike(CageDraft<2>&) {
}

void orient_alike(CageDraft<3>& draft) {
  const auto ridges = collect_ridges(draft);
  const std::size_t count = draft.facets.size();
  std::vector<bool> is_seen(count, false), is_reversed(count, false);  // relative to the first
  for (Index first = 0; first < static_cast<Index>(count); ++first) {
    if (is_seen[first]) continue;
    is_seen[first] = true;
    // A shell is connected by edges of two triangles.
    std::vector<Index> shell{first};
    for (std::size_t next = 0; next < shell.size(); ++next) {
      const Index f = shell[next];
      const auto& corners = draft.facets[f].corners;
      for (int k = 0; k < 3; ++k) {
        const auto edge = ridge_of<3>(corners, k);
        const auto& meeting = ridges.at(edge);
        if (meeting.size() != 2) continue;
        const Index other = meeting[0] == f ? meeting[1] : meeting[0];
        if (is_seen[other]) continue;
        is_seen[other] = true;
        shell.push_back(other);
        const bool same =
            runs_forward(corners, edge) == runs_forward(draft.facets[other].corners, edge);
        is_reversed[other] = is_reversed[f] != same;
      }
    }
    const auto num_reversed =
        std::count_if(shell.begin(), shell.end(), [&](Index f) { return is_reversed[f]; });
    const bool most_are = 2 * static_cast<std::size_t>(num_reversed) > shell.size();
    for (const Index f : shell) {
      if (is_reversed[f] == most_are) continue;
      auto& facet = draft.facets[f];
      std::swap(facet.corners(0), facet.corners(1));
      draft.changes.push_back("triangle " + std::to_string(facet.number) + " is reversed");
    }
  }
}

}  // namespace flbc
