// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <map>
#include <utility>

#include "flbc/errors.h"
#include "front/model_facets.h"

namespace flbc::app {

ModelFacets<2> outline_of(const Mask& mask, const std::string& path) {
  const auto seen = std::count(mask.pixels.begin(), mask.pixels.end(), true);
  if (seen == 0) throw InputError(path + ": all pixels are transparent");
  if (seen == static_cast<std::ptrdiff_t>(mask.pixels.size())) {
    throw InputError(path + ": no pixel is transparent; the lowest alpha is " +
                     std::to_string(mask.lowest_alpha) +
                     " of 255. A silhouette needs a transparent background");
  }
  std::map<std::pair<Index, Index>, Index> number_of;
  std::vector<std::pair<Index, Index>> corners;
  const auto corner = [&](Index x, Index y) {
    const auto [entry, is_new] = number_of.emplace(std::pair(x, y), Index(corners.size()));
    if (is_new) corners.emplace_back(x, y);
    return entry->second;
  };
  constexpr std::size_t kMostEdges = 4'000'000;  // noise has more, shapes have far fewer
  std::vector<std::pair<Index, Index>> edges;
  for (Index y = 0; y <= mask.height; ++y) {
    if (edges.size() > kMostEdges) {
      throw InputError(path +
                       ": the silhouette has more than 4,000,000 pixel edges; remove noise "
                       "from the transparency");
    }
    for (Index x = 0; x <= mask.width; ++x) {
      const bool own = mask.at(x, y);
      if (own != mask.at(x, y - 1)) edges.emplace_back(corner(x, y), corner(x + 1, y));
      if (own != mask.at(x - 1, y)) edges.emplace_back(corner(x, y), corner(x, y + 1));
    }
  }
  ModelFacets<2> model{PointList<2>(2, corners.size()), FacetList<2>(2, edges.size())};
  for (std::size_t v = 0; v < corners.size(); ++v) {
    model.points.col(v) << corners[v].first, corners[v].second;
  }
  for (std::size_t e = 0; e < edges.size(); ++e) {
    model.facets.col(e) << edges[e].first, edges[e].second;
  }
  return model;
}

}  // namespace flbc::app
