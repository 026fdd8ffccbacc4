// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/certificate.h"

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/shape_checks.h"
#include "base/stage_progress.h"
#include "flbc/errors.h"
#include "flbc/quality.h"
#include "mesh/cell_geometry.h"
#include "mesh/vertex_cells.h"
#include "polytope/project_columns.h"
#include "polytope/vertex_linear_program.h"
#include "polytope/weight_projection.h"

namespace flbc {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// A sum with a bound on its rounding error.
struct Rounded {
  double value = 0;
  double magnitude = 0;  // sum of the absolute values of all terms
};

// The same over all vertices.
struct LongRounded {
  long double value = 0;
  long double magnitude = 0;

  void add(double term) {
    value += term;
    magnitude += std::abs(term);
  }
  LongRounded& operator+=(const LongRounded& other) {
    value += other.value;
    magnitude += other.magnitude;
    return *this;
  }
  // For any grouping, each term takes part in fewer than `count` additions.
  long double rounded_down(Index count) const {
    constexpr auto kLongEpsilon = std::numeric_limits<long double>::epsilon();
    return value - 2 * static_cast<long double>(count) * kLongEpsilon * magnitude;
  }
};

// The flux in double precision. Without smoothness it is shortened so that |p| <= phi A.
template <class Scalar, int Dim>
class AdmissibleFlux {
 public:
  AdmissibleFlux(const LbcProblem<Dim>& problem, const CellFieldView<Scalar, Dim>& flux)
      : problem_(problem), flux_(flux), around_(problem.mesh) {}

  // Calls body(s, geometry, corner) for the cells s at a vertex.
  template <class Body>
  Index for_cells_at(Index vertex, const Body& body) const {
    Index count = 0;
    for (const Index s : around_.cells_of(vertex)) {
      int corner = 0;
      while (problem_.mesh.cells(corner, s) != vertex) ++corner;
      body(s, cell_geometry(problem_.mesh, s), corner);
      ++count;
    }
    return count;
  }

  // Adds p_s^i . grad(lambda).
  void add(Index s, const CellGeometry<Dim>& geometry, int corner, Index i, Rounded& sum) const {
    const Scalar* p = at(s, i);
    double length2 = 0, product = 0, magnitude = 0;
    for (int d = 0; d < Dim; ++d) {
      const double component = static_cast<double>(p[d * flux_.stride]);
      const double term = component * geometry.hat_gradients(d, corner);
      length2 += component * component;
      product += term;
      magnitude += std::abs(term);
    }
    // Squares that overflow, or NaN, make the flux zero.
    if (!(length2 < std::numeric_limits<double>::infinity())) return;
    double factor = 1;
    if (problem_.smoothness == 0) {
      // Slightly shorter than the limit, so that rounding cannot make it longer.
      const double radius = (1 - 4 * kEpsilon) * problem_.phi(i, s) * geometry.measure;
      // Squares that underflow must not count as zero.
      constexpr double kLeastRadius = 1e-140;
      if (!(radius > kLeastRadius)) return;
      if (length2 > radius * radius) factor = radius / std::sqrt(length2);
    }
    sum.value += factor * product;
    sum.magnitude += factor * magnitude;
  }

  // C(p) of a cell, rounded up.
  double conjugate(Index s) const {
    constexpr double kUp = 1 + 8 * kEpsilon;
    constexpr double kDown = 1 - 8 * kEpsilon;
    const double measure = cell_geometry(problem_.mesh, s).measure;
    double sum = 0;
    for (Index i = 0; i < flux_.n; ++i) {
      const Scalar* p = at(s, i);
      double length2 = 0;
      for (int d = 0; d < Dim; ++d) {
        const double component = static_cast<double>(p[d * flux_.stride]);
        length2 += component * component;
      }
      if (!(length2 < std::numeric_limits<double>::infinity())) continue;
      const double excess = kUp * std::sqrt(length2) / measure - kDown * problem_.phi(i, s);
      if (excess > 0) sum += excess * excess;
    }
    const double rounding = 1 + (flux_.n + 8) * kEpsilon;
    return rounding * measure / (2 * problem_.smoothness) * sum;
  }

  // Rounding errors in a sum over the cells at a vertex.
  static double slack(const Rounded& sum, Index num_cells) {
    return (num_cells + 4 * Dim) * kEpsilon * sum.magnitude;
  }

