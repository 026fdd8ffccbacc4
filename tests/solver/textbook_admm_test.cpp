// SPDX-License-Identifier: BSD-3-Clause
// Tests of the reference implementation, the textbook solver.
#include "support/textbook_admm.h"
#include "support/harmonic_weights.h"
#include "support/test.h"

namespace flbc::testing {
namespace {

using Eigen::MatrixXd;

template <int Dim>
MatrixXd cell_gradients(const DomainMesh<Dim>& mesh, const MatrixXd& weights, Index cell) {
  return linear_gradients<Dim>(cell_corners(mesh, cell), columns_of(weights, mesh.cells.col(cell)));
}

// A weight function that differs between control points and cells.
template <int Dim>
MatrixXd distance_phi(const Sample<Dim>& sample) {
  MatrixXd phi(sample.cage.size(), sample.mesh.num_cells());
  for (Index s = 0; s < sample.mesh.num_cells(); ++s) {
    const Vector<Dim> centre = cell_corners(sample.mesh, s).rowwise().mean();
    for (Index i = 0; i < sample.cage.size(); ++i) {
      phi(i, s) = (centre - sample.cage.points.col(i)).norm() / 2;
    }
  }
  return phi;
}

template <int Dim>
TextbookInput<Dim> textbook_input(const Sample<Dim>& sample, const MatrixXd& start) {
  TextbookInput<Dim> input;
  input.control_points = sample.cage.points;
  input.mesh = sample.mesh;
  input.phi = distance_phi(sample);
  input.boundary_weights = demanded_boundary_weights(sample.cage, sample.mesh);
  input.penalty = 0.2;
  for (Index s = 0; s < sample.mesh.num_cells(); ++s) {
    input.initial_gradients.push_back(cell_gradients(sample.mesh, start, s));
  }
  return input;
}

// (8) in each cell; (9) and (10) along the edges of facets, where g . (x_b - x_a) is the rise of w.
template <int Dim>
double constraint_violation(const TextbookInput<Dim>& input, const TextbookAdmm<Dim>& solver) {
  double worst = 0;
  for (Index s = 0; s < input.mesh.num_cells(); ++s) {
    const MatrixXd g = solver.gradient(s);
    const MatrixXd reproduced = input.control_points * g.transpose();
    worst = std::max(worst, g.rowwise().sum().norm());
    worst = std::max(worst, (reproduced - MatrixXd::Identity(Dim, Dim)).norm());
  }
  for (const auto& [facet, cells] : cells_by_facet(input.mesh)) {
    for (int k = 1; k < Dim; ++k) {
      const Vector<Dim> step = input.mesh.points.col(facet[k]) - input.mesh.points.col(facet[0]);
      const Eigen::VectorXd rise = solver.gradient(cells[0]).transpose() * step;
      const Eigen::VectorXd demanded =
          cells.size() == 2
              ? Eigen::VectorXd(solver.gradient(cells[1]).transpose() * step)
              : input.boundary_weights.col(facet[k]) - input.boundary_weights.col(facet[0]);
      worst = std::max(worst, (rise - demanded).norm());
    }
  }
  return worst;
}

// To nearly machine precision; the limit is far beyond what any of the samples needs.
template <int Dim>
void converge(TextbookAdmm<Dim>& solver) {
  for (int k = 0; k < 30000; ++k) {
    solver.iterate();
    if (solver.primal_residual_norm() < 1e-9 && solver.dual_residual_norm() < 1e-9) return;
  }
}

template <int Dim>
std::vector<Sample<Dim>> smallest_samples() {
  return {make_sample<Dim>(Shape::kBox, Dim == 2 ? 4 : 2, 0.2),
          make_sample<Dim>(Shape::kCorner, Dim == 2 ? 3 : 2),
          make_sample<Dim>(Shape::kStar, 2, 0.2)};
}

// Stationarity of the Lagrangian in G, Z, X and Y: with feasibility, this proves the optimum of the
// convex problem (7)-(10), by relations that no step of the iteration computes.
TEST_IN_2D_AND_3D(TextbookTest, EndsInAPointThatIsOptimal) {
  for (const auto& sample : smallest_samples<Dim>()) {
    SCOPED_TRACE(sample.name);
    const auto input = textbook_input<Dim>(sample, harmonic_weights(sample));
    TextbookAdmm<Dim> solver(input);
    converge(solver);
    std::vector<MatrixXd> sums;
    double moving = 0;  // sum of phi A |z| over nonzero z, so that the check below is not empty
    for (Index s = 0; s < sample.mesh.num_cells(); ++s) {
      sums.push_back(solver.lambda_z(s));
      const double measure = simplex_measure<Dim>(cell_corners(sample.mesh, s));
      for (Index i = 0; i < sample.cage.size(); ++i) {
        const double bound = input.phi(i, s) * measure;
        const Vector<Dim> z = solver.z(s).col(i);
        const Vector<Dim> lambda = solver.lambda_z(s).col(i);
        EXPECT_LE(lambda.norm(), bound + 1e-7);
        EXPECT_NEAR(lambda.dot(z), -bound * z.norm(), 1e-7);
        moving += bound * z.norm();
      }
    }
    EXPECT_NEAR(moving, solver.objective(), 1e-7);
    const auto& boundary = solver.boundary_facets();
    for (std::size_t b = 0; b < boundary.size(); ++b) {
      const auto P =
          tangent_projector<Dim>(corners_of<Dim>(input.mesh.points, boundary[b].vertices));
      const MatrixXd lambda = solver.lambda_x(static_cast<Index>(b));
      EXPECT_LT((lambda - P * lambda).norm(), 1e-7);
      sums[boundary[b].cells[0]] += lambda;
    }
    const auto& inner = solver.interior_facets();
    for (std::size_t e = 0; e < inner.size(); ++e) {
      const auto P = tangent_projector<Dim>(corners_of<Dim>(input.mesh.points, inner[e].vertices));
      const MatrixXd lambda = solver.lambda_y(static_cast<Index>(e), 0);
      const MatrixXd other = solver.lambda_y(static_cast<Index>(e), 1);
      EXPECT_LT((lambda - P * lambda).norm(), 1e-7);
      EXPECT_LT((lambda + other).norm(), 1e-7);
      sums[inner[e].cells[0]] += lambda;
      sums[inner[e].cells[1]] += other;
    }
    MatrixXd rows(sample.cage.size(), Dim + 1);  // what the constraints (8) can balance
    rows << Eigen::VectorXd::Ones(sample.cage.size()), sample.cage.points.transpose();
    for (const MatrixXd& sum : sums) {
      const MatrixXd target = sum.transpose();
      EXPECT_LT((rows * least_squares(rows, target) - target).norm(), 1e-7);
    }
  }
}

TEST_IN_2D_AND_3D(TextbookTest, ResidualsAreThoseOfThePaper) {
  const auto sample = make_sample<Dim>(Shape::kStar, 2, 0.2);
  const auto input = textbook_input<Dim>(sample, harmonic_weights(sample));
  TextbookAdmm<Dim> solver(input);
  for (int k = 0; k < 3; ++k) solver.iterate();
  std::vector<MatrixXd> before;
  for (Index s = 0; s < sample.mesh.num_cells(); ++s) before.push_back(solver.gradient(s));
  solver.iterate();

  double primal = 0;
  double dual = 0;
  Eigen::Index components = 0;
  const auto add_copy = [&](const MatrixXd& copy, Index cell) {
    primal += (copy - solver.gradient(cell)).squaredNorm();
    dual += (solver.gradient(cell) - before[cell]).squaredNorm();
    components += copy.size();
  };
  for (Index s = 0; s < sample.mesh.num_cells(); ++s) add_copy(solver.z(s), s);
  Index number = 0;
  for (const auto& facet : solver.boundary_facets()) add_copy(solver.x(number++), facet.cells[0]);
  number = 0;
  for (const auto& facet : solver.interior_facets()) {
    for (const int side : {0, 1}) add_copy(solver.y(number, side), facet.cells[side]);
    ++number;
  }
  EXPECT_GT(primal, 1e-6);
  EXPECT_GT(dual, 1e-6);
  EXPECT_NEAR(solver.primal_residual_norm(), std::sqrt(primal), 1e-12);
  EXPECT_NEAR(solver.dual_residual_norm(), input.penalty * std::sqrt(dual), 1e-12);
  EXPECT_EQ(solver.num_residual_components(), components);
  // A copy for each cell and for each side of a facet that faces a cell.
  EXPECT_EQ(components,
            Eigen::Index{Dim} * sample.cage.size() * (Dim + 2) * sample.mesh.num_cells());
}

}  // namespace
}  // namespace flbc::testing
