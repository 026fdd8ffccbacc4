// SPDX-License-Identifier: BSD-3-Clause
// flbc fit: the pose of a cage that moves a model to targets.
#include <iostream>
#include <memory>

#include "commands/commands.h"
#include "flbc/errors.h"
#include "front/bound_model.h"
#include "front/load.h"
#include "front/model_facets.h"
#include "poses/outside.h"

namespace flbc::app {
namespace {

struct FitArguments {
  BindingFiles files;
  std::string model, target, joint, output;
  FitOptions options;
  bool quiet = false;
};

template <int Dim>
void fit(const FitArguments& arguments) {
  auto binding =
      load_binding<Dim>(arguments.files, arguments.model, load_model<Dim>(arguments.model), {});
  join(binding, arguments.joint, arguments.model);
  const auto targets = load_model<Dim>(arguments.target);
  const auto found =
      naming(arguments.target, [&] { return binding.fit(targets, arguments.options); });
  write_cage<Dim>(arguments.output, {found.control_points, binding.cage.facets});
  if (arguments.quiet) return;
  std::cerr << arguments.output << ": residual " << found.rms << " (rms), at most " << found.largest
            << " at vertex " << found.worst << "; condition " << found.condition << '\n';
}

}  // namespace

void add_fit_command(CLI::App& app, int&) {
  auto arguments = std::make_shared<FitArguments>();
  auto& a = *arguments;
  auto* command =
      app.add_subcommand("fit", "find the pose of the cage that moves a model to targets");
  command->footer(
      "The result minimizes the sum of squared distances to the targets. With a low condition,\n"
      "errors of the targets stay small in the pose. Stiffness makes neighbors in the cage move\n"
      "alike where the targets do not determine them.");
  command->add_option("MODEL", a.model, "model at rest, or points (.npy .csv)")->required();
  command
      ->add_option("TARGET", a.target,
                   "the same vertices, in the same order, where they should be; with --only, a row "
                   "for each vertex of this list (.npy .csv)")
      ->required();
  command->add_option("--weights", a.files.weights, describe_weight_file())->required();
  add_cage_option(*command, a.files.cage);
  command->add_option("--hold", a.options.held, "control points that stay at rest, such as 0,3,17")
      ->delimiter(',');
  command->add_option("--only", a.options.points, "vertices with targets (default: all)")
      ->delimiter(',');
  command
      ->add_option("--stiffness", a.options.stiffness,
                   "relative to the weights, at least 0 (default: 1e-5)")
      ->check(in_range(0, 1e12));
  add_joint_option(*command, a.joint);
  command->add_option("-o,--output", a.output, "pose of the cage")->required();
  command->add_flag("-q,--quiet", a.quiet, "print only errors");
  command->callback([arguments] {
    require_cage(arguments->files);
    require_writable(arguments->output, {io::Content::kModel});
    require_distinct(
        {arguments->model, arguments->target, arguments->files.weights, arguments->files.cage},
        {arguments->output});
    dimension_of(arguments->files) == 2 ? fit<2>(*arguments) : fit<3>(*arguments);
  });
}

}  // namespace flbc::app
