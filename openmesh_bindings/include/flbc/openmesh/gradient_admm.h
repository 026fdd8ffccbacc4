// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The gradient ADMM of the paper (4.2.1 in 2D, 4.2.3 in 3D), step by step on a mesh.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "flbc/openmesh/gradient_problem.h"
#include "flbc/openmesh/gradients.h"
#include "flbc/openmesh/weights.h"
#include "flbc/recovery.h"

namespace flbc::openmesh {

//! Options of GradientAdmm.
struct GradientAdmmOptions {
  double penalty = 0;     //!< mu > 0, in length^(Dim + 1) of the mesh; 0: chosen from the mesh
  double relaxation = 1;  //!< over-relaxation in (0, 2); 1 is the iteration of the paper
  DistanceScheme phi = DistanceScheme::kSquare;  //!< growth of phi with the geodesic distance
  double smoothness = 0;                         //!< as in SolverOptions, but 0 by default
  //! Starts from the least-norm solution of (8), recovers weights breadth-first, and chooses the
  //! penalty of the paper, instead of harmonic coordinates, least squares, and few iterations.
  bool as_published = false;
  std::string weights = kWeights;  //!< name of the property for recovered weights
};

//! Minimizes sum_s sum_i A (phi |g| + epsilon / 2 |g|^2), (7) plus the quadratic term, over a
//! gradient g per cell and control point, subject to the barycentric conditions (8), the boundary
//! values (9), and integrability (10). Copies of the gradients, X on boundary facets, Y on interior
//! facets, and Z on cells, satisfy one condition each; u = lambda / mu is the scaled dual of a
//! copy.
//!
//!     X-step   x = g - u, its tangential part replaced by h       boundary facets (9)
//!     Y-step   y = g - u, its tangential part averaged            interior facets (10)
//!     Z-step   z = g - u, shortened by phi A / mu, / (1 + epsilon A / mu)  cells (7)
//!     G-step   g = mean of x + u, y + u, z + u, projected on (8)  cells (11)
//!
//! Each step updates its dual lambda relative to the extrapolated gradient e = 2 g - (g before)
//! (docs/explanation/method/gradient_admm.md). Then the dual is a tangential vector per facet or a
//! vector per cell, of length <= phi A without smoothness. The copy is e + (change of lambda) / mu
//! and need not be stored. The gradients are those of the paper, iterate by iterate;
//! tests/support/textbook_admm.h is the version with all copies. If the boundary has several
//! components, each one after the first adds a period constraint.
//!
//! The state is stored in the properties named below, in the units of the mesh. A new object on a
//! mesh with these properties resumes. The iteration converges from any state, also one for another
//! penalty or another cage with the same number of control points. Mesh elements must not change
//! meanwhile.
//! \tparam Mesh  a TriMesh of OpenMesh in the plane, or a TetMesh
//! \tparam Scalar  of the state: double or float
template <class Mesh, class Scalar = double>
class GradientAdmm {
 public:
  static constexpr const char* kGradient = "flbc:admm:gradient";          // Dim rows of n per cell
  static constexpr const char* kExtrapolated = "flbc:admm:extrapolated";  // Dim rows of n per cell
  static constexpr const char* kCellDual = "flbc:admm:cell_dual";         // Dim rows of n per cell
  static constexpr const char* kFacetDual = "flbc:admm:facet_dual";       // Dim rows of n per facet
  static constexpr const char* kPeriodDual = "flbc:admm:period_dual";     // a row of n per period

  static constexpr int kDim = kDimension<Mesh>;
  using Cell = typename Elements<Mesh>::Cell;
  using Facet = typename Elements<Mesh>::Facet;
  using Rows = VectorRows<Scalar, kDim>;

  //! Norms of r_p and r_d of the paper; with over-relaxation, r_p at the extrapolated gradients.
  struct Residuals {
    double primal, dual;
  };

  //! Resumes from the state on the mesh, or starts as the options say if there is none.
  //! \throws InputError if mesh and cage do not belong together; OptionError, SolverError
  GradientAdmm(Mesh& mesh, const Cage<kDim>& cage, const GradientAdmmOptions& options = {})
      : GradientAdmm(mesh,
                     internal::problem_on_mesh(cage, snapped_domain(mesh, cage), options.phi,
                                               options.smoothness),
                     options) {}

  //! The same for a problem whose mesh has the vertices and cells of this one.
  //! \param problem  must outlive the object; replaces GradientAdmmOptions::phi and smoothness
  GradientAdmm(Mesh& mesh, const LbcProblem<kDim>& problem, const GradientAdmmOptions& options = {})
      : GradientAdmm(mesh,
                     std::shared_ptr<const LbcProblem<kDim>>(std::shared_ptr<void>(), &problem),
                     options) {}

