// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/mesh_io.h"

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <set>

#include "base/messages.h"
#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "flbc/io/polygon_file.h"
#include "mesh/mesh_formats.h"

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

std::string solution_path(const std::string& path) {
  return std::filesystem::path(path).replace_extension(".sol").string();
}

DomainMesh<3> read_medit_with(const std::string& path, std::vector<VertexField>* fields) {
  auto mesh = read_medit(path);
  const std::string solution = solution_path(path);
  if (fields && std::filesystem::exists(solution)) {
    *fields = read_medit_solution(solution, mesh.num_vertices());
  }
  return mesh;
}

// \param fields  may be null
template <int Dim>
DomainMesh<Dim> parse(const std::string& path, std::vector<VertexField>* fields) {
  const std::string extension = extension_of(path);
  if (extension == "vtu") return read_vtu<Dim>(path, fields);
  if constexpr (Dim == 2) {
    if (extension == "obj") return from_soup(path, read_obj(path));
    if (extension == "off") return from_soup(path, read_off(path));
    fail_extension<Dim>("read", path, ".obj, .off or .vtu");
  } else {
    if (extension == "mesh") return read_medit_with(path, fields);
    if (extension == "node" || extension == "ele") return read_tetgen(path);
    if (extension == "msh") return read_gmsh(path);
    fail_extension<Dim>("read", path, ".mesh, .node, .ele, .msh or .vtu");
  }
}

template <int Dim>
DomainMesh<Dim> read_and_validate(const std::string& path, std::vector<VertexField>* fields) {
  DomainMesh<Dim> mesh = parse<Dim>(path, fields);
  try {
    normalize_and_validate(mesh);
  } catch (const InputError& error) {
    throw InputError(path + ": " + error.what());
  }
  return mesh;
}

void check_fields(const std::string& path, const std::vector<VertexField>& fields,
                  Index num_vertices) {
  std::set<std::string> names;
  for (const VertexField& field : fields) {
    const auto fail = [&](const std::string& defect) {
      throw InputError("cannot write \"" + path + "\": the field \"" + field.name + "\" " + defect);
    };
    if (field.values.size() != num_vertices) {
      fail("has " + std::to_string(field.values.size()) + " values for " +
           std::to_string(num_vertices) + " vertices");
    }
    const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 32 || c == 127; };
    if (field.name.empty() || std::any_of(field.name.begin(), field.name.end(), is_control)) {
      fail("needs a name without control characters");
    }
    if (!names.insert(field.name).second) fail("occurs twice");
  }
}

}  // namespace

template <int Dim>
DomainMesh<Dim> read_domain(const std::string& path) {
  return read_and_validate<Dim>(path, nullptr);
}

template <int Dim>
DomainMesh<Dim> read_domain(const std::string& path, std::vector<VertexField>& fields) {
  std::vector<VertexField> read;
  auto mesh = read_and_validate<Dim>(path, &read);
  fields = std::move(read);
  return mesh;
}

template <int Dim>
void write_domain(const std::string& path, const DomainMesh<Dim>& mesh,
                  const std::vector<VertexField>& fields, GmshVersion gmsh_version) {
  const std::string extension = extension_of(path);
  check_fields(path, fields, mesh.num_vertices());
  if (extension == "vtu") {
    return write_file(path, [&](std::ostream& out) { write_vtu(out, mesh, fields); });
  }
  if constexpr (Dim == 3) {
    if (extension == "mesh") {
      // Neither of the two files appears if one of them cannot be written.
      return write_file(path, [&](std::ostream& out) {
        write_medit(out, mesh);
        out.flush();
        if (!out || fields.empty()) return;
        write_file(solution_path(path),
                   [&](std::ostream& solution) { write_medit_solution(solution, fields); });
      });
    }
  }
  if (!fields.empty()) {
    fail_extension<Dim>("write fields with", path, Dim == 2 ? ".vtu" : ".vtu or .mesh");
  }
  if constexpr (Dim == 2) {
    if (extension == "obj") return write_obj(path, to_soup(mesh));
    if (extension == "off") return write_off(path, to_soup(mesh));
    fail_extension<Dim>("write", path, ".obj, .off or .vtu");
  } else {
    if (extension == "node" || extension == "ele") return write_tetgen(path, mesh);
    if (extension == "msh") {
      return write_file(path, [&](std::ostream& out) { write_gmsh(out, mesh, gmsh_version); });
    }
    fail_extension<Dim>("write", path, ".mesh, .node, .ele, .msh or .vtu");
  }
}

#define FLBC_INSTANTIATE(Dim)                                                          \
  template DomainMesh<Dim> read_domain(const std::string&);                            \
  template DomainMesh<Dim> read_domain(const std::string&, std::vector<VertexField>&); \
  template void write_domain(const std::string&, const DomainMesh<Dim>&,               \
                             const std::vector<VertexField>&, GmshVersion);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::io
