// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/meshing.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/instantiate.h"
#include "base/messages.h"
#include "cage/point_in_cage.h"
#include "flbc/cage_facts.h"
#include "flbc/domain_mesh.h"
#include "flbc/errors.h"

namespace flbc {
namespace {

// Per part, the indices of the points in it, ascending.
template <int Dim>
std::vector<std::vector<Index>> points_in(const std::vector<CagePart<Dim>>& parts,
                                          const PointList<Dim>& points) {
  std::vector<std::vector<Index>> inside(parts.size());
  std::vector<CageLocator<Dim>> locators;
  locators.reserve(parts.size());
  for (const auto& part : parts) locators.emplace_back(part.cage, 0);
  for (Index i = 0; i < points.cols(); ++i) {
    const auto found =
        std::find_if(locators.begin(), locators.end(), [&](const CageLocator<Dim>& locator) {
          return locator.locate(points.col(i)) == Containment::kInside;
        });
    if (found == locators.end()) {
      throw InputError("point " + std::to_string(i) + " at " + format_point(points.col(i)) +
                       " cannot be embedded: it is outside all parts of the cage");
    }
    inside[found - locators.begin()].push_back(i);
  }
  return inside;
}

// Proportional to area or volume; 0 stays 0.
template <int Dim>
std::vector<Index> share_vertices(Index vertices, const std::vector<CagePart<Dim>>& parts) {
  std::vector<double> measures;
  double whole = 0;
  for (const auto& part : parts) {
    measures.push_back(measure_cage(part.cage).measure);
    whole += measures.back();
  }
  std::vector<Index> shares(parts.size(), 0);
  for (std::size_t p = 0; p < parts.size() && vertices > 0; ++p) {
    shares[p] = std::max<Index>(1, static_cast<Index>(std::lround(vertices * measures[p] / whole)));
  }
  return shares;
}

template <int Dim>
DomainMesh<Dim> mesh_part(std::size_t number, std::size_t count, const CagePart<Dim>& part,
                          const MeshingOptions<Dim>& options, const PartMesher<Dim>& mesher) {
  try {
    return mesher(part.cage, options);
  } catch (const InputError& error) {
    throw InputError("part " + std::to_string(number + 1) + " of " + std::to_string(count) +
                     ", with control point " + std::to_string(part.control_points.front()) +
                     " at " + format_point(part.cage.points.col(0)) + ": " + error.what());
  }
}

}  // namespace

template <int Dim>
DomainMesh<Dim> mesh_in_parts(const Cage<Dim>& cage, const MeshingOptions<Dim>& options,
                              const PartMesher<Dim>& mesher) {
  const auto parts = cage_parts(cage);
  if (parts.size() == 1) return mesher(cage, options);
  const auto embedded = points_in(parts, options.embedded_points);
  const auto vertices = share_vertices(options.vertices, parts);
  Index next = cage.size() + static_cast<Index>(options.embedded_points.cols());  // next free index
  std::vector<MeshPart<Dim>> meshes;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    auto of_part = options;
    of_part.vertices = vertices[p];
    of_part.embedded_points = options.embedded_points(Eigen::all, embedded[p]);
    auto mesh = mesh_part(p, parts.size(), parts[p], of_part, mesher);
    // Indices in the whole mesh: control points, embedded points, then others.
    auto numbers = parts[p].control_points;
    for (const Index i : embedded[p]) numbers.push_back(cage.size() + i);
    while (static_cast<Index>(numbers.size()) < mesh.num_vertices()) numbers.push_back(next++);
    meshes.push_back({std::move(mesh), std::move(numbers)});
  }
  return join_parts(meshes);
}

FLBC_INSTANTIATE_FUNCTION(mesh_in_parts)

}  // namespace flbc
