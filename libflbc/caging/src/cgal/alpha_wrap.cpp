// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

#include "caging/cage_steps.h"

namespace flbc {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

// Points and segments become triangles that are thin relative to the offset.
std::array<Vector<3>, 3> widened(const Simplex<3>& simplex, double width) {
  std::array<Vector<3>, 3> corners;
  for (int k = 0; k < 3; ++k) corners[k] = simplex.corners.col(k);
  if (simplex.count == 3) return corners;
  const Vector<3> along = corners[1] - corners[0];
  int thin = 0;
  along.cwiseAbs().minCoeff(&thin);
  corners[2] = corners[1] + width * Vector<3>::Unit(thin);
  if (simplex.count == 1) corners[1] += width * Vector<3>::Unit((thin + 1) % 3);
  return corners;
}

Cage<3> to_cage(const Surface& surface) {
  Cage<3> cage{PointList<3>(3, surface.number_of_vertices()),
               FacetList<3>(3, surface.number_of_faces())};
  for (const auto vertex : surface.vertices()) {
    const auto& p = surface.point(vertex);
    cage.points.col(vertex.idx()) << p.x(), p.y(), p.z();
  }
  for (const auto face : surface.faces()) {
    int k = 0;
    for (const auto vertex : vertices_around_face(surface.halfedge(face), surface)) {
      cage.facets(k++, face.idx()) = static_cast<Index>(vertex.idx());
    }
  }
  return cage;
}

}  // namespace

Cage<3> wrap(const Enclosure<3>& model, const WrapSize& size) {
  constexpr double kRelativeWidth = 1e-3;
  std::vector<Kernel::Point_3> points;
  std::vector<std::array<std::size_t, 3>> triangles;
  for (const auto& simplex : model.simplices()) {
    triangles.push_back({points.size(), points.size() + 1, points.size() + 2});
    for (const auto& p : widened(simplex, kRelativeWidth * size.offset)) {
      points.emplace_back(p.x(), p.y(), p.z());
    }
  }
  Surface surface;
  CGAL::alpha_wrap_3(points, triangles, size.alpha, size.offset, surface);
  surface.collect_garbage();
  return to_cage(surface);
}

}  // namespace flbc
