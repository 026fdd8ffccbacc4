// SPDX-License-Identifier: BSD-3-Clause
#include "solve/cage_solver.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "flbc/bounding_box.h"
#include "flbc/cage_facts.h"
#include "flbc/domain_mesh.h"
#include "flbc/errors.h"
#include "flbc/io/formats.h"
#include "flbc/io/mesh_io.h"
#include "flbc/io/model_file.h"
#include "flbc/io/weights_io.h"
#include "flbc/options.h"
#include "flbc/report.h"
#include "flbc/solver.h"
#include "front/estimate.h"
#include "front/facts.h"
#include "front/load.h"
#include "front/make_domain.h"
#include "front/model_facets.h"
#include "report/report_json.h"
#include "solve/make_cage.h"
#include "solve/progress_bar.h"

namespace flbc::app {
namespace {

template <int Dim>
const NearestOnCage<Dim>& farthest(const std::vector<NearestOnCage<Dim>>& points) {
  return *std::max_element(points.begin(), points.end(), [](const auto& a, const auto& b) {
    return a.distance() < b.distance();
  });
}

template <int Dim>
nlohmann::ordered_json beside_json(const std::vector<NearestOnCage<Dim>>& points) {
  nlohmann::ordered_json json{{"count", points.size()}};
  if (points.empty()) return json;
  json["farthest"] = farthest(points).point;
  json["distance"] = farthest(points).distance();
  return json;
}

template <int Dim>
Eigen::AlignedBox<double, Dim> box_of(const PointList<Dim>& points) {
  return {points.rowwise().minCoeff(), points.rowwise().maxCoeff()};
}

// Whether a model outside of a cage would be inside with another axis up.
bool fits_with_other_up_axis(const PointList<3>& cage, const PointList<3>& model) {
  const auto around = box_of<3>(cage);
  const auto fits = [&](double sign) {
    PointList<3> turned = model;
    turned.row(1) = sign * model.row(2);
    turned.row(2) = -sign * model.row(1);
    return around.contains(box_of<3>(turned));
  };
  return !around.contains(box_of<3>(model)) && (fits(1) || fits(-1));
}

// What to ask about a model that is outside of the cage.
template <int Dim>
std::string question_about(const PointList<Dim>& cage, const PointList<Dim>& model) {
  if constexpr (Dim == 3) {
    if (fits_with_other_up_axis(cage, model)) {
      return "; with y and z exchanged the model would fit: was it exported with another up axis?";
    }
  }
  return {};
}

template <int Dim>
void warn_tiny(const PointList<Dim>& cage, const PointList<Dim>& model, const std::string& file) {
  constexpr double kTiny = 1e-3;
  const double part = std::pow(bounding_box_diagonal(model) / bounding_box_diagonal(cage), Dim);
  if (model.cols() < 2 || part >= kTiny) return;
  Facts facts;
  facts << file << ": fills " << 100 * part << "% of the cage; are both in the same units?";
  std::cerr << "flbc: " << facts.text() << '\n';
}

const char* name_of(Stage stage) {
  switch (stage) {
    case Stage::kDistances:
      return "measuring distances";
    case Stage::kNonNegative:
      return "making weights non-negative";
    default:
      return "proving the gap";
  }
}

// Where a part is, for readers of the report to identify it.
template <int Dim>
nlohmann::ordered_json parts_json(const Cage<Dim>& cage, const std::vector<SolveReport>& reports) {
  auto json = nlohmann::ordered_json::array();
  const auto parts = cage_parts(cage);
  for (std::size_t p = 0; p < reports.size(); ++p) {
    json.push_back(part_json(reports[p], parts[p].control_points.front()));
  }
  return json;
}

}  // namespace

template <int Dim>
BindOptions bind_options(const Cage<Dim>& cage, const DomainMesh<Dim>& domain,
                         const SolveSettings& settings) {
  BindOptions options;
  options.max_influences = 0;
  options.outside = settings.outside;
  options.mirror_axis = settings.mirror_axis;
  options.coordinates = settings.coordinates;
  options.solver = settings.options;
  if (settings.penalty) {
    options.solver.penalty =
        published_penalty(cage, domain, settings.options.method, *settings.penalty);
  }
  if (!settings.phi.empty()) options.phi = io::read_weights(settings.phi).dense();
  return options;
}

template <int Dim>
CageSolver<Dim>::CageSolver(const Cage<Dim>& cage, const PointList<Dim>& model,
                            const EdgeList& edges, const SolveSettings& settings)
    : cage_(cage), model_(model), edges_(edges), settings_(settings), outside_(settings.outside) {
  if (settings.embed && settings.outside != OutsidePoints::kFail) {
    throw OptionError(
        "--outside: --embed needs all vertices inside the cage; leave out --embed or --outside");
  }
  if (settings.outside == OutsidePoints::kFail && model.cols() > 0 &&
      box_of<Dim>(model).contains(box_of<Dim>(cage.points)) &&
      points_outside(cage, model).size() == static_cast<std::size_t>(model.cols())) {
    throw InputError(settings.model + ": surrounds the cage " + settings.cage +
                     "; are CAGE and MODEL swapped?");
  }
}

template <int Dim>
MadeDomain<Dim> CageSolver<Dim>::fill_cage(bool quiet) {
  auto made = [&] {
    const ProgressBar bar(quiet, meshing_stage(settings_.meshing.timeout));
    return app::make_domain<Dim>({cage_, settings_.cage, settings_.vertices, settings_.meshing,
                                  settings_.embed ? settings_.model : "", embedded_.points});
  }();
  if (!made.note.empty() && !quiet) std::cerr << "flbc: " << made.note << '\n';
  return made;
}

template <int Dim>
void CageSolver<Dim>::require_inside(bool quiet) {
  const ProgressBar bar(quiet, "locating the model vertices in the cage");
  try {
    naming(settings_.model, [&] { place_points(cage_, model_, outside_); });
  } catch (const InputError& error) {
    if (settings_.embed || usual_policy(cage_, model_, edges_) == OutsidePoints::kFail) {
      throw InputError(error.what() + question_about<Dim>(cage_.points, model_));
    }
    outside_ = OutsidePoints::kNearest;
  }
}

template <int Dim>
void CageSolver<Dim>::make_domain(bool quiet) {
  // Refusals come before a mesh is made, which takes long.
  const bool has_model = !settings_.model.empty();
  if (!quiet && has_model) warn_tiny<Dim>(cage_.points, model_, settings_.model);
  if (has_model && outside_ == OutsidePoints::kFail) require_inside(quiet);
  const auto start = std::chrono::steady_clock::now();
  if (settings_.embed) embedded_ = embeddable_points(cage_, model_);
  MadeDomain<Dim> made{{}, "none"};
  if (!settings_.domain.empty()) {
    made.mesh = io::read_domain<Dim>(settings_.domain);
  } else if (!is_meshless(settings_)) {
    made = fill_cage(quiet);
  }
  mesh_seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  mesher_ = made.mesher;
  find_model(std::move(made), quiet || !has_model);
  load_masks(quiet);
}

template <int Dim>
void CageSolver<Dim>::find_model(MadeDomain<Dim> made, bool quiet) {
  const ProgressBar bar(quiet, "locating the model vertices in the mesh");
  auto options = bind_options<Dim>(cage_, made.mesh, settings_);
  options.outside = outside_;
  rig_ = naming(settings_.model, [&] {
    return is_meshless(settings_)
               ? std::make_unique<Rig<Dim>>(cage_, model_, edges_, options)
               : std::make_unique<Rig<Dim>>(cage_, std::move(made), model_, edges_, options);
  });
}

template <int Dim>
void CageSolver<Dim>::load_masks(bool quiet) {
  const bool has_masks = !settings_.locality.empty();
  if (has_masks) {
    auto options = rig_->options();
    const auto& points = settings_.model.empty() ? domain().points : model_;
    locality_ =
        load_locality(settings_.locality, cage_, points, settings_.model, settings_.mirror_axis);
    options.masks = locality_.masks;
    options.solid = locality_.solid;
    options.solver.reach = locality_.reach;
    options.solver.falloff = locality_.falloff;
    naming(settings_.locality, [&] { rig_->set_options(options); });
  }
  const auto& file = has_masks ? settings_.locality : settings_.model;
  for (const auto& note : {locality_.note(), rig_->note()}) {
    if (!note.empty() && !quiet) std::cerr << "flbc: " << file << ": " << note << '\n';
  }
}

template <int Dim>
void CageSolver<Dim>::announce() const {
  if (is_ambiguous(settings_)) {
    std::cerr
        << "flbc: smoothness 0: several weights may be optimal, for example near slits; leave "
           "out --smoothness for unique ones\n";
  }
  const auto note = note_many_vertices(settings_.cage, static_cast<std::size_t>(cage_.size()));
  if (!note.empty()) {
    std::cerr << "flbc: " << note << "; to make a cage around a model, use flbc cage\n";
  }
  const auto& options = settings_.options;
  const auto estimate = estimate_solve(Dim, cage_.size(), domain().num_vertices(), options);
  if (settings_.coordinates || options.method != Method::kWeights || !is_long(estimate)) return;
  std::cerr << "flbc: solving for " << cage_.size() << " control points and "
            << domain().num_vertices() << " vertices; this may take " << describe(estimate) << '\n';
}

template <int Dim>
void CageSolver<Dim>::solve(bool quiet) {
  if (!quiet && !is_meshless(settings_)) announce();
  ProgressBar bar(quiet, "setting up: boundary values, distances");
  auto options = rig_->options();
  options.observer.progress = [&](const Progress& progress) {
    bar.show(progress);
    return true;
  };
  options.observer.stage = [&](Stage stage, double done) { bar.show(name_of(stage), done); };
  rig_->set_options(options);
  const auto& file = !settings_.phi.empty()      ? settings_.phi
                     : !settings_.domain.empty() ? settings_.domain
                                                 : settings_.cage;
  naming(file, [&] { rig_->solve(); });
  binding_ = naming(settings_.model, [&] { return rig_->binding(); });
  options.observer = {};
  rig_->set_options(options);
  // Frees the state of the solver.
  if (!is_meshless(settings_)) rig_->set_solution(Solution(rig_->solution()));
}

// Of weights of a method that does not minimize it.
template <int Dim>
double CageSolver<Dim>::objective() const {
  const auto& options = settings_.options;
  const auto problem = make_problem(cage_, domain(), options.phi, *resolve(options).smoothness);
  return flbc::objective(problem, domain_weights()) / std::pow(problem.scale, Dim - 1);
}

template <int Dim>
nlohmann::ordered_json CageSolver<Dim>::json(const Quality& delivered) const {
  auto json = report_json(report(), settings_, {Dim, mesh_seconds(), mesher(), delivered});
  const bool has_objective = !std::isnan(report().objective) || is_meshless(settings_);
  if (!has_objective && report().parts.empty()) json["objective"] = objective();
  if (!settings_.model.empty()) {
    json["outside"] = {{"policy", name_of(outside_)},
                       {"on_cage", beside_json(rig_->placement().on_cage)},
                       {"outside", beside_json(rig_->placement().outside)}};
  }
  if (!settings_.locality.empty()) {
    json["locality"] = {{"file", settings_.locality},
                        {"masked_vertices", rig_->masks().masked},
                        {"on_facets", rig_->masks().on_facets},
                        {"freed", locality_.freed}};
  }
  if (!report().parts.empty()) json["parts"] = parts_json(cage_, report().parts);
  return json;
}

bool report_convergence(const SolveReport& report, const SolveSettings& settings) {
  if (report.status == SolveStatus::kConverged) {
    // The criteria of some methods say little about the distance to the optimum.
    constexpr double kLargeGap = 5e-3;
    const double gap = report.certificate.relative_gap;
    const bool says_little = report.method == Method::kPaper || report.method == Method::kLbc2014;
    if (says_little && is_certified(report) && gap > kLargeGap) {
      std::cerr
          << "flbc: converged by the criterion of this method, but up to " << 100 * gap
          << "% above the optimum; lower --tolerance, or leave --tolerance and --method out\n";
    }
    return true;
  }
  std::cerr
      << "flbc: not converged within " << settings.options.max_iterations
      << " iterations; the result is written. Increase --max-iterations, --tolerance, or --gap\n";
  return false;
}

#define FLBC_INSTANTIATE(Dim)                                                 \
  template BindOptions bind_options(const Cage<Dim>&, const DomainMesh<Dim>&, \
                                    const SolveSettings&);                    \
  template class CageSolver<Dim>;
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::app
