// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Constants of the compact splitting, in the layout of the inner loops.
#pragma once

#include <cmath>
#include <vector>

#include "base/aligned_array.h"
#include "flbc/lbc_problem.h"
#include "mesh/cell_geometry.h"
#include "solver/methods/splitting/column_slices.h"
#include "solver/methods/splitting/compact_kernel.h"
#include "solver/methods/splitting/metric.h"

namespace flbc::compact {

//! Arrays of compact_kernel.h, with the shapes given there.
template <class Scalar, int Dim>
struct CompactData {
  std::vector<Index> vertices;  // interior vertices in the order of the factor
  std::vector<Index> row_of;    // V: the row of a vertex; the boundary follows the interior
  std::vector<Cell<Scalar, Dim>> cells;
  std::vector<Index> cell_index;
  AlignedArray<unsigned char> radius;  // in the storage format of the loops
  double boundary_dual2 = 0;           // squared radii of the cells without interior corners
  std::vector<Scalar> vertex_metric;   // empty: w may be negative
  AlignedArray<Scalar> basis;
  std::vector<Scalar> row_target;
};

//! u, chosen so that radii are about 8 and at most 1000, which keeps P within half precision.
template <int Dim>
double radius_unit(const LbcProblem<Dim>& problem, const splitting::Metric& metric);

//! P of a cell relative to its flux density p / A, u A / sqrt(m); times phi it is the radius.
template <int Dim>
double dual_scale(const LbcProblem<Dim>& problem, const splitting::Metric& metric, double unit,
                  Index cell) {
  return unit * cell_geometry(problem.mesh, cell).measure / std::sqrt(metric.cell[cell]);
}

//! theta, what the z-step keeps of its argument. \param penalty  rho
template <int Dim>
double smoothing(const LbcProblem<Dim>& problem, double penalty) {
  return problem.smoothness / (penalty + problem.smoothness);
}

//! phi of a cell may be nearly zero, but radii must not be denormal.
constexpr double kSmallestPhi = 1e-10;

//! Everything except the radii and the constraints.
//! \param position  the row of every unknown in the arrays of the linear solver
//! \param unit  u: a radius is u phi A / sqrt(m)
template <class Scalar, int Dim>
CompactData<Scalar, Dim> make_rows_and_cells(const LbcProblem<Dim>& problem,
                                             const splitting::Metric& metric,
                                             const std::vector<Index>& position, double unit);

//! The constraints { sum w = 1, sum w c = x } of every row. \param stride  values per row
template <class Scalar, int Dim>
void set_constraints(const LbcProblem<Dim>& problem, std::size_t stride,
                     CompactData<Scalar, Dim>& data);

//! The radii in slices, in the storage format of the loops.
template <class Scalar, int Dim>
void set_radii(const LbcProblem<Dim>& problem, const splitting::Metric& metric, double unit,
               const splitting::ColumnSlices& slices, const Loops<Scalar, Dim>& loops,
               CompactData<Scalar, Dim>& data);

}  // namespace flbc::compact