 private:
  const Scalar* at(Index s, Index i) const {
    return flux_.data + static_cast<std::size_t>(s) * Dim * flux_.stride + i;
  }

  const LbcProblem<Dim>& problem_;
  const CellFieldView<Scalar, Dim>& flux_;
  VertexCells around_;
};

// sum_i w_i D p_i with the known weights, rounded down.
template <class Scalar, int Dim>
double boundary_share(const LbcProblem<Dim>& problem, const AdmissibleFlux<Scalar, Dim>& flux,
                      Index vertex) {
  const Index b = problem.boundary.boundary_index[vertex];
  std::array<Rounded, Dim> sums{};
  const Index num_cells =
      flux.for_cells_at(vertex, [&](Index s, const CellGeometry<Dim>& geometry, int corner) {
        for (int k = 0; k < Dim; ++k) {
          flux.add(s, geometry, corner, problem.boundary.control_points(k, b), sums[k]);
        }
      });
  double share = 0;
  for (int k = 0; k < Dim; ++k) {
    const double weight = problem.boundary.values(k, b);
    share += weight * sums[k].value - 2 * std::abs(weight) * flux.slack(sums[k], num_cells);
  }
  return share;
}

// D p(v), rounded down, so that its product with weights >= 0 does not exceed the exact value.
template <class Scalar, int Dim>
void vertex_costs(const AdmissibleFlux<Scalar, Dim>& flux, Index vertex, std::vector<Rounded>& sums,
                  Eigen::VectorXd& costs) {
  sums.assign(sums.size(), {});
  const auto n = static_cast<Index>(sums.size());
  const Index num_cells =
      flux.for_cells_at(vertex, [&](Index s, const CellGeometry<Dim>& geometry, int corner) {
        for (Index i = 0; i < n; ++i) flux.add(s, geometry, corner, i, sums[i]);
      });
  for (Index i = 0; i < n; ++i) costs[i] = sums[i].value - flux.slack(sums[i], num_cells);
}

template <class Scalar, int Dim>
void check_flux(const LbcProblem<Dim>& problem, const CellFieldView<Scalar, Dim>& flux) {
  const Index n = problem.num_control_points();
  if (flux.n != n || flux.stride < static_cast<std::size_t>(n)) {
    throw InputError("a flux for " + std::to_string(flux.n) +
                     " control points does not match a cage with " + std::to_string(n));
  }
  check_phi(problem.phi, n, problem.mesh.num_cells());
}

// The weights with the known values on the boundary and feasible columns inside.
template <int Dim>
SparseWeights made_feasible(const LbcProblem<Dim>& problem, const WeightMatrix& weights) {
  const StageScope silent({});  // progress is reported by the bound below
  const auto& boundary = problem.boundary;
  return project_columns<Dim>(
      problem.cage.points, problem.mesh.points, boundary.interior_vertices(),
      [&](Index v) -> Eigen::VectorXd {
        if (boundary.is_interior(v)) return weights.col(v);
        Eigen::VectorXd known = Eigen::VectorXd::Zero(weights.rows());
        boundary.scatter(boundary.boundary_index[v], known);
        return known;
      },
      problem.masks);
}

// \param multipliers  receives those of the interior vertices
template <class Scalar, int Dim>
double bound(const LbcProblem<Dim>& problem, const CellFieldView<Scalar, Dim>& flux,
             const SparseWeights& weights, PointList<Dim>* multipliers) {
  check_flux(problem, flux);
  check_size(weights, problem.num_control_points(), problem.mesh.num_vertices());
  const AdmissibleFlux<Scalar, Dim> admissible(problem, flux);
  LoopProgress progress(problem.mesh.num_vertices());
  // In long double, so that the sum over vertices has negligible error.
  const auto sum =
      parallel_sum(problem.mesh.num_vertices(), LongRounded{}, [&](Index begin, Index end) {
        VertexLinearProgram<Dim> program(problem.cage.points);
        std::vector<Rounded> sums(flux.n);
        Eigen::VectorXd costs(flux.n), start;
        LongRounded block;
        for (Index v = begin; v < end; ++v) {
          if (!problem.boundary.is_interior(v)) {
            block.add(boundary_share(problem, admissible, v));
            continue;
          }
          vertex_costs(admissible, v, sums, costs);
          start = weights.at(v);
          const auto take = [&](auto& of_vertex, const auto& its_costs, const auto& its_start) {
            block.add(of_vertex.lower_bound(problem.mesh.points.col(v), its_costs, its_start));
            if (multipliers != nullptr) multipliers->col(v) = of_vertex.multipliers();
          };
          if (!problem.masks.at(v)) {
            take(program, costs, start);
            continue;
          }
          const auto allowed = problem.masks.allowed(v);
          const PointList<Dim> carriers = problem.cage.points(Eigen::all, allowed);
          VertexLinearProgram<Dim> masked(carriers);
          take(masked, Eigen::VectorXd(costs(allowed)), Eigen::VectorXd(start(allowed)));
        }
        progress.add(end - begin);
        return block;
      });
  LongRounded conjugate;
  if (problem.smoothness > 0) {
    conjugate = parallel_sum(problem.mesh.num_cells(), conjugate, [&](Index begin, Index end) {
      LongRounded block;
      for (Index s = begin; s < end; ++s) block.add(-admissible.conjugate(s));
      return block;
    });
  }
  const auto total = static_cast<double>(sum.rounded_down(problem.mesh.num_vertices()) +
                                         conjugate.rounded_down(problem.mesh.num_cells()));
  // Every objective is at least 0, and a non-finite bound proves nothing more.
  if (!(total > 0) || !std::isfinite(total)) return 0;
  return std::nextafter(total, 0);
}

// p / A.
template <class Scalar, int Dim>
auto densities(const LbcProblem<Dim>& problem, const CellFieldView<Scalar, Dim>& flux) {
  decltype(Proof::flux) result(problem.mesh.num_cells() * Dim, flux.n);
  parallel_for(problem.mesh.num_cells(), [&](Index s) {
    const double measure = cell_geometry(problem.mesh, s).measure;
    result.template middleRows<Dim>(s * Dim) = (flux.cell(s) / measure).template cast<float>();
  });
  return result;
}

auto masked_pairs(const PointMasks& masks) {
  std::vector<std::array<Index, 2>> pairs;
  for (const Index v : masks.points()) {
    for (const Index i : masks.forbidden(v)) pairs.push_back({v, i});
  }
  decltype(Proof::masked) result(2, pairs.size());
  for (std::size_t k = 0; k < pairs.size(); ++k) result.col(k) << pairs[k][0], pairs[k][1];
  return result;
}

}  // namespace

