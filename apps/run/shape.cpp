// SPDX-License-Identifier: BSD-3-Clause
#include "run/shape.h"

#include <filesystem>

#include "flbc/errors.h"

namespace flbc::app {
template <int Dim>
Shape<Dim> load_shape(const std::string& path) {
  const std::filesystem::path file(path);
  if (!io::holds(path, {io::Content::kModel})) {
    throw OptionError(path + ": cannot tell the format; a model must end in " +
                      io::extensions_of({io::Content::kModel}));
  }
  Shape<Dim> shape{file.stem().string(), file.extension().string()};
  shape.file = std::make_unique<MovableModel<Dim>>(MovedFile{path, path});
  shape.points = shape.file->points();
  if (shape.points.cols() == 0) throw InputError(path + ": the model has no vertices");
  shape.edges = shape.file->edges();
  // Points and lines have none, and are fine nevertheless.
  if (!shape.file->model()->soup.polygons.empty()) shape.surface = shape.file->surface();
  return shape;
}

template <int Dim>
Shape<Dim> shape_of(const DomainMesh<Dim>& domain) {
  Shape<Dim> shape{"domain", domain_extension<Dim>()};
  shape.points = domain.points;
  shape.edges = edges_of_cells(domain);
  shape.surface = gltf::surface_of_model<Dim>({io::to_polygons(domain)});
  return shape;
}

template Shape<2> load_shape(const std::string&);
template Shape<3> load_shape(const std::string&);
template Shape<2> shape_of(const DomainMesh<2>&);
template Shape<3> shape_of(const DomainMesh<3>&);

}  // namespace flbc::app
