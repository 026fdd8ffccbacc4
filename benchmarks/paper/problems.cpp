// SPDX-License-Identifier: BSD-3-Clause
#include "problems.h"

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <variant>

#include "flbc/io/cage_io.h"
#include "flbc/io/mesh_io.h"
#include "flbc/io/model_file.h"
#include "flbc/io/weights_io.h"

namespace flbc::bench {
namespace {

template <int Dim>
MeshingOptions<Dim> meshing_options(Index vertices) {
  MeshingOptions<Dim> options;
  options.vertices = vertices;
  return options;
}

// The hash FNV-1a of the numbers of some matrices.
template <class... Matrices>
std::string hash_of(const Matrices&... matrices) {
  std::uint64_t state = 14695981039346656037U;
  const auto add = [&](const auto& matrix) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(matrix.data());
    const auto size = static_cast<std::size_t>(matrix.size()) * sizeof(*matrix.data());
    for (std::size_t k = 0; k < size; ++k) state = (state ^ bytes[k]) * 1099511628211U;
  };
  (add(matrices), ...);
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(state));
  return digits;
}

}  // namespace

const std::vector<Model>& models() {
  static const std::vector<Model> kModels = {
      {"logo", 2, "2d/LBClogo-control-edgeset.obj", 26800, {3.18e-4, 4.94, 5.72e-5, 2.78}},
      {"woody",
       2,
       "2d/woody-control-edgeset.obj",
       10800,
       {2.43e-4, 19.30, 2.30e-4, 12.43, 1.723e-10}},
      {"cactus",
       2,
       "2d/cactus-control-edgeset.obj",
       10850,
       {5.87e-4, 22.60, 2.2e-4, 16.98, 4.083e-10}},
      {"horse", 3, "3d/horse_cage.obj", 5850, {1.66e-5, 39.35, 1.21e-5, 21.87}},
      {"armadillo", 3, "3d/armadillo_cage.obj", 6640, {5.2e-5, 134.65, 4.16e-5, 120.85}},
      {"shark", 3, "3d/shark_cage.obj", 6000},
      {"beast", 3, "3d/beast_cage.obj", 6000},
  };
  return kModels;
}

const Model& model(const std::string& name) {
  for (const auto& candidate : models()) {
    if (candidate.name == name) return candidate;
  }
  throw std::out_of_range("no model is called " + name);
}

const std::vector<NamedMethod>& methods() {
  static const std::vector<NamedMethod> kMethods = {
      {"lbc2014", Method::kLbc2014, 10}, {"lbc2014-tuned", Method::kLbc2014, 0},
      {"paper", Method::kPaper, 0},      {"gradient", Method::kGradient, 0},
      {"weights", Method::kWeights, 0},
  };
  return kMethods;
}

DomainMesh<2> mesh_of(const Cage<2>& cage, Index vertices) {
  return triangulate(cage, meshing_options<2>(vertices));
}

DomainMesh<3> mesh_of(const Cage<3>& cage, Index vertices) {
  return tetrahedralize(cage, meshing_options<3>(vertices));
}

template <int Dim>
Cage<Dim> read_cage(const std::string& file) {
  return std::get<Cage<Dim>>(io::to_cage(io::read_polygons(file), file));
}
template Cage<2> read_cage(const std::string&);
template Cage<3> read_cage(const std::string&);

std::string cage_path(const Context& context, const Model& model) {
  return std::filesystem::path(context.models) / model.cage;  // the latter may be absolute
}

std::string domain_path(const Model& model, const std::string& name) {
  return "meshes/" + name + (model.dim == 2 ? ".obj" : ".mesh");
}

void prepare_domain(const Context& context, const Model& model, const std::string& name,
                    Index vertices) {
  static std::set<std::string> done;
  if (!done.insert(name).second) return;
  in_child("mesh: " + name, [&]() -> Rows {
    const auto write = [&](const auto& cage) {
      io::write_domain(context.out + "/" + domain_path(model, name), mesh_of(cage, vertices));
    };
    std::filesystem::create_directories(context.out + "/meshes");
    std::filesystem::remove(context.out + "/" + domain_path(model, name));
    const auto file = cage_path(context, model);
    std::visit(write, io::to_cage(io::read_polygons(file), file));
    return {};
  });
}

template <int Dim>
Setting<Dim> load_setting(const Context& context, const Model& model, const std::string& name) {
  auto cage = read_cage<Dim>(cage_path(context, model));
  auto mesh = io::read_domain<Dim>(context.out + "/" + domain_path(model, name));
  const Stopwatch watch;
  auto problem = make_problem(std::move(cage), std::move(mesh), DistanceScheme::kSquare, 0);
  return {context, model, name, std::move(problem), watch.seconds()};
}
template Setting<2> load_setting(const Context&, const Model&, const std::string&);
template Setting<3> load_setting(const Context&, const Model&, const std::string&);

SolverOptions optimum_options(const Context& context, double smoothness, NonNegative non_negative) {
  SolverOptions options;
  options.smoothness = smoothness;
  options.precision = Precision::kDouble;
  options.non_negative = non_negative;
  // The estimate is too good in the long tail: at 1e-14 the error is some 1e-11 (see README.md).
  options.tolerance = context.quick ? 1e-9 : 1e-14;
  options.max_iterations = context.quick ? 1000 : 3000;
  options.certify = true;
  options.threads = context.threads;
  return options;
}

template <int Dim>
Reference reference(const Setting<Dim>& setting) {
  const auto& problem = setting.problem;
  const auto& context = setting.context;
  // phi is there so that a change in how the library measures distances makes old references stale.
  const auto hash = hash_of(problem.cage.points, problem.cage.facets, problem.mesh.points,
                            problem.mesh.cells, problem.phi.dense());
  const auto stem = context.out + "/references/" + setting.name + "-" + hash +
                    (problem.smoothness > 0 ? "-smooth" : "") + (context.quick ? "-quick" : "");
  // The gap is written last: with it, everything is there.
  if (std::filesystem::exists(stem + "-gap.npy")) {
    return {io::read_weights(stem + ".npy"), io::read_weights(stem + "-gap.npy").at(0)[0]};
  }
  auto solution =
      solve(problem, optimum_options(context, problem.smoothness, NonNegative::kConstraint));
  const double gap = solution.report.certificate.relative_gap;
  std::filesystem::create_directories(context.out + "/references");
  io::write_weights(stem + ".npy", solution.weights);
  io::write_weights(stem + "-gap.npy", WeightMatrix::Constant(1, 1, gap));
  return {std::move(solution.weights), gap};
}
template Reference reference(const Setting<2>&);
template Reference reference(const Setting<3>&);

}  // namespace flbc::bench
