// SPDX-License-Identifier: BSD-3-Clause
// flbc cage: a cage from a model, or from a defective one.
#include <filesystem>
#include <iostream>
#include <memory>

#include "commands/commands.h"
#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "flbc/io/model_file.h"
#include "flbc/io/weights_io.h"
#include "front/facts.h"
#include "front/load.h"
#include "front/model_facets.h"
#include "front/system/held_signals.h"
#include "solve/make_cage.h"

namespace flbc::app {
namespace {

struct CageArguments {
  std::string model;
  std::string defective;  // a cage to be repaired instead
  std::string output;
  std::string density;
  CagingOptions options;
  bool quiet = false;
};

template <int Dim>
Eigen::VectorXd load_density(const CageArguments& arguments, const ModelFacets<Dim>& model) {
  const auto& path = arguments.density;
  const WeightMatrix rows = io::read_weights(path).dense();
  Facts problem;
  if (rows.rows() != 1 || rows.cols() != model.num_vertices()) {
    problem << "holds " << rows.cols() << " rows of " << rows.rows()
            << " numbers; a density is a number for each of " << model.num_vertices()
            << " vertices of " << arguments.model;
  }
  for (Index v = 0; problem.text().empty() && v < rows.cols(); ++v) {
    if (rows(0, v) >= 1 / kMaxCageDensity && rows(0, v) <= kMaxCageDensity) continue;
    problem << "the density of vertex " << v << " is " << rows(0, v)
            << "; give numbers from 0.01 to 100, 1 is usual";
  }
  if (!problem.text().empty()) throw InputError(path + ": " + problem.text());
  return model.left_of(rows.transpose());
}

template <int Dim>
void cage(const ModelFacets<Dim>& model, const CageArguments& arguments) {
  require_cage_writable<Dim>(arguments.output);
  auto options = arguments.options;
  if (!arguments.density.empty()) options.density = load_density(arguments, model);
  const auto made = make_cage(arguments.model, model, options, arguments.quiet);
  {
    const HeldSignals held;
    write_cage(arguments.output, made.cage, model.height);
  }
  if (!arguments.quiet) std::cerr << arguments.output << ": " << describe(made) << '\n';
}

// The file of the numbers that control points have got.
std::string numbers_file(const std::string& output) {
  return std::filesystem::path(output).replace_extension("numbers.txt").string();
}

// A line per old control point: its number and the new one, or -1.
void write_numbers(const std::string& path, const std::vector<Index>& new_numbers) {
  io::write_file(path, [&](std::ostream& file) {
    for (std::size_t v = 0; v < new_numbers.size(); ++v) file << v << ' ' << new_numbers[v] << '\n';
  });
}

template <int Dim>
void repair(const Cage<Dim>& cage, std::vector<std::string> changes,
            const CageArguments& arguments) {
  require_cage_writable<Dim>(arguments.output);
  const auto repaired = repair_defects(arguments.defective, cage);
  const auto numbers = numbers_file(arguments.output);
  require_distinct({arguments.defective}, {arguments.output, numbers});
  {
    const HeldSignals held;
    write_cage(arguments.output, repaired.cage);
    if (!repaired.keeps_numbers) write_numbers(numbers, repaired.new_numbers);
  }
  if (arguments.quiet) return;
  changes.insert(changes.end(), repaired.changes.begin(), repaired.changes.end());
  if (changes.empty()) changes.emplace_back("no defects found");
  const auto note =
      note_many_vertices(arguments.defective, static_cast<std::size_t>(repaired.cage.size()));
  if (!note.empty()) {
    std::cerr << "flbc: " << note << "; to make a cage around a model, leave out --repair\n";
  }
  for (const auto& change : changes) std::cerr << arguments.defective << ": " << change << '\n';
  std::cerr << arguments.output << ": " << repaired.cage.size() << " control points, "
            << repaired.cage.facets.cols() << (Dim == 2 ? " edges" : " triangles")
            << (repaired.keeps_numbers ? ", numbered as before\n"
                                       : ", their new numbers are in " + numbers + "\n");
  if (repaired.changes.empty()) return;
  std::cerr << arguments.output << ": " << describe(repaired, static_cast<Index>(cage.size()))
            << '\n';
}

void repair_file(const CageArguments& arguments) {
  std::vector<std::string> changes;
  auto soup = io::read_polygons(arguments.defective);
  if (!soup.polygons.empty() && !soup.polylines.empty()) {
    changes.push_back(std::to_string(soup.polylines.size()) +
                      " polylines next to the surface were removed");
    soup.polylines.clear();
  }
  const auto cage = io::to_cage(soup, arguments.defective);
  std::visit([&](const auto& any) { repair(any, changes, arguments); }, cage);
}

void check_arguments(const CageArguments& arguments) {
  if (arguments.model.empty() == arguments.defective.empty()) {
    throw OptionError("MODEL to enclose is missing, or a cage with --repair");
  }
  require_distinct({arguments.model, arguments.defective, arguments.density}, {arguments.output});
}

}  // namespace

void add_cage_command(CLI::App& app, int&) {
  auto arguments = std::make_shared<CageArguments>();
  auto& a = *arguments;
  auto* command = app.add_subcommand("cage", "make a cage around a model, or repair a cage");
  command->footer(
      "The cage is closed, does not intersect itself, and strictly encloses every vertex,\n"
      "edge, and face of the model, even if the model has defects. If all vertices of the\n"
      "model have the same z, the cage is 2D. --repair keeps the numbers of control points\n"
      "where possible. Otherwise it writes a line \"OLD NEW\" for each control point to a file\n"
      "next to the result.\n"
      "\n"
      "Examples:\n"
      "  flbc cage model.obj --control-points 60 -o new_cage.obj\n"
      "  flbc cage --repair cage.obj -o repaired.obj");
  auto* model = command->add_option(
      "MODEL", a.model,
      "model to enclose: .obj .off .ply .stl .glb .gltf .svg, or a .png with a silhouette");
  command->add_option("-o,--output", a.output, "cage: .obj; in 3D also .off and .ply")->required();
  auto* count = command->add_option(
      "--control-points", a.options.control_points,
      "maximum number of control points (default: depends on the shape, 12 to 60 in 2D, 8 to 300 "
      "in 3D)");
  count->check(refuse_vertex_count)->needs(model);
  auto* offset = command->add_option(
      "--offset", a.options.offset,
      "distance from the model, in its units (default: depends on the number of control points)");
  offset->needs(model);
  add_symmetric_option(*command, a.options.symmetry)->needs(model);
  auto* density = command->add_option(
      "--density", a.density,
      "relative density of control points at each vertex of MODEL: .csv or .npy of numbers "
      "from 0.01 to 100, 1 as usual, 4 for four times as many");
  density->needs(model);
  command->add_option(
      "--repair", a.defective,
      "repair this defective cage: weld, orient, fill holes, and unite crossing parts, and list "
      "every change; wrap it as a last resort");
  command->add_flag("-q,--quiet", a.quiet, "print only errors");
  command->callback([arguments] {
    check_arguments(*arguments);
    if (!arguments->defective.empty()) return repair_file(*arguments);
    std::visit([&](const auto& any) { cage(any, *arguments); },
               load_model_facets(arguments->model));
  });
}

}  // namespace flbc::app
