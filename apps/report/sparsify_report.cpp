// SPDX-License-Identifier: BSD-3-Clause
#include "report/sparsify_report.h"

#include <filesystem>

#include "flbc/bounding_box.h"
#include "flbc/cage.h"
#include "flbc/cell_locator.h"
#include "flbc/errors.h"
#include "flbc/poses.h"
#include "flbc/quality.h"
#include "flbc/sparsify.h"
#include "flbc/sparsify_error.h"
#include "front/bound_model.h"
#include "front/facts.h"
#include "help/options.h"

namespace flbc::app {
namespace {

using Json = nlohmann::ordered_json;

Json norms_json(const ErrorNorms& norms) {
  return {{"rms", norms.rms}, {"max", norms.max}};
}

// \param measure  makes ErrorNorms of poses
template <int Dim, class Measure>
Json over_poses(const PointList<Dim>& control_points, const std::vector<PointList<Dim>>& poses,
                const std::vector<std::string>& names, const Measure& measure) {
  Json errors{{"random_poses", kRandomPoses},
              {"independent", norms_json(measure(independent_poses(control_points, kRandomPoses)))},
              {"smooth", norms_json(measure(smooth_poses(control_points, kRandomPoses)))}};
  errors["poses"] = Json::array();
  for (std::size_t k = 0; k < poses.size(); ++k) {
    auto entry = norms_json(measure({poses[k]}));
    entry["file"] = names[k];
    errors["poses"].push_back(entry);
  }
  return errors;
}

}  // namespace

void add_reduction_option(CLI::App& command, std::string& reduction) {
  add_choice(command, "--reduction", {kAutomatic, kPoisson, kQuadratic}, reduction,
             "method that reduces influences (default: auto, which is poisson where the vertices "
             "have edges). poisson: avoid seams between neighbors. quadratic: treat each vertex "
             "separately, which is faster");
}

std::string reduction_for(const std::string& asked, const std::string& points_file,
                          const EdgeList& edges) {
  const bool has_edges = !edges.ends.empty();
  if (asked == kPoisson && !has_edges) {
    throw InputError(points_file +
                     ": has no faces and no lines, so --reduction poisson finds no neighbors; use "
                     "--reduction quadratic");
  }
  if (asked != kAutomatic) return asked;
  return has_edges ? kPoisson : kQuadratic;
}

template <int Dim>
Json weights_json(const std::string& name, const std::string& path, const Binding<Dim>& binding) {
  std::error_code error;
  const auto bytes = std::filesystem::file_size(path, error);
  const auto& weights = binding.weights;
  const auto influences = count_influences(weights, kInfluenceThreshold);
  const auto stored = count_influences(weights);
  const auto quality = measure_quality(binding.cage.points, binding.points, weights);
  return {{"file", name},
          {"bytes", error ? 0 : bytes},
          {"mean_influences", influences.mean},
          {"max_influences", influences.max},
          {"mean_nonzeros", stored.mean},
          {"max_nonzeros", stored.max},
          {"without_weights", count_without_weights(weights)},
          {"min_weight", quality.min_weight},
          {"max_partition_error", quality.max_partition_error},
          {"max_reproduction_error", quality.max_reproduction_error}};
}

template <int Dim>
ErrorNorms relative_deformation_error(const PointList<Dim>& points,
                                      const std::vector<PointList<Dim>>& poses,
                                      const SparseWeights& before, const SparseWeights& after) {
  const auto norms = deformation_error(poses, before, after);
  const double size = bounding_box_diagonal<Dim>(points);
  return size > 0 ? ErrorNorms{norms.rms / size, norms.max / size} : norms;
}

template <int Dim>
Json errors_json(const Binding<Dim>& before, const Binding<Dim>& after,
                 const std::vector<PointList<Dim>>& poses, const std::vector<std::string>& names) {
  using Poses = std::vector<PointList<Dim>>;
  const auto& control_points = before.cage.points;
  Json errors{{"weight", norms_json(weight_error(before.weights, after.weights))}};
  errors["deformation"] = over_poses(control_points, poses, names, [&](const Poses& some) {
    return relative_deformation_error<Dim>(before.points, some, before.weights, after.weights);
  });
  if (before.edges.ends.empty()) return errors;
  errors["edge"] = over_poses(control_points, poses, names, [&](const Poses& some) {
    return edge_error<Dim>(before.points, before.edges, some, before.weights, after.weights);
  });
  return errors;
}

std::string summary_of(const Json& report) {
  const auto& before = report["before"];
  const auto& after = report["after"];
  const auto& error = report["error"]["deformation"]["smooth"];
  Facts text;
  text << after["file"].get<std::string>() << ": " << after["mean_influences"].get<double>()
       << " influences per vertex, at most " << after["max_influences"] << " (before "
       << before["mean_influences"].get<double>() << ", " << before["max_influences"]
       << "); deformation error over smooth random poses " << 100 * error["rms"].get<double>()
       << "% rms, " << 100 * error["max"].get<double>() << "% max of the size";
  if (after["without_weights"] > 0) {
    text << "; " << after["without_weights"] << " vertices have no weights and stay where they are";
  }
  return text.text();
}

#define FLBC_INSTANTIATE(Dim)                                                                     \
  template Json weights_json(const std::string&, const std::string&, const Binding<Dim>&);        \
  template Json errors_json(const Binding<Dim>&, const Binding<Dim>&,                             \
                            const std::vector<PointList<Dim>>&, const std::vector<std::string>&); \
  template ErrorNorms relative_deformation_error(const PointList<Dim>&,                           \
                                                 const std::vector<PointList<Dim>>&,              \
                                                 const SparseWeights&, const SparseWeights&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::app
