// SPDX-License-Identifier: BSD-3-Clause
// flbc view: a page in which the cage can be moved.
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>

#include "commands/commands.h"
#include "flbc/errors.h"
#include "flbc/io/weights_io.h"
#include "flbc/poses.h"
#include "flbc/sparsify_error.h"
#include "front/bound_model.h"
#include "front/load.h"
#include "front/model_page.h"
#include "front/movable_model.h"
#include "front/page.h"
#include "front/poses.h"
#include "front/up_axis.h"
#include "help/options.h"
#include "report/sparsify_report.h"

namespace flbc::app {
namespace {

struct ViewArguments {
  std::string model;
  BindingFiles files;
  PoseArguments poses;
  std::optional<Index> max_influences;  // none: by the number of vertices
  UpAxis up = UpAxis::kAuto;
  std::string output;
  bool quiet = false;
};

// Pages beyond that open slowly.
constexpr double kLargePage = 20e6;

void check_arguments(const ViewArguments& arguments) {
  require_mesh_readable(arguments.model);
  require_writable(arguments.output, "html");
}

void check_files(const ViewArguments& arguments, const CageFiles& poses) {
  std::vector<std::string> inputs{arguments.model, arguments.files.weights, arguments.files.cage};
  inputs.insert(inputs.end(), poses.paths.begin(), poses.paths.end());
  require_distinct(inputs, {arguments.output});
}

template <int Dim>
view::PageContent<Dim> load_content(const ViewArguments& arguments, const CageFiles& poses,
                                    const Binding<Dim>& binding, view::ShownModel<Dim> model) {
  view::PageContent<Dim> content;
  content.title = std::filesystem::path(arguments.model).stem().string();
  content.model_file = path_beside(arguments.output, arguments.model);
  content.weights_file = path_beside(arguments.output, arguments.files.weights);
  content.cage_file = path_beside(arguments.output, arguments.files.cage_file());
  content.cage = shown_cage_of(arguments.files, binding);
  content.points = std::move(model.points);
  content.surface = std::move(model.surface);
  look_from_front(content, up_of(arguments.up, arguments.model));
  const auto rest = rest_cage_of(arguments.files, binding);
  content.poses = shown_poses(load_poses(arguments.poses, poses, rest, 1));
  return content;
}

// How far the page moves points elsewhere than the weights given would, if they were reduced.
template <int Dim>
std::string describe_reduction(const view::PageContent<Dim>& content, const SparseWeights& given) {
  const auto before = count_influences(given).max;
  const auto after = count_influences(content.weights).max;
  if (before == after) return "at most " + std::to_string(after) + " influences per vertex";
  const auto error = relative_deformation_error<Dim>(
      content.points, smooth_poses(content.cage.points, kRandomPoses), given, content.weights);
  std::ostringstream text;
  text.precision(3);
  text << "at most " << after << " influences per vertex (before " << before
       << "); deformation error over random smooth poses " << 100 * error.rms
       << "% of the size rms, " << 100 * error.max << "% max";
  return text.str();
}

template <int Dim>
void write_page(const ViewArguments& arguments, const CageFiles& poses) {
  auto model = load_shown_model<Dim>(arguments.model);
  const auto binding = load_binding<Dim>(arguments.files, arguments.model, model.points, {});
  const auto& given = binding.weights;
  auto content = load_content<Dim>(arguments, poses, binding, std::move(model));
  // The page moves larger models on the graphics card, which takes 8 influences per vertex.
  constexpr Eigen::Index kManyVertices = 100'000;
  const Index usual = content.points.cols() > kManyVertices ? 8 : view::kMostInfluences;
  content.weights = naming(arguments.files.weights, [&] {
    return view::limit_influences(binding, arguments.max_influences.value_or(usual));
  });
  const auto page = make_page(content);
  write_text(arguments.output, page);
  const auto bytes = static_cast<double>(page.size());
  if (!arguments.quiet) {
    std::cerr << arguments.output << ": " << content.points.cols() << " vertices, "
              << content.surface.triangles.cols() << " triangles, " << content.poses.size()
              << " poses, " << describe_reduction(content, given) << "; " << bytes / 1e6
              << " MB; open it in a browser\n";
  }
  if (bytes > kLargePage) {
    std::cerr
        << "flbc: " << arguments.output << ": " << bytes / 1e6
        << " MB open slowly; for a smaller page, reduce influences per vertex, for example -k 4\n";
  }
}

}  // namespace

void add_view_command(CLI::App& app, int&) {
  auto arguments = std::make_shared<ViewArguments>();
  auto& a = *arguments;
  auto* command =
      app.add_subcommand("view", "make a page in which you move the cage with the mouse");
  command->footer(
      "The page is one file that any browser opens without a network. It deforms the model like\n"
      "flbc deform and saves poses of the cage as OBJ. Press '?' for keyboard shortcuts.");
  command
      ->add_option("MODEL", a.model,
                   "model (.obj .off .ply .stl .glb .gltf), or domain mesh whose boundary is shown")
      ->required();
  command->add_option("--weights", a.files.weights, describe_weight_file())->required();
  add_cage_option(*command, a.files.cage);
  add_rate_option(*command, a.poses, add_pose_option(*command, a.poses));
  command->add_option(
      "-k,--max-influences", a.max_influences,
      "maximum influences per vertex, up to 16 (default: 16; above 100,000 vertices: 8)");
  add_up_option(*command, a.up);
  command->add_option("-o,--output", a.output, "page: .html")->required();
  command->add_flag("-q,--quiet", a.quiet, "print only errors");
  command->callback([arguments] {
    check_arguments(*arguments);
    const auto files = find_cages(arguments->poses.cages);
    check_files(*arguments, files);
    require_cage(arguments->files);
    dimension_of(arguments->files) == 2 ? write_page<2>(*arguments, files)
                                        : write_page<3>(*arguments, files);
  });
}

}  // namespace flbc::app
