// SPDX-License-Identifier: BSD-3-Clause
#include "coarse_to_fine/level_sizes.h"

#include <algorithm>
#include <limits>

namespace flbc {
namespace {

// Where a coarse start pays, and how coarse it may get, as measured (docs/results.md). It saves
// iterations: those of kGradient are many, and the more the finer the mesh; those of kValue are
// few, so that they have to be expensive. In 3D coarse meshes tell less, and what they get wrong
// takes long to disappear: up to 40,000 vertices kValue gains nothing there.
struct Worthwhile {
  double numbers;  // least number of vertices times control points
  Index coarsest;  // vertices
};

Worthwhile worthwhile(int dim, Method method) {
  if (method == Method::kGradient) return {0, dim == 2 ? 200 : 2000};
  return {dim == 2 ? 4e5 : std::numeric_limits<double>::infinity(), 2000};
}

}  // namespace

template <int Dim>
std::vector<Index> level_sizes(Index finest, Index control_points, Method method,
                               const CoarseLevels& levels) {
  Index coarsest = levels.coarsest;
  if (coarsest == 0) {
    const auto limits = worthwhile(Dim, method);
    if (static_cast<double>(finest) * control_points < limits.numbers) return {};
    coarsest = limits.coarsest;
  }
  std::vector<Index> sizes;
  for (double size = finest / levels.factor; size >= coarsest; size /= levels.factor) {
    sizes.push_back(static_cast<Index>(size));
  }
  std::reverse(sizes.begin(), sizes.end());
  return sizes;
}

template std::vector<Index> level_sizes<2>(Index, Index, Method, const CoarseLevels&);
template std::vector<Index> level_sizes<3>(Index, Index, Method, const CoarseLevels&);

}  // namespace flbc
