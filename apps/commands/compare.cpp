// SPDX-License-Identifier: BSD-3-Clause
// flbc compare: several kinds of coordinates of a cage next to each other.
#include <omp.h>
#include <iostream>
#include <memory>

#include "commands/commands.h"
#include "compare/comparison.h"
#include "flbc/errors.h"
#include "flbc/version.h"
#include "front/load.h"
#include "front/model_page.h"
#include "front/poses.h"
#include "report/report_json.h"

namespace flbc::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kComparisonPage = "index.html";

template <int Dim>
std::vector<std::string> names_of_results(const CompareArguments& arguments,
                                          const std::vector<Column<Dim>>& columns) {
  auto names = names_of_grids(arguments);
  names.insert(names.end(), {domain_file<Dim>(), kComparisonPage, kComparisonReport});
  for (const auto& column : columns) names.push_back(column.weights_file());
  return names;
}

template <int Dim>
void load_shape_and_pose(Comparison<Dim>& all) {
  const auto& arguments = all.arguments;
  if (!arguments.pose.empty()) {
    all.pose = RestCage<Dim>(arguments.cage).load_pose(arguments.pose);
  }
  if (arguments.model.empty()) return;
  auto model = load_shown_model<Dim>(arguments.model);
  all.shape.points = std::move(model.points);
  all.shape.surface = std::move(model.surface);
}

template <int Dim>
Json report_of(const Comparison<Dim>& all) {
  Json report{{"command", "compare"},
              {"version", FLBC_VERSION},
              {"cage", all.arguments.cage},
              {"model", all.arguments.model},
              {"vertices", all.domain.num_vertices()},
              {"cells", all.domain.num_cells()},
              {"threads", omp_get_max_threads()},
              {"control_point", all.control_point},
              {"columns", Json::object()},
              {"failures", Json::object()}};
  for (const auto& column : all.columns) {
    if (column.failure.empty()) {
      report["columns"][column.name] = column.facts;
    } else {
      report["failures"][column.name] = column.failure;
    }
  }
  return report;
}

template <int Dim>
int compare_in(const Cage<Dim>& cage, const CompareArguments& arguments) {
  up_axis(arguments.up, cage.points);  // an axis that 2D does not have is an error
  auto columns = columns_of<Dim>(arguments.methods);
  if (arguments.control_point != -1) require_control_point(arguments.control_point, cage.size());
  RunFolder folder(arguments.output, {{arguments.cage, arguments.model, arguments.pose},
                                      names_of_results(arguments, columns),
                                      arguments.force,
                                      arguments.quiet,
                                      "compare",
                                      kComparisonReport});
  Comparison<Dim> all{arguments, cage, folder};
  all.columns = std::move(columns);
  load_shape_and_pose(all);
  solve_columns(all);
  const auto pictures = draw_grids(all);
  folder.add_text(kComparisonPage, "open in a browser: table and pictures",
                  comparison_page(all, pictures));
  auto report = report_of(all);
  folder.add_report(report, "the table for programs");
  if (!arguments.quiet) std::cerr << comparison_text(all);
  return kDone;
}

}  // namespace

void add_compare_command(CLI::App& app, int& exit_status) {
  auto arguments = std::make_shared<CompareArguments>();
  auto& a = *arguments;
  auto* command =
      app.add_subcommand("compare", "compare several kinds of coordinates of the same cage");
  command->footer(
      "OUTDIR receives a table (table.json), pictures of one coordinate function and of the pose\n"
      "by all methods, weights, and index.html, a page with the table and the pictures. A method\n"
      "that fails is listed with the reason; the others continue. Green coordinates also need\n"
      "normals, so they have no file of weights. flbc view draws a page in which the cage can be\n"
      "moved by the weights of a method.");
  command->add_option("CAGE", a.cage, "closed polylines (2D) or surface (3D)")->required();
  command->add_option("MODEL", a.model,
                      "model inside the cage (default: the mesh of the cage interior)");
  command->option_defaults()->group("Output");
  command->add_option("-o,--output", a.output, "folder for all results")
      ->required()
      ->type_name("OUTDIR");
  command->add_flag("--force", a.force, "replace files in OUTDIR that are not from an earlier run");
  command->add_flag("-q,--quiet", a.quiet, "print only errors");
  add_choice(*command, "--pictures", {"png", "svg", "pdf"}, a.pictures,
             "format of the pictures (default: png)");
  add_up_option(*command, a.up);
  command->add_option("--control-point", a.control_point,
                      "control point to draw, counted from 0 (default: the one that moves most)");
  command->option_defaults()->group("Comparison");
  command
      ->add_option("--methods", a.methods,
                   "coordinates, separated by commas (default: all). local: the default of flbc "
                   "solve")
      ->delimiter(',')
      ->check(CLI::IsMember(comparable_methods()))
      ->type_name("local|harmonic|bbw|meanvalue|maxentropy|maxlikelihood|green|blended");
  command->add_option("--pose", a.pose,
                      "deformed cage for pictures, distortion, and seconds per frame");
  command->add_option("--vertices", a.vertices, "number of mesh vertices (default: 10000)")
      ->check(refuse_vertex_count);
  add_mesher_options(*command, a.meshing);
  command->callback([arguments, &exit_status] {
    const auto cage = load_cage(arguments->cage);
    arguments->up = up_of(arguments->up, arguments->model);
    exit_status = std::visit([&](const auto& any) { return compare_in(any, *arguments); }, cage);
  });
}

}  // namespace flbc::app