  //! Drops the state and starts as the options say. \throws SolverError
  void restart() {
    if (options_.as_published) {
      start([&](Cell) -> Rows { return problem_.target * problem_.basis.transpose(); });
    } else {
      const SparseWeights weights(internal::harmonic_weights(problem_));
      start([&](Cell cell) -> Rows {
        return internal::gradients_on_cell(problem_.base->mesh, cell.idx(), weights)
            .template cast<Scalar>();
      });
    }
  }

  //! \return residuals of the last iteration \throws SolverError if it diverges
  Residuals iterate(int count = 1) {
    Change change;
    for (int k = 0; k < count; ++k) {
      change = for_all(Elements<Mesh>::facets(mesh_), [&](Facet facet, Rows& a, Rows& b) {
        return sides(facet)[1].is_valid() ? y_step(facet, a, b) : x_step(facet, a, b);
      });
      change += period_step();
      change += for_all(Elements<Mesh>::cells(mesh_), [&](Cell cell, Rows& a, Rows& b) {
        Change of_cell = z_step(cell, a, b);
        return of_cell += g_step(cell, a, b);
      });
    }
    if (!std::isfinite(change.dual + change.gradient)) {
      throw SolverError(
          "GradientAdmm: the state on the mesh is not finite; call restart(), and try the default "
          "penalty, or double precision");
    }
    // The duals here lead those of the paper by a part that the G-step removes
    // (docs/explanation/method/gradient_admm.md).
    const double primal = alpha_ == 1 ? change.dual - M_ * change.lead : change.dual;
    residuals_ = {std::sqrt((std::max)(primal, 0.0)), penalty_ * std::sqrt(M_ * change.gradient)};
    return residuals_;
  }

  //! The squared change of all gradients in the last iteration.
  double squared_change() const {
    const double change = residuals_.dual / penalty_;
    return change * change / M_;
  }

  //! Number of components of each residual.
  double num_components() const { return M_ * kDim * n_ * problem_.base->mesh.num_cells(); }

  //! Whether the last iteration met the criterion of section 5 of the paper: |r_p| <= N tolerance
  //! and |r_d| <= 10 N tolerance with N components, in the unit of length of the paper, in which
  //! the farthest vertex is at radius 250.
  bool converged(double tolerance = 1e-7) const {
    const double length = problem_.published_scale;
    const double threshold = tolerance * num_components();
    return residuals_.primal / length <= threshold &&
           residuals_.dual * std::pow(length, kDim) <= 10 * threshold;
  }

  //! The weights of the current gradients, n x V. \throws SolverError
  WeightMatrix recovered_weights() const {
    return options_.as_published ? integrate_breadth_first(*problem_.base, gradients())
                                 : internal::nearest_weights(problem_, gradients());
  }

  //! Writes them as a property. \throws SolverError
  void recover_weights() const {
    set_weights(mesh_, SparseWeights(recovered_weights()), options_.weights);
    set_rest_cage(mesh_, problem_.base->cage.points, options_.weights);
  }

  bool resumed() const { return resumed_; }    //!< whether it started from a state on the mesh
  double penalty() const { return penalty_; }  //!< as in GradientAdmmOptions

  //! The state on an element, Dim x n: gradients, ...
  Eigen::Map<Rows> gradient(Cell cell) const { return rows(gradient_, cell); }
  //! ... the dual of (7), ...
  Eigen::Map<Rows> cell_dual(Cell cell) const { return rows(cell_dual_, cell); }
  //! ... and the dual of (9) or (10), positive on the first side of the facet.
  Eigen::Map<Rows> facet_dual(Facet facet) const { return rows(facet_dual_, facet); }

  //! The gradients of all cells.
  CellFieldView<Scalar, kDim> gradients() const {
    return {gradient_->data(), static_cast<std::size_t>(n_), n_};
  }

  //! p of all cells for certify(): the negative dual of the next Z-step, without relaxation.
  //! \return cells by Dim by n numbers
  std::vector<Scalar> flux() const {
    std::vector<Scalar> flux(gradient_->n_elements() * kDim * static_cast<std::size_t>(n_));
    Rows dual(kDim, n_), work(kDim, n_);
    for (const Cell cell : Elements<Mesh>::cells(mesh_)) {
      clip_dual(cell, dual, work);
      Eigen::Map<Rows>(&flux[cell.idx() * dual.size()], kDim, n_) = -dual;
    }
    return flux;
  }

