// SPDX-License-Identifier: BSD-3-Clause
#include "paper/setting.h"

#include <filesystem>
#include <set>
#include <variant>

#include "flbc/io/cage_io.h"
#include "flbc/io/mesh_io.h"
#include "flbc/io/model_file.h"
#include "paper/stopwatch.h"

namespace flbc::bench {

std::string cage_path(const Context& context, const Model& model) {
  return context.models + "/" + model.cage;
}

std::string domain_path(const Context& context, const Model& model, Index vertices) {
  return context.out + "/meshes/" + model.name + "-" + std::to_string(vertices) +
         (model.dim == 2 ? ".obj" : ".mesh");
}

bool prepare_domain(const Context& context, const Model& model, Index vertices) {
  static std::set<std::string> done;
  const auto path = domain_path(context, model, vertices);
  if (done.count(path) > 0) return true;
  const auto meshed = in_child(path, [&]() -> std::string {
    std::filesystem::create_directories(context.out + "/meshes");
    const auto file = cage_path(context, model);
    const auto any = io::to_cage(io::read_polygons(file), file);
    std::visit([&](const auto& cage) { io::write_domain(path, mesh_of(cage, vertices)); }, any);
    return "";
  });
  if (meshed) done.insert(path);
  return meshed.has_value();
}

template <int Dim>
Setting<Dim> load_setting(const Context& context, const Model& model, Index vertices) {
  const auto file = cage_path(context, model);
  auto cage = std::get<Cage<Dim>>(io::to_cage(io::read_polygons(file), file));
  auto mesh = io::read_domain<Dim>(domain_path(context, model, vertices));
  Stopwatch watch;
  auto problem = make_problem(std::move(cage), std::move(mesh), DistanceScheme::kSquare);
  return {model, vertices, std::move(problem), watch.seconds()};
}

template Setting<2> load_setting(const Context&, const Model&, Index);
template Setting<3> load_setting(const Context&, const Model&, Index);

}  // namespace flbc::bench
