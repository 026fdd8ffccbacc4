// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/model.h"

namespace flbc::io {
namespace {

// Vertex values also exist for vertices without polygons.
template <int Dim>
bool are_of_vertices(const PointList<Dim>& values, const Model& model,
                     Index CornerReferences::*reference) {
  if (values.cols() != static_cast<Eigen::Index>(model.soup.points.size())) return false;
  for (std::size_t f = 0; f < model.soup.polygons.size(); ++f) {
    for (std::size_t k = 0; k < model.soup.polygons[f].size(); ++k) {
      if (model.attributes.corners[f][k].*reference != model.soup.polygons[f][k]) return false;
    }
  }
  return true;
}

template <int Dim>
std::optional<PointList<Dim>> at_vertices(const PointList<Dim>& values, const Model& model,
                                          Index CornerReferences::*reference) {
  if (values.cols() == 0 || are_of_vertices(values, model, reference)) return values;
  const auto num_points = static_cast<Eigen::Index>(model.soup.points.size());
  PointList<Dim> result = PointList<Dim>::Zero(Dim, num_points);
  std::vector<bool> is_known(model.soup.points.size(), false);
  for (std::size_t f = 0; f < model.soup.polygons.size(); ++f) {
    for (std::size_t k = 0; k < model.soup.polygons[f].size(); ++k) {
      const Index value = model.attributes.corners[f][k].*reference;
      const Index vertex = model.soup.polygons[f][k];
      if (value < 0 || (is_known[vertex] && result.col(vertex) != values.col(value))) return {};
      result.col(vertex) = values.col(value);
      is_known[vertex] = true;
    }
  }
  return result;
}

}  // namespace

std::optional<PointList<2>> texture_coordinates_at_vertices(const Model& model) {
  return at_vertices(model.attributes.texture_coordinates, model,
                     &CornerReferences::texture_coordinate);
}

std::optional<PointList<3>> normals_at_vertices(const Model& model) {
  return at_vertices(model.attributes.normals, model, &CornerReferences::normal);
}

}  // namespace flbc::io
