// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Constants of the compact splitting, in the layout of the inner loops.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/aligned_array.h"
#include "base/parallel.h"
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
  AlignedArray<Scalar> radius;
  std::vector<Scalar> vertex_metric;  // empty: w may be negative
  AlignedArray<Scalar> basis;
  std::vector<Scalar> row_target;
};

//! u, chosen so that radii are about 8 and at most 1000.
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
template <class Scalar, int Dim>
CompactData<Scalar, Dim> make_rows_and_cells(const LbcProblem<Dim>& problem,
                                             const splitting::Metric& metric,
                                             const std::vector<Index>& position);

//! The constraints { sum w = 1, sum w c = x } of every row. \param stride  values per row
template <class Scalar, int Dim>
void set_constraints(const LbcProblem<Dim>& problem, std::size_t stride,
                     CompactData<Scalar, Dim>& data);

//! Stores values of all cells in slices, `Rows` per control point.
//! \param of_cell  n x Rows values of a cell of the mesh
template <int Rows, class Scalar, int Dim, class OfCell>
void store_in_cells(const CompactData<Scalar, Dim>& data, const splitting::ColumnSlices& slices,
                    AlignedArray<Scalar>& stored, const OfCell& of_cell) {
  const std::size_t num_rows = data.cells.size() * Rows;
  parallel_for(data.cells.size(), [&](std::size_t k) {
    const Eigen::Matrix<double, Eigen::Dynamic, Rows> values = of_cell(data.cell_index[k]);
    const auto n = static_cast<std::size_t>(values.rows());
    for (int r = 0; r < Rows; ++r) {
      slices.for_each(k * Rows + r, num_rows,
                      [&](std::size_t begin, std::size_t width, std::size_t place) {
                        for (std::size_t i = begin; i < std::min(n, begin + width); ++i) {
                          stored[place + i - begin] = static_cast<Scalar>(values(i, r));
                        }
                      });
    }
  });
}

}  // namespace flbc::compact
