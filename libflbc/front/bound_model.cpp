// SPDX-License-Identifier: BSD-3-Clause
#include "front/bound_model.h"

#include <iostream>
#include <sstream>

#include "flbc/bounding_box.h"
#include "flbc/cage_facts.h"
#include "flbc/deform.h"
#include "flbc/errors.h"
#include "flbc/io/mesh_io.h"
#include "flbc/io/weights_io.h"
#include "flbc/report.h"
#include "front/facts.h"
#include "front/instantiate.h"
#include "front/load.h"
#include "front/model_page.h"
#include "front/system/held_signals.h"

namespace flbc::app {
namespace {

// Weights reproduce their model up to rounding and the tolerance of a solve.
constexpr double kReproduction = 1e-6;

template <int Dim>
void require_reproduction(const SparseWeights& weights, const Cage<Dim>& rest,
                          const PointList<Dim>& points, const BindingFiles& files,
                          const std::string& model) {
  const auto moved = deform(weights, rest.points);
  auto lengths = displacements(attached_points(rest, points, weights), moved);
  for (Index p = 0; p < weights.num_points(); ++p) {
    if (!weights.has_weights(p)) lengths[p] = 0;
  }
  Eigen::Index worst = 0;
  const double error = lengths.maxCoeff(&worst) / bounding_box_diagonal(rest.points);
  if (error <= kReproduction) return;
  const Eigen::IOFormat row(6, Eigen::DontAlignCols, ", ", ", ", "", "", "(", ")");
  std::ostringstream text;
  text << files.weights << ": the weights do not belong to this model: with " << files.cage
       << " they put vertex " << worst << " of " << model << " at "
       << moved.col(worst).transpose().format(row) << ", not at "
       << points.col(worst).transpose().format(row) << "; the distance is " << error
       << " of the cage size, but at most " << kReproduction
       << " is allowed; weights by the method bbw reproduce no model and need flbc deform "
          "--relative";
  throw InputError(text.str());
}

template <int Dim>
OutsidePoints policy_by_mesh(const Binding<Dim>& bound, const MovableModel<Dim>& model,
                             const std::string& file, OutsidePoints outside) {
  if (outside == OutsidePoints::kFail) outside = bound.policy;
  if (model.drawing() == nullptr || outside != OutsidePoints::kFail) return outside;
  const auto beyond = points_outside(bound.cage, model.points());
  if (beyond.empty()) return outside;
  std::cerr << "flbc: " << file << ": " << model.drawing()->element_of(beyond.front())
            << " is outside the cage, and stays there; --outside nearest lets it follow\n";
  return OutsidePoints::kKeep;
}

}  // namespace

bool BindingFiles::is_one() const {
  return io::is_binding_file(weights);
}

void require_cage(const BindingFiles& files, const char* option) {
  if (!files.has_cage()) {
    throw OptionError(files.weights + ": only .npz files have the cage of the weights; add " +
                      option);
  }
  if (files.is_one() && !files.cage.empty()) {
    throw OptionError(std::string(option) + ": " + files.weights +
                      " has the cage of the weights; leave out this option");
  }
}

const io::AnyBinding& BindingFiles::content() const {
  if (!content_) content_ = std::make_shared<const io::AnyBinding>(io::read_binding(weights));
  return *content_;
}

int dimension_of(const BindingFiles& files) {
  if (!files.is_one()) return dimension_of_cage(files.cage);
  return files.content().index() == 0 ? 2 : 3;
}

template <int Dim>
const Binding<Dim>& load_binding(const BindingFiles& files) {
  if (const auto* found = std::get_if<Binding<Dim>>(&files.content())) return *found;
  throw InputError(files.weights + ": is a binding in another dimension, not in " +
                   std::to_string(Dim) + "D");
}

template <int Dim>
Binding<Dim> load_domain_binding(const BindingFiles& files) {
  if (files.domain.empty()) return load_binding<Dim>(files);
  auto domain = io::read_domain<Dim>(files.domain);
  auto binding = load_binding<Dim>(files, files.domain, domain.points, {});
  binding.domain = std::move(domain);
  binding.domain_weights = binding.weights;
  return binding;
}

template <int Dim>
Binding<Dim> load_binding(const BindingFiles& files, const std::string& model,
                          const PointList<Dim>& points, EdgeList edges, bool reproduces) {
  if (files.is_one()) {
    const auto& binding = load_binding<Dim>(files);
    naming(model, [&] { binding.require_points(points); });
    return binding;
  }
  auto cage = RestCage<Dim>(files.cage).cage();
  auto weights = io::read_weights(files.weights);
  check_sizes(weights, cage.size(), points.cols(), {files.weights, files.cage, model});
  if (reproduces) require_reproduction(weights, cage, points, files, model);
  return bound_by<Dim>(std::move(cage), points, std::move(weights), std::move(edges));
}

template <int Dim>
RestCage<Dim> rest_cage_of(const BindingFiles& files, const Binding<Dim>& binding) {
  if (!files.cage.empty()) return RestCage<Dim>(files.cage);
  return RestCage<Dim>(binding.cage, files.weights);
}

template <int Dim>
view::ShownCage<Dim> shown_cage_of(const BindingFiles& files, const Binding<Dim>& binding) {
  if (!files.cage.empty()) return load_shown_cage<Dim>(files.cage);
  const auto& [points, facets] = binding.cage;
  return {points, facets, view::edges_of_cage<Dim>({}, facets)};
}

template <int Dim>
void write_binding(const std::string& path, const Binding<Dim>& binding) {
  const HeldSignals held;
  if (io::is_binding_file(path)) return io::write_binding(path, binding);
  io::write_weights(path, binding.weights);
}

template <int Dim>
void warn_outside(const Binding<Dim>& binding, const std::string& file) {
  const auto& [points, outside] = std::tie(binding.points, binding.outside);
  const bool keeps = binding.policy == OutsidePoints::kKeep;
  std::vector<Index> following;
  for (const Index p : outside) {
    if (keeps || binding.weights.has_weights(p)) following.push_back(p);
  }
  const auto still = outside.size() - following.size();
  if (still > 0) {
    std::cerr << "flbc: " << file << ": " << still << " of " << points.cols()
              << " vertices have no weights; they stay where they are\n";
  }
  if (following.empty() || binding.cage.facets.cols() == 0) return;
  double distance = 0;
  for (const auto& place : nearest_on_cage<Dim>(binding.cage, binding.rest(), following)) {
    distance = std::max(distance, place.distance());
  }
  const char* const what = keeps ? "stay where they are"
                           : binding.policy == OutsidePoints::kNearest
                               ? "follow its nearest point at a constant offset"
                               : "are extrapolated";
  Facts facts;
  facts << file << ": " << following.size() << " of " << points.cols()
        << " vertices are outside the cage, by up to "
        << 100 * distance / bounding_box_diagonal(binding.cage.points) << "% of its size; they "
        << what;
  std::cerr << "flbc: " << facts.text() << '\n';
}

void check_sizes(const SparseWeights& weights, Eigen::Index num_control_points,
                 Eigen::Index num_points, const WeightFiles& files) {
  if (weights.num_points() != num_points) {
    throw InputError(files.weights + ": has weights of " + std::to_string(weights.num_points()) +
                     " points, but " + files.model + " has " + std::to_string(num_points) +
                     " vertices");
  }
  if (weights.num_control_points() != num_control_points) {
    throw InputError(files.weights + ": has weights for " +
                     std::to_string(weights.num_control_points()) + " control points, but " +
                     files.cage + " has " + std::to_string(num_control_points));
  }
}

Index count_without_weights(const SparseWeights& weights) {
  Index count = 0;
  for (Index p = 0; p < weights.num_points(); ++p) count += weights.has_weights(p) ? 0 : 1;
  return count;
}

template <int Dim>
Motion<Dim> drawing_by_mesh(const Binding<Dim>& bound, const MovableModel<Dim>& model,
                            const std::string& file, OutsidePoints outside) {
  outside = policy_by_mesh(bound, model, file, outside);
  if (outside == OutsidePoints::kFail) outside = OutsidePoints::kKeep;  // none is outside
  return [&bound, &points = model.points(), file, outside](const PointList<Dim>& pose) {
    return naming(file, [&] { return bound.deform(pose, points, outside); });
  };
}

template <int Dim>
Binding<Dim> bind_by_mesh(const Binding<Dim>& bound, const MovableModel<Dim>& model,
                          const std::string& file, OutsidePoints outside) {
  outside = policy_by_mesh(bound, model, file, outside);
  return naming(file, [&] { return bound.transferred(model.points(), model.edges(), outside); });
}

#define FLBC_INSTANTIATE(Dim)                                                            \
  template const Binding<Dim>& load_binding(const BindingFiles&);                        \
  template Binding<Dim> load_domain_binding(const BindingFiles&);                        \
  template Motion<Dim> drawing_by_mesh(const Binding<Dim>&, const MovableModel<Dim>&,    \
                                       const std::string&, OutsidePoints);               \
  template Binding<Dim> bind_by_mesh(const Binding<Dim>&, const MovableModel<Dim>&,      \
                                     const std::string&, OutsidePoints);                 \
  template Binding<Dim> load_binding(const BindingFiles&, const std::string&,            \
                                     const PointList<Dim>&, EdgeList, bool);             \
  template RestCage<Dim> rest_cage_of(const BindingFiles&, const Binding<Dim>&);         \
  template view::ShownCage<Dim> shown_cage_of(const BindingFiles&, const Binding<Dim>&); \
  template void write_binding(const std::string&, const Binding<Dim>&);                  \
  template void warn_outside(const Binding<Dim>&, const std::string&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::app
