// SPDX-License-Identifier: BSD-3-Clause
#include "front/model_facets.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "flbc/bounding_box.h"
#include "flbc/io/cage_io.h"
#include "flbc/io/files.h"
#include "flbc/io/model_file.h"
#include "flbc/io/splat_file.h"
#include "flbc/placement.h"
#include "front/instantiate.h"
#include "front/load.h"

namespace flbc::app {
namespace {

bool is_flat(const io::PolygonSoup& soup) {
  return std::all_of(soup.points.begin(), soup.points.end(),
                     [&](const Vector<3>& point) { return point.z() == soup.points.front().z(); });
}

// Of polygons and polylines, each once.
std::set<std::pair<Index, Index>> edges_of(const io::PolygonSoup& soup, bool with_polygons) {
  std::set<std::pair<Index, Index>> edges;
  const auto add = [&](Index a, Index b) { edges.insert(std::minmax(a, b)); };
  for (const auto& line : soup.polylines) {
    for (std::size_t k = 1; k < line.size(); ++k) add(line[k - 1], line[k]);
  }
  for (const auto& polygon : soup.polygons) {
    if (!with_polygons && polygon.size() > 2) continue;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      add(polygon[k], polygon[(k + 1) % polygon.size()]);
    }
  }
  return edges;
}

FacetList<2> flat_facets(const io::PolygonSoup& soup) {
  const auto edges = edges_of(soup, true);
  FacetList<2> facets(2, edges.size());
  Index e = 0;
  for (const auto& [a, b] : edges) facets.col(e++) << a, b;
  return facets;
}

// The corners of all voxels with points, which enclose the points and are far fewer.
PointList<3> voxel_corners(const PointList<3>& points) {
  if (points.cols() == 0) return points;
  constexpr double kVoxels = 128;  // along the diagonal
  const Vector<3> low = points.rowwise().minCoeff();
  const double size = std::max(bounding_box_diagonal(points) / kVoxels, 1e-30);
  std::vector<std::array<int, 3>> corners;
  for (const auto& point : points.colwise()) {
    const Eigen::Vector3i voxel = ((point - low) / size).array().floor().cast<int>();
    corners.push_back({voxel.x(), voxel.y(), voxel.z()});
  }
  const auto drop_copies = [&] {
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  };
  drop_copies();
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t count = corners.size();
    for (std::size_t k = 0; k < count; ++k) {
      auto corner = corners[k];
      ++corner[axis];
      corners.push_back(corner);
    }
  }
  drop_copies();
  PointList<3> result(3, static_cast<Eigen::Index>(corners.size()));
  for (std::size_t k = 0; k < corners.size(); ++k) {
    result.col(static_cast<Eigen::Index>(k)) =
        low + size * Eigen::Map<const Eigen::Vector3i>(corners[k].data()).cast<double>();
  }
  return result;
}

// Renumbers the points that polygons and polylines use. \return the others, which stay if there are
// only points
std::vector<Index> drop_unused(io::PolygonSoup& soup) {
  std::vector<Index> unused;
  if (soup.polygons.empty() && soup.polylines.empty()) return unused;
  std::vector<bool> is_used(soup.points.size(), false);
  for (const auto* lists : {&soup.polygons, &soup.polylines}) {
    for (const auto& list : *lists) {
      for (const Index v : list) is_used[v] = true;
    }
  }
  std::vector<Index> number(soup.points.size(), -1);
  Index used = 0;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (!is_used[v]) {
      unused.push_back(static_cast<Index>(v));
      continue;
    }
    number[v] = used;
    soup.points[used++] = soup.points[v];
  }
  soup.points.resize(used);
  for (auto* lists : {&soup.polygons, &soup.polylines}) {
    for (auto& list : *lists) {
      for (Index& v : list) v = number[v];
    }
  }
  return unused;
}

}  // namespace

bool is_picture_file(const std::string& path) {
  const auto extension = io::extension_of(path);
  return extension == "png" || extension == "jpg" || extension == "jpeg";
}

AnyModelFacets load_model_facets(const std::string& path) {
  if (is_picture_file(path)) return load_silhouette(path);
  if (io::is_splat_file(path)) {
    const auto corners = voxel_corners(io::SplatFile(path).points());
    if (corners.cols() == 0) throw InputError(path + ": the model has no vertices");
    return ModelFacets<3>{corners, {}};
  }
  auto soup = io::read_polygons(path);
  if (soup.points.empty()) throw InputError(path + ": the model has no vertices");
  auto unused = drop_unused(soup);
  if (is_flat(soup)) {
    return ModelFacets<2>{io::to_points<2>(soup, path), flat_facets(soup), soup.points[0].z(),
                          std::move(unused)};
  }
  return ModelFacets<3>{io::to_points<3>(soup, path), triangles_of(soup), 0, std::move(unused)};
}

FacetList<3> triangles_of(const io::PolygonSoup& soup) {
  std::vector<Eigen::Matrix<Index, 3, 1>> triangles;
  for (const auto& polygon : soup.polygons) {
    if (polygon.size() < 3) continue;
    const auto parts = io::cut_polygon(soup.points, polygon);
    triangles.insert(triangles.end(), parts.colwise().begin(), parts.colwise().end());
  }
  for (const auto& [a, b] : edges_of(soup, false)) triangles.emplace_back(a, b, b);
  FacetList<3> facets(3, triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) facets.col(t) = triangles[t];
  return facets;
}

FacetList<3> elements_of(const io::PolygonSoup& soup) {
  auto corners = triangles_of(soup);
  std::vector<bool> is_used(soup.points.size(), false);
  for (const Index corner : corners.reshaped()) is_used[corner] = true;
  auto element = corners.cols();
  corners.conservativeResize(Eigen::NoChange,
                             element + std::count(is_used.begin(), is_used.end(), false));
  for (std::size_t p = 0; p < is_used.size(); ++p) {
    if (!is_used[p]) corners.col(element++).setConstant(static_cast<Index>(p));
  }
  return corners;
}

template <int Dim>
ModelElements<Dim> load_model_elements(const std::string& path) {
  const auto soup = io::read_polygons(path);
  if (soup.points.empty()) throw InputError(path + ": the model has no vertices");
  return {io::to_points<Dim>(soup, path), elements_of(soup)};
}

template <int Dim>
void write_cage(const std::string& path, const Cage<Dim>& cage, double height) {
  io::write_model(path, {io::cage_polygons(cage, height)});
}

template <int Dim>
void require_cage_writable(const std::string& path) {
  using Extensions = std::vector<std::string>;
  require_writable(path, Dim == 2 ? Extensions{"obj"} : Extensions{"obj", "off", "ply"});
}

FLBC_INSTANTIATE_FUNCTION(load_model_elements)
FLBC_INSTANTIATE_FUNCTION(write_cage)
FLBC_INSTANTIATE_FUNCTION(require_cage_writable)

}  // namespace flbc::app
