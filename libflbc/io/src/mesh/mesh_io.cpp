// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/mesh_io.h"

#include <algorithm>
#include <set>

#include "base/messages.h"
#include "flbc/errors.h"
#include "flbc/io/model_file.h"
#include "formats/format_table.h"
#include "mesh/mesh_formats.h"

namespace flbc::io {
namespace {

DomainMesh<2> from_soup(const std::string& path, const PolygonSoup& soup) {
  DomainMesh<2> mesh;
  mesh.points.resize(2, static_cast<Eigen::Index>(soup.points.size()));
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    if (soup.points[v][2] != 0) {
      throw InputError(path + ": vertex " + std::to_string(v) + " at " +
                       format_point(soup.points[v]) + " is not in the plane z = 0");
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

template <int Dim>
const MeshFormat<Dim>& mesh_format(const std::string& path, const char* action) {
  const auto phrase = std::string(action) + " a " + std::to_string(Dim) + "D mesh as";
  return format_of(path, kMesh<Dim>, phrase.c_str()).template mesh<Dim>();
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

DomainMesh<2> read_triangles(const std::string& path) {
  return from_soup(path, read_polygons(path));
}

void write_triangles(const std::string& path, const DomainMesh<2>& mesh,
                     const std::vector<VertexField>&) {
  write_model(path, {to_polygons(mesh)});
}

template <int Dim>
PolygonSoup to_polygons(const DomainMesh<Dim>& mesh) {
  PolygonSoup soup;
  for (const auto& point : mesh.points.colwise()) {
    soup.points.push_back(Vector<3>::Zero());
    soup.points.back().template head<Dim>() = point;
  }
  if constexpr (Dim == 2) {
    for (const auto& cell : mesh.cells.colwise()) {
      soup.polygons.emplace_back(cell.begin(), cell.end());
    }
  } else {
    // The facet opposite to each vertex of a positively oriented cell, seen from outside.
    constexpr Index kFacets[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
    const auto topology = build_topology(mesh);
    for (Index s = 0; s < mesh.num_cells(); ++s) {
      for (int k = 0; k < 4; ++k) {
        if (!topology.is_boundary(topology.cell_facets(k, s))) continue;
        const auto& [a, b, c] = kFacets[k];
        soup.polygons.push_back({mesh.cells(a, s), mesh.cells(b, s), mesh.cells(c, s)});
      }
    }
  }
  return soup;
}

template <int Dim>
DomainMesh<Dim> read_domain(const std::string& path) {
  DomainMesh<Dim> mesh = mesh_format<Dim>(path, "read").read(path);
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
  const auto& format = mesh_format<Dim>(path, "write");
  check_fields(path, fields, mesh.num_vertices());
  if (!fields.empty() && !format.keeps_fields) {
    throw OptionError("cannot write fields with \"" + path +
                      "\": this format does not support them; choose from " +
                      extensions_of({Content::kFields}));
  }
  format.write(path, mesh, fields);
}

#define FLBC_INSTANTIATE(Dim)                                            \
  template PolygonSoup to_polygons(const DomainMesh<Dim>&);              \
  template DomainMesh<Dim> read_domain(const std::string&);              \
  template void write_domain(const std::string&, const DomainMesh<Dim>&, \
                             const std::vector<VertexField>&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::io
