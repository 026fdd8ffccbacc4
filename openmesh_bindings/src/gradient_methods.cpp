// SPDX-License-Identifier: BSD-3-Clause
// Methods kGradient and kPaper of the core.
#include <memory>

#include "flbc/openmesh/convert.h"
#include "flbc/openmesh/gradient_admm.h"
#include "solver/methods/method_run.h"

namespace flbc::openmesh {
namespace {

struct PlaneTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec2d;
};

template <int Dim>
using DomainOf = std::conditional_t<Dim == 2, OpenMesh::TriMesh_ArrayKernelT<PlaneTraits>, TetMesh>;

GradientAdmmOptions admm_options(const plan::Settings& settings) {
  GradientAdmmOptions options;
  options.penalty = settings.penalty.value_or(0);
  options.relaxation = settings.relaxation;
  options.as_published = settings.method == Method::kPaper;
  return options;
}

// The iteration on a mesh of its own.
template <class Scalar, int Dim>
class GradientIteration final : public Iteration<Dim> {
 public:
  GradientIteration(const LbcProblem<Dim>& problem, const plan::Settings& settings)
      : problem_(problem),
        mesh_(to_mesh<DomainOf<Dim>>(problem.mesh)),
        admm_(mesh_, problem, admm_options(settings)) {}

  //! It has started, as the method does; no other iteration hands over to this one.
  void start(const Start<Dim>&) override {}

  int interval() const override { return plan::kCheckInterval; }

  Step iterate(int, int count) override {
    const auto [primal, dual] = admm_.iterate(count);
    const double components = admm_.num_components();
    return {admm_.squared_change(), primal / components, dual / components};
  }

  Weights weights() const override { return {admm_.recovered_weights(), {}}; }

  Certificate certify(const WeightMatrix& weights, Proof* proof) const override {
    const auto flux = admm_.flux();
    const CellFieldView<Scalar, Dim> view{flux.data(), static_cast<std::size_t>(weights.rows()),
                                          static_cast<Index>(weights.rows())};
    return flbc::certify(problem_, view, weights, proof);
  }

  void describe(SolveReport& report) const override {
    report.penalty = admm_.penalty();
    // Three fields of vectors on cells, one on facets.
    const double facets_per_cell =
        static_cast<double>(problem_.topology.num_facets()) / problem_.mesh.num_cells();
    report.state_scalars_per_cell = Dim * (3 + facets_per_cell);
  }

 private:
  const LbcProblem<Dim>& problem_;
  DomainOf<Dim> mesh_;
  GradientAdmm<DomainOf<Dim>, Scalar> admm_;
};

template <int Dim>
std::unique_ptr<Iteration<Dim>> make_iteration(const LbcProblem<Dim>& problem,
                                               const plan::Settings& settings) {
  if (settings.precision == Precision::kDouble) {
    return std::make_unique<GradientIteration<double, Dim>>(problem, settings);
  }
  return std::make_unique<GradientIteration<float, Dim>>(problem, settings);
}

}  // namespace

bool enable_gradient_methods() noexcept {
  gradient_iteration<2>() = make_iteration<2>;
  gradient_iteration<3>() = make_iteration<3>;
  return true;
}

}  // namespace flbc::openmesh
