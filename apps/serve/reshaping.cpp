// SPDX-License-Identifier: BSD-3-Clause
#include "serve/reshaping.h"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

#include "flbc/errors.h"
#include "flbc/placement.h"
#include "view/page.h"

namespace flbc::app {
namespace {

using Json = nlohmann::ordered_json;

// Of one answer: long enough to converge after most moves, short enough to be interrupted.
constexpr Budget kBudget{0, 0.25};

template <int Dim>
PointList<Dim> points_in(const Json& request, Index count) {
  std::vector<double> numbers;
  try {
    numbers = request.at("points").get<std::vector<double>>();
  } catch (const nlohmann::json::exception& error) {
    throw InputError(std::string("invalid shape: ") + error.what());
  }
  if (numbers.size() != static_cast<std::size_t>(Dim) * count) {
    throw InputError("this shape has " + std::to_string(numbers.size()) + " coordinates, not " +
                     std::to_string(Dim * count));
  }
  return Eigen::Map<const PointList<Dim>>(numbers.data(), Dim, count);
}

}  // namespace

template <int Dim>
Reshaping<Dim>::Reshaping(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh, PointList<Dim> model,
                          const SolverOptions& options, const CoarseMesher<Dim>& mesher)
    : model_(std::move(model)),
      center_(view::page_center<Dim>(cage.points)),
      solver_(cage, mesh, options, mesher) {
  solver_.solve();
}

template <int Dim>
const PointList<Dim>& Reshaping<Dim>::points() const {
  return model_.cols() > 0 ? model_ : solver_.mesh().points;
}

template <int Dim>
SparseWeights Reshaping<Dim>::weights() const {
  const auto& mesh = solver_.mesh();
  const auto& of_mesh = solver_.solution().weights;
  const auto most = view::kMostInfluences;
  if (model_.cols() == 0) {
    return view::limit_influences<Dim>(cage().points, mesh.points, of_mesh, most);
  }
  const auto of_model = weights_at(cage(), mesh, of_mesh, place_points(cage(), mesh, model_));
  return view::limit_influences<Dim>(cage().points, model_, of_model, most);
}

// On the direct way from the anchored shape cells may turn over that do not from the present one.
template <int Dim>
void Reshaping<Dim>::move(const PointList<Dim>& control_points) {
  try {
    solver_.move(control_points, kBudget);
  } catch (const InputError&) {
    solver_.anchor();
    solver_.move(control_points, kBudget);
  }
}

template <int Dim>
std::string Reshaping<Dim>::update() const {
  return view::make_update<Dim>(cage().points, weights(), center_);
}

template <int Dim>
std::string Reshaping<Dim>::answer(const std::string& text) {
  const auto start = std::chrono::steady_clock::now();
  const PointList<Dim> before = cage().points;
  bool has_moved = false;
  try {
    const auto request = Json::parse(text);
    if (request.value("refine", false)) {
      solver_.solve(kBudget);
    } else {
      move(points_in<Dim>(request, cage().size()));
      has_moved = true;
    }
    const auto update = this->update();
    const auto& report = solver_.solution().report;
    const std::chrono::duration<double, std::milli> taken =
        std::chrono::steady_clock::now() - start;
    const Json facts{{"converged", report.status == SolveStatus::kConverged},
                     {"iterations", report.iterations},
                     {"residual", std::max(report.primal_residual, report.dual_residual)},
                     {"milliseconds", taken.count()}};
    auto reply = facts.dump();
    reply.pop_back();
    return reply + ",\"update\":" + update + "}";
  } catch (const std::exception& error) {
    if (has_moved) solver_.move(before);  // the model reached out of the cage
    return Json{{"refused", error.what()}}.dump(-1, ' ', false, Json::error_handler_t::replace);
  }
}

template class Reshaping<2>;
template class Reshaping<3>;

}  // namespace flbc::app
