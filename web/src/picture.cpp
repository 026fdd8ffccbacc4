// SPDX-License-Identifier: BSD-3-Clause
#include "picture.h"

#include <algorithm>
#include <cstring>
#include <map>

#include "flbc/errors.h"
#include "flbc/io/files.h"

namespace flbc {
namespace web {

bool is_picture(const std::string& file) {
  return io::extension_of(file) == "png";
}

app::Mask read_mask(const std::string& file) {
  const auto bytes = io::read_file(file);
  std::uint32_t sizes[2] = {};
  if (bytes.size() >= sizeof sizes) std::memcpy(sizes, bytes.data(), sizeof sizes);
  const auto [width, height] = sizes;
  const std::size_t count = std::size_t(width) * height;
  if (count == 0 || bytes.size() != sizeof sizes + count) {
    throw InputError(file + ": not a decoded picture");
  }
  app::Mask mask{static_cast<Index>(width), static_cast<Index>(height)};
  for (std::size_t y = height; y-- > 0;) {
    for (std::size_t x = 0; x < width; ++x) {
      mask.pixels.push_back(bytes[sizeof sizes + y * width + x] != 0);
    }
  }
  return mask;
}

void spread_picture(io::Model& model, const Vector<2>& low, const Vector<2>& high) {
  auto& attributes = model.attributes;
  attributes.texture_coordinates.resize(2, static_cast<Eigen::Index>(model.soup.points.size()));
  for (std::size_t p = 0; p < model.soup.points.size(); ++p) {
    attributes.texture_coordinates.col(static_cast<Eigen::Index>(p)) =
        (model.soup.points[p].head<2>() - low).cwiseQuotient(high - low);
  }
  for (const auto& polygon : model.soup.polygons) {
    auto& corners = attributes.corners.emplace_back();
    for (const Index p : polygon) corners.push_back({p, -1});
  }
}

io::Model grid_of_picture(const app::Mask& mask) {
  constexpr Index kSquares = 96;  // along the longer side
  const Index step =
      std::max<Index>(1, (std::max(mask.width, mask.height) + kSquares - 1) / kSquares);
  io::Model model;
  std::map<std::pair<Index, Index>, Index> number_of;
  const auto corner = [&](Index x, Index y) {
    x = std::min(x, mask.width);
    y = std::min(y, mask.height);
    const auto [entry, is_new] = number_of.emplace(std::pair(x, y), Index(number_of.size()));
    if (is_new) model.soup.points.emplace_back(x, y, 0);
    return entry->second;
  };
  const auto is_seen = [&](Index left, Index bottom) {
    for (Index y = bottom; y < std::min(bottom + step, mask.height); ++y) {
      for (Index x = left; x < std::min(left + step, mask.width); ++x) {
        if (mask.at(x, y)) return true;
      }
    }
    return false;
  };
  for (Index y = 0; y < mask.height; y += step) {
    for (Index x = 0; x < mask.width; x += step) {
      if (!is_seen(x, y)) continue;
      model.soup.polygons.push_back(
          {corner(x, y), corner(x + step, y), corner(x + step, y + step), corner(x, y + step)});
    }
  }
  spread_picture(model, {0, 0}, {mask.width, mask.height});
  return model;
}

}  // namespace web

// The program reads the file itself.
app::ModelFacets<2> app::load_silhouette(const std::string& file) {
  const auto mask = web::read_mask(file);
  const bool is_whole =
      std::find(mask.pixels.begin(), mask.pixels.end(), false) == mask.pixels.end();
  if (!is_whole) return outline_of(mask, file);
  ModelFacets<2> outline{PointList<2>(2, 4), FacetList<2>(2, 4)};
  outline.points << 0, mask.width, mask.width, 0, 0, 0, mask.height, mask.height;
  outline.facets << 0, 1, 2, 3, 1, 2, 3, 0;
  return outline;
}

}  // namespace flbc