 private:
  using CellRows = typename Elements<Mesh>::template CellProperty<Wide<Scalar>>;
  using FacetRows = typename Elements<Mesh>::template FacetProperty<Wide<Scalar>>;
  using MeshRows = OpenMesh::MPropHandleT<Wide<Scalar>>;
  using Property = OpenMesh::PropertyT<Wide<Scalar>>;

  // Squared changes in one iteration, for the residuals.
  struct Change {
    double dual = 0, gradient = 0, lead = 0;
    Change& operator+=(const Change& other) {
      dual += other.dual, gradient += other.gradient, lead += other.lead;
      return *this;
    }
    friend Change operator+(Change sum, const Change& other) { return sum += other; }
  };

  GradientAdmm(Mesh& mesh, std::shared_ptr<const LbcProblem<kDim>> problem,
               const GradientAdmmOptions& options)
      : mesh_(mesh),
        options_(options),
        problem_(make_gradient_problem<Scalar>(std::move(problem), make_domain(mesh).topology)),
        n_(problem_.base->num_control_points()),
        penalty_(options.penalty > 0    ? options.penalty
                 : options.as_published ? problem_.published_penalty
                                        : problem_.penalty),
        mu_(static_cast<Scalar>(penalty_)),
        alpha_(static_cast<Scalar>(options.relaxation)),
        M_(static_cast<double>(kDim + 2 + problem_.periods.size())) {
    if (!(options.penalty >= 0 && alpha_ > 0 && alpha_ < 2 && options.smoothness >= 0)) {
      throw OptionError(
          "GradientAdmm: invalid option; use a penalty >= 0, a relaxation in (0, 2), a "
          "smoothness >= 0");
    }
    const bool attached[] = {attach<CellRows>(gradient_, kGradient, kDim),
                             attach<CellRows>(extrapolated_, kExtrapolated, kDim),
                             attach<CellRows>(cell_dual_, kCellDual, kDim),
                             attach<FacetRows>(facet_dual_, kFacetDual, kDim),
                             attach<MeshRows>(period_dual_, kPeriodDual, problem_.periods.size())};
    resumed_ = std::find(std::begin(attached), std::end(attached), false) == std::end(attached);
    if (!resumed_) restart();
  }

  template <class GradientOf>
  void start(const GradientOf& gradient_of) {
    for (const Cell cell : Elements<Mesh>::cells(mesh_)) {
      gradient(cell) = gradient_of(cell);
      rows(extrapolated_, cell) = gradient(cell);
      cell_dual(cell).setZero();
    }
    for (const Facet facet : Elements<Mesh>::facets(mesh_)) facet_dual(facet).setZero();
    period_duals().setZero();
    resumed_ = false;
    residuals_.primal = residuals_.dual = std::numeric_limits<double>::infinity();
  }

  // The steps on one element; the last arguments are work memory.
  Change x_step(Facet facet, Rows& sum, Rows& projected) {
    const auto& h = problem_.slope[static_cast<std::size_t>(facet.idx())];
    sum = facet_dual(facet) + mu_ * (h - rows(extrapolated_, sides(facet)[0]));
    projected.noalias() = projector(facet).lazyProduct(sum);
    return move(facet_dual(facet), projected, 1);
  }

  Change y_step(Facet facet, Rows& sum, Rows& projected) {
    const auto [first, second] = sides(facet);
    sum = rows(extrapolated_, second) - rows(extrapolated_, first);
    sum = facet_dual(facet) + (mu_ / 2) * sum;
    projected.noalias() = projector(facet).lazyProduct(sum);
    return move(facet_dual(facet), projected, 2);
  }

  Change z_step(Cell cell, Rows& clipped, Rows& squares) {
    clip_dual(cell, clipped, squares);
    return move(cell_dual(cell), clipped, 1);
  }

  void clip_dual(Cell cell, Rows& clipped, Rows& squares) const {
    constexpr Scalar kTiny = (std::numeric_limits<Scalar>::min)();
    clipped = cell_dual(cell) - mu_ * rows(extrapolated_, cell);
    squares = clipped.cwiseAbs2();
    for (int d = 1; d < kDim; ++d) squares.row(0) += squares.row(d);
    const auto radius = problem_.radius.col(cell.idx()).transpose().array();
    auto shrink = squares.row(0).array();
    shrink = radius / (shrink.max)(radius.square() + kTiny).sqrt();
    const double quadratic = problem_.quadratic[cell.idx()];
    const auto theta = static_cast<Scalar>(quadratic / (penalty_ + quadratic));
    shrink = theta + (Scalar(1) - theta) * shrink;
    for (int d = 0; d < kDim; ++d) clipped.row(d).array() *= shrink;
  }

