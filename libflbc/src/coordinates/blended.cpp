// SPDX-License-Identifier: BSD-3-Clause
// An edge between two triangles of the triangulation is the diagonal of a quadrilateral. Mean value
// coordinates of quadrilaterals are positive inside, also in concave ones. In a triangle, those of
// its up to three quadrilaterals are blended by functions of the barycentric coordinates lambda.
// The function of a quadrilateral is 1 on its diagonal, and has no slope there, so first
// derivatives are continuous across diagonals.
#include "flbc/pointwise.h"

#include <array>

#include "cage/oriented_cage.h"
#include "coordinates/points_in_cage.h"
#include "coordinates/polygon_triangulation.h"
#include "coordinates/seen_facet.h"

namespace flbc {
namespace {

class Blend {
 public:
  explicit Blend(const Cage<2>& cage)
      : points_(cage.points), triangulation_(triangulate_polygon(cage)) {}

  bool operator()(const Vector<2>& x, Eigen::Ref<Eigen::VectorXd> weights) const {
    Vector<3> lambda = Vector<3>::Zero();
    const Index t = locate(x, lambda);
    const auto corners = triangulation_.triangles.col(t);
    const auto opposite = triangulation_.opposite.col(t);
    Vector<3> parts;
    for (int k = 0; k < 3; ++k) {
      parts[k] = opposite[k] < 0 ? 0 : 1;
      for (const int other : {(k + 1) % 3, (k + 2) % 3}) {
        if (opposite[other] >= 0) parts[k] *= rise(lambda[other]);
      }
    }
    if (!(parts.sum() > 0)) {  // the cage is a triangle
      for (int k = 0; k < 3; ++k) weights[corners[k]] = lambda[k];
      return true;
    }
    parts /= parts.sum();
    for (int k = 0; k < 3; ++k) {
      if (parts[k] == 0) continue;
      add_quadrilateral({corners[k], corners[(k + 1) % 3], opposite[k], corners[(k + 2) % 3]}, x,
                        parts[k], weights);
    }
    return true;
  }

 private:
  // 0 at 0 without slope.
  static double rise(double t) { return t * t * (3 - 2 * t); }

  // The triangle in which the smallest barycentric coordinate is largest.
  // \param lambda  set to these coordinates, >= 0
  Index locate(const Vector<2>& x, Vector<3>& lambda) const {
    Index best = 0;
    double most = -1e300;
    for (Index t = 0; t < triangulation_.triangles.cols(); ++t) {
      Vector<3> areas;
      for (int k = 0; k < 3; ++k) {
        const Vector<2> a = points_.col(triangulation_.triangles((k + 1) % 3, t)) - x;
        const Vector<2> b = points_.col(triangulation_.triangles((k + 2) % 3, t)) - x;
        areas[k] = a.x() * b.y() - a.y() * b.x();
      }
      const double least = areas.minCoeff() / areas.sum();
      if (least <= most) continue;
      most = least;
      best = t;
      lambda = areas.cwiseMax(0);
      if (least >= 0) break;
    }
    lambda /= lambda.sum();
    return best;
  }

  void add_quadrilateral(const std::array<Index, 4>& corners, const Vector<2>& x, double part,
                         Eigen::Ref<Eigen::VectorXd> weights) const {
    Eigen::Vector4d shares = Eigen::Vector4d::Zero();
    for (int k = 0; k < 4; ++k) {
      const int next = (k + 1) % 4;
      Eigen::Matrix2d edge;
      edge << points_.col(corners[k]), points_.col(corners[next]);
      const Vector<2> share = SeenFacet<2>(edge, 0).share(x);
      shares[k] += share[0];
      shares[next] += share[1];
    }
    shares *= part / shares.sum();
    for (int k = 0; k < 4; ++k) weights[corners[k]] += shares[k];
  }

  const PointList<2>& points_;
  PolygonTriangulation triangulation_;
};

}  // namespace

WeightMatrix blended_coordinates(const Cage<2>& cage, const PointList<2>& points) {
  const auto oriented = orient(cage).cage;
  return weights_in_cage<2>(oriented, points, Blend(oriented));
}

}  // namespace flbc
