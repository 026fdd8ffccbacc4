// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Metrics, penalties and the textbook solver for tests of the splittings on the weights.
#pragma once

#include "solver/methods/splitting/metric.h"
#include "support/test.h"
#include "support/textbook_lbc2014.h"

namespace flbc::testing {

// Cells weighted by a power of their measure, vertices by something uneven.
template <int Dim>
splitting::Metric make_metric(const LbcProblem<Dim>& problem, double power, bool non_negative) {
  splitting::Metric metric;
  metric.cell.resize(problem.mesh.num_cells());
  for (Index s = 0; s < problem.mesh.num_cells(); ++s) {
    metric.cell[s] = std::pow(simplex_measure<Dim>(cell_corners(problem.mesh, s)), power);
  }
  if (non_negative) {
    const double typical = 250 * metric.cell.mean();
    metric.vertex = Eigen::VectorXd::LinSpaced(problem.mesh.num_vertices(), typical, 3 * typical);
  }
  return metric;
}

// A penalty that lets some balls of the Z-step be active and some not.
template <int Dim>
double make_penalty(const LbcProblem<Dim>& problem, const splitting::Metric& metric) {
  double volume = 0;
  for (Index s = 0; s < problem.mesh.num_cells(); ++s) {
    volume += simplex_measure<Dim>(cell_corners(problem.mesh, s));
  }
  return 0.02 * volume / metric.cell.sum();
}

template <int Dim>
TextbookLbc2014<Dim> textbook_for(const LbcProblem<Dim>& problem, const splitting::Metric& metric,
                                  double penalty, double relaxation, const WeightMatrix& start) {
  Lbc2014Input<Dim> input;
  input.control_points = problem.cage.points;
  input.mesh = problem.mesh;
  input.phi = problem.phi.dense();
  input.initial_weights = start;
  input.interior = problem.boundary.interior_vertices();
  input.cell_metric = metric.cell;
  input.vertex_metric = metric.vertex;
  input.penalty = penalty;
  input.relaxation = relaxation;
  input.smoothness = problem.smoothness;
  // The library starts with y = z + u = 0, so that u = -grad w.
  input.initial_z_dual.resize(start.rows(), Dim * problem.mesh.num_cells());
  for (Index s = 0; s < problem.mesh.num_cells(); ++s) {
    const auto corner_weights = columns_of(start, problem.mesh.cells.col(s));
    input.initial_z_dual.middleCols(Dim * s, Dim) =
        -linear_gradients<Dim>(cell_corners(problem.mesh, s), corner_weights).transpose();
  }
  return TextbookLbc2014<Dim>(std::move(input));
}

}  // namespace flbc::testing
