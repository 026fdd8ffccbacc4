// SPDX-License-Identifier: BSD-3-Clause
// The steps of flbc run that make what engines take: few influences, and a skin.
#include "flbc/bounding_box.h"
#include "flbc/cage.h"
#include "flbc/errors.h"
#include "flbc/io/binding_file.h"
#include "flbc/io/files.h"
#include "flbc/io/weights_io.h"
#include "flbc/poses.h"
#include "flbc/quality.h"
#include "flbc/sparsify.h"
#include "flbc/sparsify_error.h"
#include "front/facts.h"
#include "front/instantiate.h"
#include "front/load.h"
#include "gltf/skin.h"
#include "poses/outside.h"
#include "report/skin_facts.h"
#include "report/sparsify_report.h"
#include "run/steps.h"
#include "solve/progress_bar.h"

namespace flbc::app {
namespace {

using Json = nlohmann::ordered_json;

template <int Dim>
std::vector<PointList<Dim>> points_of(const std::vector<Pose<Dim>>& poses) {
  std::vector<PointList<Dim>> points;
  points.reserve(poses.size());
  for (const auto& pose : poses) points.push_back(pose.points);
  return points;
}

template <int Dim>
Binding<Dim> reduce(const Run<Dim>& run, const std::string& method,
                    const std::vector<PointList<Dim>>& poses, Index max_influences) {
  const std::string stage = "reducing influences";
  ProgressBar bar(run.arguments.quiet, stage);
  SparsifyOptions limits{max_influences};
  limits.progress = [&](double done) { bar.show(stage, done); };
  return run.solver.binding().reduced(limits, poses, reduction_named(method));
}

// Relative to the size, over the poses given or else over smooth random ones.
template <int Dim>
ErrorNorms error_of_reduction(const Run<Dim>& run, const std::vector<PointList<Dim>>& given) {
  const auto& poses = given.empty() ? smooth_poses(run.cage.points, kRandomPoses) : given;
  return relative_deformation_error<Dim>(run.shape().points, poses, run.weights(),
                                         run.reduced.weights);
}

std::string facts_of(const SparseWeights& before, const SparseWeights& after,
                     const ErrorNorms& error, std::size_t num_poses) {
  const auto influences = count_influences(after, kInfluenceThreshold);
  const char* const poses = num_poses == 0   ? "smooth random poses"
                            : num_poses == 1 ? "the pose"
                                             : "the poses";
  Facts facts;
  facts << influences.mean << " influences per vertex, at most " << influences.max << " (before "
        << count_influences(before, kInfluenceThreshold).max << "); deformation error "
        << 100 * error.rms << "% rms, " << 100 * error.max << "% max of the size in " << poses;
  return facts.text();
}

// Influences per vertex that a skin has room for.
constexpr Index kFewJoints = 4, kManyJoints = 8;

std::string left_out_of(const gltf::ExportedSkin& skin) {
  std::string text;
  for (const auto& phrase : skin.left_out) text += "; left out: " + phrase;
  return text;
}

// \return what the report says about it
template <int Dim>
Json write_skin(Run<Dim>& run, const std::string& name, Index max_influences) {
  const auto& shape = run.shape();
  const auto& animation = run.inputs.animation;
  gltf::SkinOptions options;
  options.max_influences = max_influences;
  options.name = shape.name;
  options.turn = turn_upright(up_axis(run.arguments.up, shape.points));
  const auto skin = gltf::export_skin(run.reduced, shape.surface, options, animation);
  const double size = bounding_box_diagonal<Dim>(shape.points);
  run.folder.add_text(name, describe_skin(skin, animation, size) + left_out_of(skin), skin.content);
  return {
      {"file", name},
      {"bytes", skin.content.size()},
      {"vertices", skin.vertices},
      {"triangles", skin.triangles},
      {"joints", skin.joints},
      {"moving_joints", skin.moving_joints},
      {"max_influences", skin.influences},
      {"left_out", skin.left_out},
      {"times", animation.times},
      {"position_change", skin.position_change / size},
      {"deformation_error",
       {{"rms", skin.deformation_error.rms / size}, {"max", skin.deformation_error.max / size}}}};
}

}  // namespace

template <int Dim>
void reduce_influences(Run<Dim>& run) {
  const auto poses = points_of(run.poses());
  const auto& model = run.arguments.settings.model;
  const auto& shape = run.shape();
  const auto file = model.empty() ? run.report["mesh"]["file"].template get<std::string>() : model;
  const auto method = reduction_for(run.arguments.reduction, file, shape.edges);
  run.reduced =
      naming(file, [&] { return reduce(run, method, poses, run.arguments.max_influences); });

  const auto& before = run.weights();
  const auto& after = run.reduced.weights;
  const auto error = error_of_reduction(run, poses);
  join(run.reduced, run.arguments.joint, file, run.arguments.quiet ? nullptr : &run.poses());
  if (method != kPoisson) run.reduced.edges = {};  // later reductions are alike
  run.folder.add(kSparseWeights, facts_of(before, after, error, poses.size()),
                 [&](const std::string& path) { io::write_weights(path, after); });
  run.folder.add(kBinding, "weights, cage, and all that other commands need of them",
                 [&](const std::string& path) { io::write_binding(path, run.reduced); });

  const auto json_of = [&](const char* name, const Binding<Dim>& binding) {
    return weights_json(name, run.folder.path_of(name), binding);
  };
  run.report["sparsify"] = {{"method", method},
                            {"max_influences", run.arguments.max_influences},
                            {"deformation_error", {{"rms", error.rms}, {"max", error.max}}},
                            {"before", json_of(kWeights, run.solver.binding())},
                            {"after", json_of(kSparseWeights, run.reduced)}};
}

template <int Dim>
void export_shape(Run<Dim>& run) {
  if (run.shape().surface.triangles.cols() == 0) {
    const std::string reason = "the model has no triangles";
    run.report["export"] = {{"left_out", reason}};
    run.folder.print(kSkin, "left out: " + reason);
    return;
  }
  try {
    run.report["export"] = write_skin(run, kSkin, kFewJoints);
  } catch (const InputError& error) {
    if (run.reduced.solid.empty()) throw;  // so few joints may not surround a region
    run.report["export"] = {{"left_out", error.what()}};
    run.folder.print(kSkin, std::string("left out: ") + error.what());
  }
  if (run.arguments.max_influences <= kFewJoints) return;
  run.report["export"]["full"] = write_skin(run, kFullSkin, kManyJoints);
}

FLBC_INSTANTIATE_FUNCTION(reduce_influences)
FLBC_INSTANTIATE_FUNCTION(export_shape)

}  // namespace flbc::app