template <class Scalar, int Dim>
double lower_bound(const LbcProblem<Dim>& problem, const CellFieldView<Scalar, Dim>& flux,
                   const SparseWeights& weights) {
  return bound<Scalar, Dim>(problem, flux, weights, nullptr);
}

template <class Scalar, int Dim>
Certificate certify(const LbcProblem<Dim>& problem, const CellFieldView<Scalar, Dim>& flux,
                    const WeightMatrix& weights, Proof* proof) {
  check_flux(problem, flux);
  check_size(weights, problem.num_control_points(), problem.mesh.num_vertices());
  const auto feasible = made_feasible(problem, weights);
  Certificate certificate;
  certificate.objective = flbc::objective(problem, feasible);
  PointList<Dim> multipliers;
  if (proof != nullptr) multipliers = PointList<Dim>::Zero(Dim, problem.mesh.num_vertices());
  certificate.lower_bound =
      bound(problem, flux, feasible, proof != nullptr ? &multipliers : nullptr);
  if (proof != nullptr) {
    *proof = {densities(problem, flux), std::move(multipliers), problem.phi, problem.smoothness,
              masked_pairs(problem.masks)};
  }
  if (certificate.objective > 0) {
    certificate.relative_gap =
        (certificate.objective - certificate.lower_bound) / certificate.objective;
  }
  return certificate;
}

#define FLBC_INSTANTIATE(Scalar, Dim)                                                     \
  template double lower_bound(const LbcProblem<Dim>&, const CellFieldView<Scalar, Dim>&,  \
                              const SparseWeights&);                                      \
  template Certificate certify(const LbcProblem<Dim>&, const CellFieldView<Scalar, Dim>&, \
                               const WeightMatrix&, Proof*);
FLBC_INSTANTIATE(float, 2)
FLBC_INSTANTIATE(float, 3)
FLBC_INSTANTIATE(double, 2)
FLBC_INSTANTIATE(double, 3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
