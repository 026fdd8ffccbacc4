// SPDX-License-Identifier: BSD-3-Clause
// flbc check: defects of a cage, quality of weights.
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands/commands.h"
#include "flbc/cage_facts.h"
#include "flbc/cage_from_model.h"
#include "flbc/errors.h"
#include "flbc/io/mesh_io.h"
#include "flbc/io/model_file.h"
#include "flbc/io/weights_io.h"
#include "front/bound_model.h"
#include "front/load.h"
#include "front/model_facets.h"
#include "report/check_report.h"
#include "report/report_json.h"

namespace flbc::app {
namespace {

struct CheckArguments {
  std::string cage;
  std::string model;
  std::string weights;
  std::string domain;
  std::string json;
};

void check_arguments(const CheckArguments& arguments) {
  if (!arguments.weights.empty() && arguments.model.empty() && arguments.domain.empty()) {
    throw OptionError(
        "--weights: --model or --domain is missing, whose vertices have these weights");
  }
  if (arguments.json != "-") require_writable(arguments.json, "json");
  require_distinct({arguments.cage, arguments.model, arguments.weights, arguments.domain},
                   {arguments.json});
}

template <int Dim>
void check_model(CheckReport<Dim>& report) {
  auto points = load_model<Dim>(report.model_file);
  auto outside = points_outside(report.cage, points);
  NearestOnCage<Dim> farthest;
  for (const auto& point : nearest_on_cage(report.cage, points, outside)) {
    if (farthest.point < 0 || point.distance() > farthest.distance()) farthest = point;
  }
  auto reach = least_reach(report.cage, points);
  report.model = ModelCheck<Dim>{std::move(points), std::move(outside), farthest, reach};
#ifdef FLBC_LINKS_CGAL
  if (is_point_file(report.model_file)) return;  // there are no facets with gaps between them
  const auto model = load_model_facets(report.model_file);
  if (const auto* own = std::get_if<ModelFacets<Dim>>(&model)) {
    const auto made = naming(report.model_file, [&] {
      return with_bridged_gaps<Dim>(report.cage, own->points, own->facets);
    });
    report.model->bridged_gaps = describe_bridged_gaps(made);
  }
#endif
}

template <int Dim>
void check_weight_file(CheckReport<Dim>& report, const SparseWeights& weights) {
  const auto check_sizes_with = [&](const std::string& file, Eigen::Index num_points) {
    check_sizes(weights, report.cage.size(), num_points,
                {report.weights_file, report.cage_file, file});
  };
  if (report.domain_file.empty()) {
    const auto& points = report.model->points;
    check_sizes_with(report.model_file, points.cols());
    check_weights_of(report, points, weights);
  } else {
    const auto domain = io::read_domain<Dim>(report.domain_file);
    check_sizes_with(report.domain_file, domain.num_vertices());
    naming(report.domain_file, [&] { check_weights_of(report, domain, weights); });
  }
}

// The table, unless the standard output is wanted for JSON.
template <int Dim>
void deliver(const CheckReport<Dim>& report, const std::string& json_file) {
  const auto json = check_json(report);
  if (json_file != "-") {
    print_check(std::cout, json);
    if (!report.defects.empty() && !(report.model_file + report.weights_file).empty()) {
      std::cout << "The other checks need a sound cage and were skipped.\n";
    }
  }
  if (!json_file.empty()) write_text(json_file, to_text(json));
}

template <int Dim>
int check(const Cage<Dim>& cage, const io::PolygonSoup& soup, const CheckArguments& arguments) {
  auto report = check_cage(cage, arguments.cage);
  if (Dim == 3) name_faces(report.defects, soup);
  report.model_file = arguments.model;
  report.domain_file = arguments.domain;
  report.weights_file = arguments.weights;
  if (report.defects.empty()) {
    if (!arguments.model.empty()) check_model(report);
    if (!arguments.weights.empty()) check_weight_file(report, io::read_weights(arguments.weights));
  }
  deliver(report, arguments.json);
  if (!report.defects.empty()) {
    std::cerr << "flbc: " << arguments.cage << ": " << report.defects.front().message << '\n';
  }
  for (const auto& violation : report.violations) {
    std::cerr << "flbc: " << arguments.weights << ": " << violation << '\n';
  }
  return report.is_fine() ? kDone : kBadInput;
}

}  // namespace

void add_check_command(CLI::App& app, int& exit_status) {
  auto arguments = std::make_shared<CheckArguments>();
  auto& a = *arguments;
  auto* command =
      app.add_subcommand("check", "find defects of a cage, of a model inside it, and of weights");
  command->footer(
      "Exit status: 2 for a defective cage, or for weights that are not coordinates of the cage.\n"
      "Negative weights, local extrema, and a model outside the cage are only reported.");
  command->add_option("CAGE", a.cage, "closed polylines (2D) or surface (3D)")->required();
  command->add_option("--model", a.model, "model that should be inside the cage");
  auto* weights = command->add_option(
      "--weights", a.weights, "weights at the vertices of --domain if given, else of --model");
  command->add_option("--domain", a.domain, "mesh of the cage interior")->needs(weights);
  command->add_option("--json", a.json,
                      "write the findings to this .json file, or to standard output (-)");
  command->callback([arguments, &exit_status] {
    check_arguments(*arguments);
    const auto soup = io::read_polygons(arguments->cage);
    const auto cage = io::to_cage(soup, arguments->cage);
    exit_status = std::visit([&](const auto& any) { return check(any, soup, *arguments); }, cage);
  });
}

}  // namespace flbc::app