  Change g_step(Cell cell, Rows& mean, Rows& step) {
    mean = cell_dual(cell);
    for (const Facet facet : Elements<Mesh>::facets_of(mesh_, cell)) {
      mean += Scalar(sides(facet)[0] == cell ? 1 : -1) * facet_dual(facet);
    }
    for (std::size_t p = 0; p < problem_.periods.size(); ++p) {
      mean +=
          problem_.periods[p].field.col(cell.idx()).template cast<Scalar>() * period_duals().row(p);
    }
    auto g = gradient(cell), e = rows(extrapolated_, cell);
    mean = g + static_cast<Scalar>(1 / (penalty_ * M_)) * mean;
    const Eigen::Matrix<Scalar, kDim, kDim + 1> excess =
        mean.lazyProduct(problem_.basis) - problem_.target;
    mean.noalias() -= excess.lazyProduct(problem_.basis.transpose());
    step = mean - g;
    const Scalar lead = alpha_ == 1 ? (e - mean).squaredNorm() : 0;
    e = mean + step;
    g += alpha_ * step;
    return {0, step.squaredNorm(), lead};
  }

  Change period_step() {
    Change change;
    for (std::size_t p = 0; p < problem_.periods.size(); ++p) {
      const auto& period = problem_.periods[p];
      Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(n_, kSumBlocks);
      for_blocks(problem_.base->mesh.num_cells(), [&](int block, int begin, int end) {
        for (int s = begin; s < end; ++s) {
          sums.col(block) += rows(extrapolated_, Cell(s)).transpose().template cast<double>() *
                             period.field.col(s);
        }
      });
      const Eigen::RowVectorXd step = period.values - sums.rowwise().sum().transpose();
      period_duals().row(p) += alpha_ * mu_ * step.template cast<Scalar>();
      change.dual += step.squaredNorm();
    }
    return change;
  }

  // Moves a dual toward `target`, which becomes the difference.
  Change move(Eigen::Map<Rows> dual, Rows& target, int sides) const {
    target -= dual;
    dual += alpha_ * target;
    return {sides * static_cast<double>((target / mu_).squaredNorm()), 0, 0};
  }

  // The sum of what `step` returns for all elements of a range of the mesh, in parallel. `step`
  // gets two work matrices.
  template <class Range, class Step>
  Change for_all(const Range& range, const Step& step) const {
    std::array<Change, kSumBlocks> parts{};
    auto first = range.begin();
    for_blocks((*range.end()).idx(), [&](int block, int begin, int end) {
      Rows a(kDim, n_), b(kDim, n_);
      Change sum;
      for (int k = begin; k < end; ++k) sum += step(*(first + k), a, b);
      parts[static_cast<std::size_t>(block)] = sum;
    });
    return std::accumulate(parts.begin(), parts.end(), Change{});
  }

  Eigen::Map<Rows> rows(Property* property, OpenMesh::BaseHandle element) const {
    return Eigen::Map<Rows>((*property)[element.idx()].data(), kDim, n_);
  }
  const auto& projector(Facet facet) const {
    return problem_.projector[static_cast<std::size_t>(facet.idx())];
  }
  auto sides(Facet facet) const { return Elements<Mesh>::sides(mesh_, facet); }
  auto period_duals() const { return (*period_dual_)[0].matrix(); }

  template <class Handle>
  bool attach(Property*& property, const char* name, std::size_t components) {
    bool is_there;
    std::tie(property, is_there) =
        internal::attach_rows<Handle>(mesh_, name, components, static_cast<std::size_t>(n_));
    return is_there;
  }

  Mesh& mesh_;
  const GradientAdmmOptions options_;
  const GradientProblem<Scalar, kDim> problem_;
  const Index n_;         // control points
  const double penalty_;  // mu
  const Scalar mu_, alpha_;
  const double M_;  // copies of a gradient
  bool resumed_ = false;
  Residuals residuals_{std::numeric_limits<double>::infinity(),
                       std::numeric_limits<double>::infinity()};
  // Pointers, because OpenMesh finds a property by a dynamic cast on every access.
  Property *gradient_, *extrapolated_, *cell_dual_, *facet_dual_, *period_dual_;
};

//! Gives Method::kGradient and kPaper to solve() and Solver, which then iterate on meshes of
//! OpenMesh. options.h calls it in programs that link flbc::openmesh. \return true
bool enable_gradient_methods() noexcept;

}  // namespace flbc::openmesh
