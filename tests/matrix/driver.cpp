// SPDX-License-Identifier: BSD-3-Clause
// The doors of C++ and OpenMesh for matrix_test.py:
//   matrix_driver cpp|openmesh OPERATION FOLDER METHOD
// FOLDER has cage.obj, model.obj, other.obj, pose.obj, and reshaped.obj. Files of the results go
// there.
#include <array>
#include <fstream>
#include <iostream>
#include <string>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include "flbc/binding.h"
#include "flbc/io/binding_file.h"
#include "flbc/io/cage_io.h"
#include "flbc/io/model_file.h"
#include "flbc/make_domain.h"
#include "flbc/openmesh/bind.h"
#include "flbc/openmesh/skin.h"
#include "flbc/report.h"
#include "flbc/rig.h"
#include "gltf/skin.h"
#include "model/surface.h"

namespace flbc {
namespace {

struct Task {
  std::string operation, folder, method;
  std::string path(const std::string& name) const { return folder + "/" + name; }
};

template <int Dim>
struct Shape {
  io::PolygonSoup soup;
  PointList<Dim> points;
  EdgeList edges;
  explicit Shape(const std::string& path)
      : soup(io::read_polygons(path)),
        points(io::to_points<Dim>(soup, path)),
        edges(edges_of_polygons(points, soup.polygons, soup.polylines)) {}
};

// The masks in masks.csv: a control point and a vertex per line.
std::vector<Mask> read_masks(const Task& task) {
  std::ifstream file(task.path("masks.csv"));
  std::vector<Mask> masks;
  Index i = 0, p = 0;
  for (char comma = 0; file >> i >> comma >> p;) masks.push_back({{i}, {p}});
  return masks;
}

BindOptions options_of(const Task& task) {
  BindOptions options;
  options.vertices = 800;
  options.max_influences = 0;
  options.outside = OutsidePoints::kKeep;
  options.mirror_axis = 0;
  options.coordinates = value_named<Coordinates>(task.method);
  if (options.coordinates) return options;
  if (task.method == "solid") {
    options.mirror_axis = -1;
    std::ifstream file(task.path("solid.csv"));
    options.solid.emplace_back();
    for (Index p = 0; file >> p;) options.solid[0].push_back(p);
    return options;
  }
  options.masks = read_masks(task);
  options.solver.falloff = 0.1;
  return options;
}

void write_columns(const std::string& path, const Eigen::MatrixXd& columns) {
  std::ofstream file(path);
  file.precision(17);
  for (const auto& column : columns.colwise()) {
    for (Eigen::Index d = 0; d < column.size(); ++d) file << (d > 0 ? "," : "") << column[d];
    file << '\n';
  }
}

template <int Dim>
Cage<Dim> read_cage(const std::string& path) {
  return std::get<Cage<Dim>>(io::to_cage(io::read_polygons(path), path));
}

template <int Dim>
void finish(const Task& task, const Binding<Dim>& binding, const Shape<Dim>& model) {
  io::write_binding(task.path("result.npz"), binding);
  if (task.operation == "deform") {
    const auto pose = Shape<Dim>(task.path("pose.obj")).points;
    write_columns(task.path("moved.csv"), binding.deform(pose));
    write_columns(task.path("jacobians.csv"), binding.jacobians(pose));
  }
  if (task.operation == "export") {
    const auto surface = gltf::surface_of_model<Dim>({model.soup});
    gltf::SkinOptions options;
    options.max_influences = 4;
    std::ofstream(task.path("result.glb"), std::ios::binary)
        << gltf::export_skin(binding, surface, options).content;
    options.rigid = task.method == "solid";
    std::ofstream(task.path("rigid.glb"), std::ios::binary)
        << gltf::export_skin(binding, surface, options).content;
  }
}

template <int Dim>
void run_cpp(const Task& task) {
  const auto cage = read_cage<Dim>(task.path("cage.obj"));
  const Shape<Dim> model(task.path("model.obj"));
  Rig<Dim> rig(cage, model.points, model.edges, options_of(task), linked_meshers<Dim>());
  auto binding = rig.binding();
  if (task.operation == "reduce8") binding = binding.reduced({8});
  if (task.operation == "reduce4") binding = binding.reduced({4});
  if (task.operation == "joint") binding = binding.joined({});
  if (task.operation == "transfer") {
    const Shape<Dim> other(task.path("other.obj"));
    binding = binding.transferred(other.points, other.edges, OutsidePoints::kKeep);
  }
  if (task.operation == "transfer_nearest") {
    const Shape<Dim> other(task.path("other.obj"));
    std::vector<std::array<Index, 3>> corners;
    for (const auto& polygon : model.soup.polygons) {
      for (std::size_t k = 2; k < polygon.size(); ++k) {
        corners.push_back({polygon[0], polygon[k - 1], polygon[k]});
      }
    }
    const FacetList<3> elements = Eigen::Map<const FacetList<3>>(
        corners.front().data(), 3, static_cast<Eigen::Index>(corners.size()));
    binding = binding.transferred(elements, other.points, other.edges, 1);
  }
  if (task.operation == "reshape") {
    rig.reshape(read_cage<Dim>(task.path("reshaped.obj")).points);
    binding = rig.binding();
  }
  if (task.operation == "save") {
    io::write_binding(task.path("saved.npz"), binding);
    binding = std::get<Binding<Dim>>(io::read_binding(task.path("saved.npz")));
  }
  finish(task, binding, model);
}

template <int Dim>
void run_openmesh(const Task& task) {
  const Shape<Dim> model(task.path("model.obj"));
  OpenMesh::PolyMesh_ArrayKernelT<> mesh;
  for (const auto& point : model.soup.points) {
    mesh.add_vertex(OpenMesh::PolyMesh_ArrayKernelT<>::Point(static_cast<float>(point.x()),
                                                             static_cast<float>(point.y()),
                                                             static_cast<float>(point.z())));
  }
  for (const auto& polygon : model.soup.polygons) {
    std::vector<OpenMesh::VertexHandle> corners;
    for (const Index v : polygon) corners.emplace_back(v);
    mesh.add_face(corners);
  }
  openmesh::BindOptions options;
  static_cast<BindOptions&>(options) = options_of(task);
  const auto cage = read_cage<Dim>(task.path("cage.obj"));
  openmesh::bind(mesh, cage, options);
  if (task.operation == "reduce8") openmesh::sparsify(mesh, 8);
  if (task.operation == "reduce4") openmesh::sparsify(mesh, 4);
  if (task.operation == "joint") {
    auto known = openmesh::get_binding<Dim>(mesh);
    known.cage = cage;  // with its facets
    openmesh::set_binding(mesh, known.joined({}), 0);
  }
  if (task.operation == "save") {
    auto copy = mesh;
    mesh = copy;
  }
  if (task.operation == "export") {
    openmesh::SkinOptions skin;
    skin.max_influences = 4;
    openmesh::write_skin(task.path("result.glb"), mesh, skin);
  }
  if (task.operation == "transfer" || task.operation == "transfer_nearest" ||
      task.operation == "reshape") {
    throw OptionError("OpenMesh: use flbc::Binding and flbc::Rig");
  }
  const auto binding = openmesh::get_binding<Dim>(mesh);
  io::write_binding(task.path("result.npz"), binding);
  if (task.operation != "deform") return;
  const auto pose = Shape<Dim>(task.path("pose.obj")).points;
  openmesh::deform(mesh, pose);
  Eigen::MatrixXd moved(Dim, mesh.n_vertices());
  for (const auto vertex : mesh.vertices()) {
    for (int d = 0; d < Dim; ++d) moved(d, vertex.idx()) = mesh.point(vertex)[d];
  }
  write_columns(task.path("moved.csv"), moved);
}

}  // namespace
}  // namespace flbc

int main(int count, char** arguments) {
  if (count != 5) return 1;
  const flbc::Task task{arguments[2], arguments[3], arguments[4]};
  const bool is_flat = flbc::io::read_polygons(task.path("cage.obj")).polygons.empty();
  try {
    if (arguments[1] == std::string("cpp")) {
      is_flat ? flbc::run_cpp<2>(task) : flbc::run_cpp<3>(task);
    } else {
      is_flat ? flbc::run_openmesh<2>(task) : flbc::run_openmesh<3>(task);
    }
  } catch (const flbc::Error& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
  return 0;
}
