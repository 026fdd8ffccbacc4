// SPDX-License-Identifier: BSD-3-Clause
// flbc solve: from a cage to coordinates.
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands/commands.h"
#include "files/certificate_file.h"
#include "flbc/gradients.h"
#include "flbc/io/files.h"
#include "flbc/io/mesh_io.h"
#include "flbc/io/model_file.h"
#include "flbc/io/weights_io.h"
#include "flbc/quality.h"
#include "front/bound_model.h"
#include "front/load.h"
#include "front/system/held_signals.h"
#include "poses/outside.h"
#include "report/report_json.h"
#include "solve/cage_solver.h"

namespace flbc::app {
namespace {

struct SolveArguments {
  SolveSettings settings;
  std::string output;
  std::string save_domain;
  std::string gradients;
  std::string certificate;
  std::string report;
  bool quiet = false;
};

void check_outputs(const SolveArguments& arguments) {
  const auto& settings = arguments.settings;
  require_writable(arguments.output, {io::Content::kWeights});
  require_writable(arguments.gradients, {io::Content::kWeights});
  require_writable(arguments.certificate, "npz");
  if (arguments.report != "-") require_writable(arguments.report, "json");
  require_distinct({settings.cage, settings.domain, settings.model, settings.locality},
                   {arguments.output, arguments.save_domain, arguments.gradients,
                    arguments.certificate, arguments.report});
}

template <int Dim>
void print_summary(const SolveArguments& arguments, const CageSolver<Dim>& solver,
                   const Quality& delivered) {
  const auto& report = solver.report();
  std::cerr << arguments.output << ": ";
  if (!report.parts.empty()) std::cerr << report.parts.size() << " parts, ";
  std::cerr << report.control_points << " control points, ";
  if (is_meshless(arguments.settings)) {
    std::cerr << solver.binding().points.cols() << " vertices of the model, no mesh; ";
  } else {
    std::cerr << report.vertices << " vertices, " << report.cells
              << (Dim == 2 ? " triangles; " : " tetrahedra; ")
              << describe_iterations(report, arguments.settings) << ", ";
  }
  std::cerr << report.seconds.solve << " s; minimum weight " << delivered.min_weight
            << ", reproduction error " << delivered.max_reproduction_error;
  if (is_certified(report)) {
    std::cerr << ", " << describe_proof(report);
  }
  std::cerr << '\n';
}

// Programs that read VTK show the coordinate functions as fields.
template <int Dim>
void save_domain(const std::string& path, const CageSolver<Dim>& solver) {
  std::vector<io::VertexField> fields;
  if (io::extension_of(path) == "vtu") {
    const auto weights = solver.domain_weights().dense();
    for (Eigen::Index i = 0; i < weights.rows(); ++i) {
      fields.push_back({"w_" + std::to_string(i), weights.row(i)});
    }
    const auto gradients = vertex_gradients(solver.domain(), solver.domain_weights()).dense();
    for (Eigen::Index r = 0; r < gradients.rows(); ++r) {
      fields.push_back({"dw_" + std::to_string(r / Dim) + "_d" + "xyz"[r % Dim], gradients.row(r)});
    }
  }
  io::write_domain(path, solver.domain(), fields);
}

template <int Dim>
void save_gradients(const std::string& path, const CageSolver<Dim>& solver, bool of_model) {
  const auto& domain = solver.domain();
  const auto& weights = solver.domain_weights();
  if (!of_model) return io::write_weights(path, vertex_gradients(domain, weights));
  const auto places = places_in_mesh(solver.cage(), domain, solver.rig().placement());
  io::write_weights(path, gradients_at(domain, weights, places));
}

template <int Dim>
int solve_cage(const Cage<Dim>& cage, const SolveArguments& arguments) {
  const auto& settings = arguments.settings;
  require_writable(arguments.save_domain, {io::kMesh<Dim>});
  PointList<Dim> model;
  EdgeList edges;
  if (!settings.model.empty()) {
    model = load_model<Dim>(settings.model);
    if (!is_point_file(settings.model)) {
      const auto soup = io::read_polygons(settings.model);
      edges = edges_of_polygons(model, soup.polygons, soup.polylines);
    }
  }
  CageSolver<Dim> solver(cage, model, edges, settings);
  solver.make_domain(arguments.quiet);
  if (!arguments.certificate.empty() && count_parts(solver.domain()) > 1) {
    throw InputError(settings.cage +
                     ": a certificate needs a cage in one part; solve each part by itself");
  }
  solver.solve(arguments.quiet);
  const auto& binding = solver.binding();
  if (!arguments.quiet) warn_outside(binding, settings.model);
  const auto delivered = measure_quality(cage.points, binding.points, binding.weights);
  const auto json = arguments.report.empty() ? std::string() : to_text(solver.json(delivered));
  write_binding(arguments.output, binding);
  {
    const HeldSignals held;
    if (!arguments.save_domain.empty()) save_domain(arguments.save_domain, solver);
    if (!arguments.gradients.empty()) {
      save_gradients(arguments.gradients, solver, !settings.model.empty());
    }
    if (!arguments.certificate.empty()) {
      write_certificate(arguments.certificate, cage, solver.domain(), solver.solution());
    }
  }
  if (!arguments.report.empty()) write_text(arguments.report, json);
  if (!arguments.quiet) {
    print_summary(arguments, solver, delivered);
    const bool keeps = binding.policy == OutsidePoints::kKeep;
    if (keeps) warn_border(binding, settings.model, std::vector<Pose<Dim>>{});
  }
  return report_convergence(solver.report(), settings) ? kDone : kNotConverged;
}

}  // namespace

void add_solve_command(CLI::App& app, int& exit_status) {
  auto arguments = std::make_shared<SolveArguments>();
  auto& a = *arguments;
  auto& settings = a.settings;
  auto* command = app.add_subcommand("solve", "compute the coordinates of a cage");
  command->footer(
      "Weights of vertices inside sum to 1 and, except for bbw, reproduce them, converged or not.\n"
      "\n"
      "Examples:\n"
      "  flbc solve cage.obj --model model.obj -o binding.npz\n"
      "  flbc solve cage.obj --vertices 20000 --certify -o certified.mtx");
  command->add_option("CAGE", settings.cage, "closed polylines (2D) or surface (3D)")->required();
  command->option_defaults()->group("Output");
  command->add_option("-o,--output", a.output, describe_weight_file())->required();
  command->add_option("--gradients", a.gradients,
                      "write the gradients of the weights, one row per vertex and a column per "
                      "control point and axis (x, y, z of the first, then of the second)");
  command->add_option("--certificate", a.certificate,
                      "write what others need to prove by how much the objective can exceed "
                      "its minimum: .npz, for scripts/check_certificate.py");
  command->add_option("--report", a.report,
                      "write a report of the solve to this .json file, or to standard output (-)");
  command->add_flag("-q,--quiet", a.quiet, "print only errors");
  command->option_defaults()->group("Domain and model");
  auto* vertices =
      command
          ->add_option("--vertices", settings.vertices, "number of mesh vertices (default: 10000)")
          ->check(refuse_vertex_count);
  auto* domain = command->add_option("--domain", settings.domain,
                                     "use this mesh of the cage interior instead of a new one");
  command->add_option(
      "--save-domain", a.save_domain,
      "write the mesh of the cage interior, in .vtu with the coordinate functions as fields "
      "w_0, w_1, and so on, and their gradients as dw_0_dx, dw_0_dy: " +
          mesh_formats());
  auto* model = command->add_option(
      "--model", settings.model,
      "compute weights at the vertices of this model (default: of the domain mesh)");
  add_solver_options(*command, settings);
  auto* embed =
      command->add_flag("--embed", settings.embed, "use the model vertices as vertices of the mesh")
          ->needs(model);
  domain->excludes(vertices)->excludes(embed);
  command->callback([arguments, command, &exit_status] {
    if (!arguments->certificate.empty()) arguments->settings.options.certify = true;
    validate_settings(arguments->settings);
    arguments->settings.needs_domain =
        !arguments->save_domain.empty() || !arguments->gradients.empty();
    refuse_unread_options(*command, arguments->settings);
    if (!arguments->certificate.empty() && arguments->settings.coordinates) {
      throw OptionError("--certificate: this method minimizes nothing; leave out this option");
    }
    check_outputs(*arguments);
    const auto cage = load_cage(arguments->settings.cage);
    exit_status = std::visit([&](const auto& any) { return solve_cage(any, *arguments); }, cage);
  });
}

}  // namespace flbc::app
