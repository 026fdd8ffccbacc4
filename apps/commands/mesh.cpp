// SPDX-License-Identifier: BSD-3-Clause
// flbc mesh: a cage's interior as triangles or tetrahedra.
#include <iostream>
#include <memory>

#include "commands/commands.h"
#include "flbc/io/mesh_io.h"
#include "front/load.h"
#include "front/make_domain.h"
#include "front/system/held_signals.h"
#include "solve/progress_bar.h"
#include "solve/solve_settings.h"

namespace flbc::app {
namespace {

struct MeshArguments {
  std::string cage;
  std::string output;
  std::string model;
  Index vertices = 0;
  MesherSettings meshing{};
  bool quiet = false;
};

template <int Dim>
void mesh(const Cage<Dim>& cage, const MeshArguments& arguments) {
  require_writable(arguments.output, {io::kMesh<Dim>});
  PointList<Dim> embedded;
  if (!arguments.model.empty()) embedded = load_model<Dim>(arguments.model);
  const auto made = [&] {
    const ProgressBar bar(arguments.quiet, meshing_stage(arguments.meshing.timeout));
    return make_domain<Dim>(
        {cage, arguments.cage, arguments.vertices, arguments.meshing, arguments.model, embedded});
  }();
  const auto& domain = made.mesh;
  {
    const HeldSignals held;
    io::write_domain(arguments.output, domain);
  }
  if (!arguments.quiet) {
    if (!made.note.empty()) std::cerr << "flbc: " << made.note << '\n';
    std::cerr << arguments.output << ": " << domain.num_vertices() << " vertices, "
              << domain.num_cells() << (Dim == 2 ? " triangles\n" : " tetrahedra\n");
  }
}

}  // namespace

void add_mesh_command(CLI::App& app, int&) {
  auto arguments = std::make_shared<MeshArguments>();
  auto* command = app.add_subcommand("mesh", "mesh the interior of a cage");
  command->add_option("CAGE", arguments->cage, "closed polylines (2D) or surface (3D)")->required();
  command->add_option("-o,--output", arguments->output, "domain mesh: " + mesh_formats())
      ->required();
  command->add_option("--vertices", arguments->vertices, "number of mesh vertices (default: 10000)")
      ->check(refuse_vertex_count);
  add_mesher_options(*command, arguments->meshing);
  command->add_option("--model", arguments->model,
                      "use the vertices of this model as vertices of the mesh");
  command->add_flag("-q,--quiet", arguments->quiet, "print only errors");
  command->callback([arguments] {
    require_distinct({arguments->cage, arguments->model}, {arguments->output});
    std::visit([&](const auto& cage) { mesh(cage, *arguments); }, load_cage(arguments->cage));
  });
}

}  // namespace flbc::app
