// SPDX-License-Identifier: BSD-3-Clause
#include "model/model_scan.h"

#include <algorithm>
#include <cmath>

namespace flbc::io {

PlacedNumbers next_numbers(TextReader& reader, std::size_t size, int needed, TripleKind kind,
                           int most) {
  PlacedNumbers result;
  auto& places = result.places;
  for (int k = 0; k < 3; ++k) {
    // Separate words, because a line may be continued in the middle.
    if (k >= most) {
      places[k].form = NumberForm::kInteger;  // cannot be stored
    } else if (reader.has_word() || k < needed) {
      places[k] = {size - reader.bytes_left(), static_cast<std::uint32_t>(reader.peek().size()),
                   NumberForm::kText};
      result.values[k] = kind == TripleKind::kPoint ? reader.number() : reader.any_number();
    } else if (k > 0) {
      places[k] = {places[k - 1].begin + places[k - 1].size, 0, NumberForm::kText};
    }
  }
  return result;
}

void add_sites(ModelScan& scan, const std::array<NumberPlace, 3>& places, TripleKind kind,
               Index index) {
  for (std::uint8_t d = 0; d < 3; ++d) scan.sites.push_back({places[d], kind, d, index});
}

void refer_to_vertices(Model& model) {
  const bool has_texture = model.attributes.texture_coordinates.cols() > 0;
  const bool has_normals = model.attributes.normals.cols() > 0;
  if (!has_texture && !has_normals) return;
  for (const auto& polygon : model.soup.polygons) {
    auto& corners = model.attributes.corners.emplace_back();
    for (const Index vertex : polygon) {
      corners.push_back({has_texture ? vertex : -1, has_normals ? vertex : -1});
    }
  }
}

void add_other(Model& model, const std::string& phrase) {
  auto& others = model.others;
  if (std::find(others.begin(), others.end(), phrase) == others.end()) others.push_back(phrase);
}

template <int Dim>
void keep_finite(Model& model, PointList<Dim>& attributes) {
  for (auto column : attributes.colwise()) {
    if (column.allFinite()) continue;
    column.setZero();
    add_other(model, "attributes that are not finite");
  }
}

template void keep_finite<2>(Model&, PointList<2>&);
template void keep_finite<3>(Model&, PointList<3>&);

bool are_colors(const PointList<3>& numbers) {
  return (numbers.array() >= 0 && numbers.array() <= 1).all();
}

void keep_colors_in_range(Model& model) {
  auto& colors = model.attributes.colors;
  if (are_colors(colors)) return;
  colors.resize(3, 0);
  add_other(model, "colors out of range");
}

int level_of(double intensity) {
  return static_cast<int>(std::lround(255 * std::clamp(intensity, 0.0, 1.0)));
}

VertexAttributes::VertexAttributes(const Model& model)
    : normals(normals_at_vertices(model).value_or(PointList<3>())),
      texture(texture_coordinates_at_vertices(model).value_or(PointList<2>())),
      colors(model.attributes.colors) {
}

}  // namespace flbc::io
