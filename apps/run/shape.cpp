// SPDX-License-Identifier: BSD-3-Clause
#include "run/shape.h"

#include <filesystem>

#include "files/load.h"
#include "files/load_surface.h"
#include "flbc/errors.h"

namespace flbc::app {
namespace {

// Points and lines have none, and are fine nevertheless.
bool has_surface(const io::PolygonSoup& soup) {
  for (const auto& polygon : soup.polygons) {
    if (polygon.size() >= 3) return true;
  }
  return false;
}

}  // namespace

template <int Dim>
Shape<Dim> load_shape(const std::string& path) {
  const std::filesystem::path file(path);
  const MovedFile moved{path, path};
  require_formats(moved);
  require_formats_of<Dim>(moved);
  const auto soup = load_polygons(path);
  Shape<Dim> shape{file.stem().string(), file.extension().string()};
  shape.file = std::make_unique<MovableModel<Dim>>(moved);
  shape.points = shape.file->points();
  if (shape.points.cols() == 0) throw InputError(path + ": the model has no vertices");
  shape.edges =
      naming(path, [&] { return edges_of_polygons(shape.points, soup.polygons, soup.polylines); });
  if (has_surface(soup)) shape.surface = load_surface<Dim>(path).surface;
  return shape;
}

template <int Dim>
Shape<Dim> shape_of(const DomainMesh<Dim>& domain) {
  Shape<Dim> shape{"domain", domain_extension<Dim>()};
  shape.points = domain.points;
  shape.edges = edges_of_cells(domain);
  shape.surface = gltf::surface_of_domain(domain);
  return shape;
}

template Shape<2> load_shape(const std::string&);
template Shape<3> load_shape(const std::string&);
template Shape<2> shape_of(const DomainMesh<2>&);
template Shape<3> shape_of(const DomainMesh<3>&);

}  // namespace flbc::app
