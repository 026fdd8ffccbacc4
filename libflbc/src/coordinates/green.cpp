// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/green.h"

#include <cmath>
#include <vector>

#include "base/instantiate.h"
#include "base/parallel.h"
#include "cage/oriented_cage.h"
#include "coordinates/points_in_cage.h"
#include "coordinates/seen_facet.h"

namespace flbc {
namespace {

constexpr double kPi = 3.14159265358979323846;

// Integrals over one facet, with the fundamental solution G of the Laplacian.
template <int Dim>
struct Share {
  Vector<Dim> corners;  // of the barycentric coordinates of its corners times the derivative of G
                        // along the normal
  double normal;        // of -G
};

// log(r + t) between the ends of an edge, where t is the position on its line and r the distance
// from the point. Of two expressions, the one without cancellation is used.
double integral_of_inverse(double t_from, double r_from, double t_to, double r_to) {
  return t_from + t_to > 0 ? std::log((r_to + t_to) / (r_from + t_from))
                           : std::log((r_from - t_from) / (r_to - t_to));
}

// G = log(r) / (2 pi).
Share<2> share_of(const SeenFacet<2>& facet, const Vector<2>& x, double in_plane) {
  const Vector<2> edge = facet.corners.col(1) - facet.corners.col(0);
  const double length = edge.norm();
  const Vector<2> along = edge / length;
  const Vector<2> to_a = facet.corners.col(0) - x;
  const Vector<2> to_b = facet.corners.col(1) - x;
  const double height = to_a.x() * along.y() - to_a.y() * along.x();
  const double a = along.dot(to_a);
  const double b = along.dot(to_b);
  const double r_a = to_a.norm();
  const double r_b = to_b.norm();
  const auto times_log = [](double t, double r) { return r > 0 ? t * std::log(r) : 0.0; };
  if (std::abs(height) <= in_plane) {
    return {Vector<2>::Zero(), (length + times_log(a, r_a) - times_log(b, r_b)) / (2 * kPi)};
  }
  const double angle = std::atan2(height * length, to_a.dot(to_b));
  const double slope = height * std::log(r_b / r_a);
  return {Vector<2>(b * angle - slope, slope - a * angle) / (2 * kPi * length),
          (length + times_log(a, r_a) - times_log(b, r_b) - height * angle) / (2 * kPi)};
}

// G = -1 / (4 pi r). The integral of 1 / r^3 is a solid angle, and the slopes of barycentric
// coordinates contribute edge terms by the divergence theorem.
Share<3> share_of(const SeenFacet<3>& facet, const Vector<3>& x, double in_plane) {
  const Eigen::Matrix3d to = facet.corners.colwise() - x;
  const Vector<3> r = to.colwise().norm();
  const double height = facet.normal.dot(to.col(0));
  const bool is_in_plane = std::abs(height) <= in_plane;
  Vector<3> inside;    // distances of the foot point of x from the edge lines, positive inward
  Vector<3> inverses;  // integrals of 1 / r along the edges
  for (int k = 0; k < 3; ++k) {
    const int a = (k + 1) % 3;
    const int b = (k + 2) % 3;
    inside[k] = -facet.inwards.col(k).dot(to.col(a));
    const bool is_on_line = is_in_plane && std::abs(inside[k]) <= in_plane;
    inverses[k] = is_on_line ? 0  // its factors vanish
                             : integral_of_inverse(facet.along.col(k).dot(to.col(a)), r[a],
                                                   facet.along.col(k).dot(to.col(b)), r[b]);
  }
  if (is_in_plane) return {Vector<3>::Zero(), inside.dot(inverses) / (4 * kPi)};
  const double doubled_area = facet.lengths[0] * facet.heights[0];
  const double angle =
      2 * std::atan2(height * doubled_area, r.prod() + to.col(0).dot(to.col(1)) * r[2] +
                                                to.col(1).dot(to.col(2)) * r[0] +
                                                to.col(2).dot(to.col(0)) * r[1]);
  const Vector<3> slope = height * (facet.inwards.transpose() * (facet.inwards * inverses));
  return {(angle * inside + slope).cwiseQuotient(facet.heights) / (4 * kPi),
          (inside.dot(inverses) - height * angle) / (4 * kPi)};
}

Vector<2> scaled_normal(const Eigen::Matrix2d& rest, const Eigen::Matrix2d& posed) {
  const Vector<2> edge = posed.col(1) - posed.col(0);
  return Vector<2>(edge.y(), -edge.x()) / (rest.col(1) - rest.col(0)).norm();
}

Vector<3> scaled_normal(const Eigen::Matrix3d& rest, const Eigen::Matrix3d& posed) {
  const Vector<3> u = rest.col(1) - rest.col(0);
  const Vector<3> v = rest.col(2) - rest.col(0);
  const Vector<3> posed_u = posed.col(1) - posed.col(0);
  const Vector<3> posed_v = posed.col(2) - posed.col(0);
  const double square = posed_u.squaredNorm() * v.squaredNorm() -
                        2 * posed_u.dot(posed_v) * u.dot(v) +
                        posed_v.squaredNorm() * u.squaredNorm();
  const double stretch = std::sqrt(std::max(0.0, square) / 2) / u.cross(v).norm();
  return stretch * posed_u.cross(posed_v).normalized();
}

}  // namespace

template <int Dim>
WeightMatrix green_coordinates(const Cage<Dim>& cage, const PointList<Dim>& points) {
  check_finite<Dim>(points);
  const double size = bounding_box_diagonal(cage.points);
  const auto oriented = orient(cage).cage;
  const auto facets = see_facets(oriented, size);
  const FacetLocator<Dim> on_cage(oriented, kOnCage * size);
  const FacetLocator<Dim> near_cage(oriented, kBoundaryTolerance * size);
  const CageLocator<Dim> inside(oriented, 0);
  const Index n = cage.size();
  const auto num_points = static_cast<Index>(points.cols());
  WeightMatrix weights = WeightMatrix::Zero(n + oriented.facets.cols(), num_points);
  std::vector<char> is_outside(static_cast<std::size_t>(num_points), 0);
  parallel_for_chunks(num_points, 64, [&](Index p) {
    Vector<Dim> x = points.col(p);
    auto place = on_cage.locate(x);
    if (place.facet < 0 && inside.is_outside(x)) {
      place = near_cage.locate(x);
      if (place.facet < 0) {
        is_outside[p] = 1;
        return;
      }
    }
    const bool is_on_cage = place.facet >= 0;
    if (is_on_cage) {
      x = oriented.points(Eigen::all, oriented.facets.col(place.facet)) * place.coordinates;
    }
    const double in_plane = (is_on_cage ? 4 * kOnCage : kInPlane) * size;
    auto column = weights.col(p);
    for (std::size_t f = 0; f < facets.size(); ++f) {
      const auto share = share_of(facets[f], x, in_plane);
      for (int k = 0; k < Dim; ++k) column[oriented.facets(k, f)] += share.corners[k];
      column[n + static_cast<Index>(f)] = share.normal;
    }
    if (!is_on_cage) return;
    // Seen from just inside, the facets at x fill the remaining angle.
    const double remaining = 1 - column.head(n).sum();
    for (int k = 0; k < Dim; ++k) {
      column[oriented.facets(k, place.facet)] += remaining * place.coordinates[k];
    }
  });
  const auto p = first_where(num_points, [&](Index k) { return is_outside[k] != 0; });
  if (p == num_points) return weights;
  throw InputError("point " + std::to_string(p) + " at " + format_point(points.col(p)) +
                   " is outside the cage; Green coordinates exist only inside");
}

template <int Dim>
PointList<Dim> control_points_and_normals(const Cage<Dim>& cage, const PointList<Dim>& pose) {
  if (pose.cols() != cage.size()) {
    throw InputError("the pose has " + std::to_string(pose.cols()) +
                     " control points, but the cage has " + std::to_string(cage.size()));
  }
  const auto oriented = orient(cage).cage;
  PointList<Dim> all(Dim, cage.size() + oriented.facets.cols());
  all.leftCols(cage.size()) = pose;
  for (Index f = 0; f < oriented.facets.cols(); ++f) {
    const Eigen::Matrix<double, Dim, Dim> rest =
        oriented.points(Eigen::all, oriented.facets.col(f));
    const Eigen::Matrix<double, Dim, Dim> posed = pose(Eigen::all, oriented.facets.col(f));
    all.col(cage.size() + f) = scaled_normal(rest, posed);
  }
  return all;
}

FLBC_INSTANTIATE_FUNCTION(green_coordinates)
FLBC_INSTANTIATE_FUNCTION(control_points_and_normals)

}  // namespace flbc
