// SPDX-License-Identifier: BSD-3-Clause
#include "solver/multilevel/level_sizes.h"

#include <algorithm>

namespace flbc {
namespace {

// Where a coarse start pays, and how coarse it may get, as measured (docs/results.md). It saves
// iterations: those of kGradient are many, and the more the finer the mesh; those of kValue are
// few, so that a coarse mesh must cost little: a tenth of the vertices, and once. So do those of
// kLbc2014, whose iterations are as dear.
struct Worthwhile {
  double numbers;  // least number of vertices times control points
  Index coarsest;  // vertices
  double factor;   // from mesh to mesh
};

Worthwhile worthwhile(int dim, Method method, bool on_supports) {
  if (method == Method::kGradient) return {0, dim == 2 ? 200 : 2000, 5};
  // Supports from a coarse mesh need no extension, and iterations from there are a third as many.
  if (on_supports) return {4e5, 500, 12};
  return {dim == 2 ? 2.5e5 : 7e5, dim == 2 ? 900 : 1000, dim == 2 ? 10.0 : 12.0};
}

}  // namespace

template <int Dim>
std::vector<Index> level_sizes(Index finest, Index control_points, Method method, bool on_supports,
                               const CoarseLevels& levels) {
  const auto limits = worthwhile(Dim, method, on_supports);
  const double factor = levels.factor == 0 ? limits.factor : levels.factor;
  Index coarsest = levels.coarsest;
  if (coarsest == 0) {
    if (static_cast<double>(finest) * control_points < limits.numbers) return {};
    coarsest = limits.coarsest;
  }
  std::vector<Index> sizes;
  double size = finest / factor;
  while (size >= coarsest) {
    sizes.push_back(static_cast<Index>(size));
    size /= factor;
  }
  // Who asks for coarser meshes gets one.
  const bool is_asked_for = levels.coarsest > 0 && levels.factor == 0;
  if (sizes.empty() && is_asked_for && finest >= 2 * coarsest) sizes.push_back(coarsest);
  std::reverse(sizes.begin(), sizes.end());
  return sizes;
}

template std::vector<Index> level_sizes<2>(Index, Index, Method, bool, const CoarseLevels&);
template std::vector<Index> level_sizes<3>(Index, Index, Method, bool, const CoarseLevels&);

}  // namespace flbc
