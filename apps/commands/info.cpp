// SPDX-License-Identifier: BSD-3-Clause
// flbc info: what is in a file.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <numeric>

#include "commands/commands.h"
#include "flbc/errors.h"
#include "flbc/io/cage_io.h"
#include "flbc/io/weights_io.h"
#include "flbc/meshing.h"
#include "flbc/quality.h"
#include "front/estimate.h"
#include "front/gltf_facts.h"
#include "front/load.h"
#include "front/make_domain.h"
#include "front/movable_model.h"

namespace flbc::app {
namespace {

void print_box(const Eigen::MatrixXd& points) {
  const Eigen::RowVectorXd low = points.rowwise().minCoeff().transpose();
  const Eigen::RowVectorXd high = points.rowwise().maxCoeff().transpose();
  constexpr int kDigits = 10;  // corners far from the origin need them
  const Eigen::IOFormat row(kDigits, Eigen::DontAlignCols, ", ", ", ", "", "", "(", ")");
  std::cout << "  from " << low.format(row) << " to " << high.format(row) << '\n';
}

// Fewer columns than a cage has control points, or rows that are no weights: points.
bool are_points(const WeightMatrix& rows) {
  const auto is_one = [](const auto& row) { return std::abs(row.sum() - 1) < kInfluenceThreshold; };
  const auto columns = rows.colwise();
  return rows.rows() == 2 ||
         (rows.rows() == 3 && !std::all_of(columns.begin(), columns.end(), is_one));
}

void print_weights(const std::string& path) {
  const WeightMatrix weights = io::read_weights(path).dense();
  if (weights.size() > 0 && are_points(weights)) {
    std::cout << path << ": " << weights.cols() << " points in " << weights.rows() << "D\n";
    return print_box(weights);
  }
  std::cout << path << ": weights of " << weights.cols() << " points for " << weights.rows()
            << " control points\n";
  if (weights.size() == 0) return;
  const auto influences = (weights.array().abs() > kInfluenceThreshold).count();
  std::cout << "  minimum " << weights.minCoeff() << ", maximum " << weights.maxCoeff()
            << "\n  largest |sum - 1| " << (weights.colwise().sum().array() - 1).abs().maxCoeff()
            << "\n  influences above 1e-4 per vertex "
            << static_cast<double>(influences) / static_cast<double>(weights.cols()) << '\n';
}

template <int Dim>
void print_domain(const std::string& path, const DomainMesh<Dim>& domain) {
  const auto topology = build_topology(domain);
  const auto on_boundary = boundary_vertices(topology, domain.num_vertices());
  double measure = 0;
  for (Index s = 0; s < domain.num_cells(); ++s) measure += signed_measure(domain, s);
  std::cout << path << ": mesh of " << domain.num_vertices() << " vertices ("
            << std::count(on_boundary.begin(), on_boundary.end(), false) << " inside), "
            << domain.num_cells() << (Dim == 2 ? " triangles, area " : " tetrahedra, volume ")
            << measure << '\n';
  print_box(domain.points);
}

struct InfoArguments {
  std::string path;
  bool estimates = false;
  Index vertices = 10000;
};

// The coarsest mesh of a cage with many control points has more vertices than most meshes.
template <int Dim>
Index vertices_of_solve(const Cage<Dim>& cage, Index wanted) {
  if constexpr (Dim == 3) {
    try {
      return std::max(wanted, make_domain<Dim>({cage, {}, 1}).mesh.num_vertices());
    } catch (const Error&) {  // the solve will refuse the cage
    }
  }
  return std::max(wanted, cage.size());
}

template <int Dim>
void print_cage(const Cage<Dim>& cage, const InfoArguments& arguments) {
  constexpr std::size_t kMost = 16;
  const auto defects = defects_of(cage, kMost);
  if (defects.empty()) {
    std::cout << "  a sound " << Dim << "D cage of " << cage.size() << " control points and "
              << cage.facets.cols() << (Dim == 2 ? " edges\n" : " triangles\n");
    if (!arguments.estimates) return;
    const Index vertices = vertices_of_solve(cage, arguments.vertices);
    std::cout << "  a solve on " << vertices << " mesh vertices takes "
              << describe(estimate_solve(Dim, cage.size(), vertices, {})) << '\n';
    return;
  }
  std::cout << "  not a cage:\n";
  for (const auto& defect : defects) std::cout << "    " << defect.message << '\n';
}

void print_polygons(const InfoArguments& arguments) {
  const auto& path = arguments.path;
  const auto soup = io::read_polygons(path);
  std::cout << path << ": " << soup.points.size() << " vertices, " << soup.polygons.size()
            << " polygons, " << soup.polylines.size() << " polylines\n";
  if (soup.points.empty()) return;
  print_box(io::to_points<3>(soup, path));
  constexpr std::size_t kMostFacets = 100000;  // the check of a scan would take minutes
  const auto num_facets = std::accumulate(
      soup.polylines.begin(), soup.polylines.end(), soup.polygons.size(),
      [](std::size_t sum, const auto& polyline) { return sum + polyline.size() - 1; });
  if (num_facets > kMostFacets) {
    std::cout << "  not checked as a cage, because it has more than " << kMostFacets
              << " facets; flbc check does\n";
    return;
  }
  try {
    std::visit([&](const auto& cage) { print_cage(cage, arguments); }, io::to_cage(soup, path));
  } catch (const InputError& error) {
    std::cout << "  not a cage:\n    " << error.what() << '\n';
  }
}

void print_info(const InfoArguments& arguments) {
  const auto& path = arguments.path;
  if (io::holds(path, {io::Content::kWeights})) return print_weights(path);
  if (is_gltf_file(path)) {
    std::cout << describe_gltf(path);
    return;
  }
  if (io::holds(path, {io::Content::kModel}) || !io::holds(path, kMeshFiles)) {
    return print_polygons(arguments);
  }
  std::visit([&](const auto& any) { print_domain(path, any.mesh()); },
             load_any_model({path, path}));
}

}  // namespace

void add_info_command(CLI::App& app, int&) {
  auto arguments = std::make_shared<InfoArguments>();
  auto& a = *arguments;
  auto* command =
      app.add_subcommand("info", "show what a cage, mesh, model, skin, or weight file contains");
  command->add_option("FILE", a.path, "file to show")->required();
  auto* estimate = command->add_flag("--estimate", a.estimates,
                                     "estimate the time and the memory of a solve for a cage");
  command
      ->add_option("--vertices", a.vertices,
                   "number of mesh vertices for --estimate (default: 10000)")
      ->check(refuse_vertex_count)
      ->needs(estimate);
  command->callback([arguments] { print_info(*arguments); });
}

}  // namespace flbc::app
