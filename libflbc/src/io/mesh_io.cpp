// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/mesh_io.h"

#include <ostream>

#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "flbc/io/polygon_file.h"
#include "format.h"
#include "mesh_formats.h"

namespace flbc::io {
namespace {

template <int Dim>
[[noreturn]] void fail_extension(const char* action, const std::string& path,
                                 const char* extensions) {
  throw OptionError(std::string("cannot ") + action + " a " + std::to_string(Dim) + "D mesh as \"" +
                    path + "\": the extension must be " + extensions);
}

DomainMesh<2> from_soup(const std::string& path, const PolygonSoup& soup) {
  DomainMesh<2> mesh;
  mesh.points.resize(2, static_cast<Eigen::Index>(soup.points.size()));
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    if (soup.points[v][2] != 0) {
      throw InputError(path + ": vertex " + std::to_string(v) + " at " +
                       format_point(soup.points[v]) + " does not lie in the plane z = 0");
    }
    mesh.points.col(v) = soup.points[v].head<2>();
  }
  mesh.cells.resize(3, static_cast<Eigen::Index>(soup.polygons.size()));
  for (std::size_t s = 0; s < soup.polygons.size(); ++s) {
    const std::vector<Index>& corners = soup.polygons[s];
    if (corners.size() != 3) {
      throw InputError(path + ": face " + std::to_string(s) + " has " +
                       std::to_string(corners.size()) +
                       " vertices, but a domain mesh consists of triangles");
    }
    mesh.cells.col(s) = Eigen::Map<const Eigen::Matrix<Index, 3, 1>>(corners.data());
  }
  return mesh;
}

PolygonSoup to_soup(const DomainMesh<2>& mesh) {
  PolygonSoup soup;
  soup.points.reserve(static_cast<std::size_t>(mesh.num_vertices()));
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    soup.points.emplace_back(mesh.points(0, v), mesh.points(1, v), 0.0);
  }
  soup.polygons.reserve(static_cast<std::size_t>(mesh.num_cells()));
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    soup.polygons.push_back({mesh.cells(0, s), mesh.cells(1, s), mesh.cells(2, s)});
  }
  return soup;
}

template <int Dim>
DomainMesh<Dim> parse(const std::string& path) {
  const std::string extension = extension_of(path);
  if constexpr (Dim == 2) {
    if (extension == "obj") return from_soup(path, read_obj(path));
    if (extension == "off") return from_soup(path, read_off(path));
    fail_extension<Dim>("read", path, ".obj or .off");
  } else {
    if (extension == "mesh") return read_medit(path);
    if (extension == "node" || extension == "ele") return read_tetgen(path);
    if (extension == "msh") return read_gmsh(path);
    fail_extension<Dim>("read", path, ".mesh, .node, .ele or .msh");
  }
}

}  // namespace

template <int Dim>
DomainMesh<Dim> read_domain(const std::string& path) {
  DomainMesh<Dim> mesh = parse<Dim>(path);
  try {
    normalize_and_validate(mesh);
  } catch (const InputError& error) {
    throw InputError(path + ": " + error.what());
  }
  return mesh;
}

template <int Dim>
void write_domain(const std::string& path, const DomainMesh<Dim>& mesh,
                  const std::vector<VertexField>& fields) {
  const std::string extension = extension_of(path);
  if (extension == "vtu") {
    return write_file(path, [&](std::ostream& out) { write_vtu(out, mesh, fields); });
  }
  if constexpr (Dim == 2) {
    if (extension == "obj") return write_obj(path, to_soup(mesh));
    if (extension == "off") return write_off(path, to_soup(mesh));
    fail_extension<Dim>("write", path, ".obj, .off or .vtu");
  } else {
    if (extension == "node" || extension == "ele") return write_tetgen(path, mesh);
    if (extension == "mesh") {
      return write_file(path, [&](std::ostream& out) { write_medit(out, mesh); });
    }
    if (extension == "msh") {
      return write_file(path, [&](std::ostream& out) { write_gmsh(out, mesh); });
    }
    fail_extension<Dim>("write", path, ".mesh, .node, .ele, .msh or .vtu");
  }
}

template DomainMesh<2> read_domain(const std::string&);
template DomainMesh<3> read_domain(const std::string&);
template void write_domain(const std::string&, const DomainMesh<2>&,
                           const std::vector<VertexField>&);
template void write_domain(const std::string&, const DomainMesh<3>&,
                           const std::vector<VertexField>&);

}  // namespace flbc::io
