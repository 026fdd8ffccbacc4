// SPDX-License-Identifier: BSD-3-Clause
#include "model/following_normals.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "flbc/io/cage_io.h"
#include "linear/dense.h"

namespace flbc::io {
namespace {

using Matrix3 = Eigen::Matrix3d;
using Polygon = std::vector<Index>;

// Twice the area vector of a polygon, which may be nonplanar. Relative to a corner, so polygons far
// from the origin do not lose digits.
Vector<3> area_vector(const Polygon& corners, const PointList<3>& points) {
  const Vector<3> origin = points.col(corners.front());
  Vector<3> area = Vector<3>::Zero();
  for (std::size_t k = 2; k < corners.size(); ++k) {
    const Vector<3> edge = points.col(corners[k - 1]) - origin;
    area += edge.cross(points.col(corners[k]) - origin);
  }
  return area;
}

PointList<3> area_vectors(const PolygonSoup& soup, const PointList<3>& points) {
  PointList<3> areas(3, static_cast<Eigen::Index>(soup.polygons.size()));
  for (std::size_t f = 0; f < soup.polygons.size(); ++f) {
    areas.col(f) = area_vector(soup.polygons[f], points);
  }
  return areas;
}

bool is_still(const Polygon& corners, const PointList<3>& before, const PointList<3>& after) {
  return std::all_of(corners.begin(), corners.end(),
                     [&](Index v) { return after.col(v) == before.col(v); });
}

// How the edges around a vertex change, and the area vectors of their polygons, which distinguish
// the sides of a flat surface. Lengths are squared, so large polygons have more weight.
struct Surroundings {
  bool is_still = true;
  Matrix3 spread = Matrix3::Zero();  // edges before, times themselves
  Matrix3 change = Matrix3::Zero();  // changes of edges, times edges before
  Matrix3 sides = Matrix3::Zero();   // area vectors after, times those before

  void add(const Surroundings& other) {
    is_still &= other.is_still;
    spread += other.spread;
    change += other.change;
    sides += other.sides;
  }

  // The map that changes the edges best, as its difference from the identity. \param prior  what
  // it is where they do not define it, alike \param share  of the prior, small
  Matrix3 fit(const Matrix3& prior, double share) const {
    const double weight = share * spread.trace();
    const Matrix3 fitted =
        (change + weight * prior) * (spread + weight * Matrix3::Identity()).inverse();
    return fitted.allFinite() ? fitted : Matrix3::Zero();
  }
};

Surroundings surroundings_in(const Polygon& corners, const PointList<3>& before,
                             const PointList<3>& after) {
  Surroundings sums;
  sums.is_still = is_still(corners, before, after);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Index a = corners[k], b = corners[(k + 1) % corners.size()];
    const Vector<3> edge = before.col(b) - before.col(a);
    sums.spread += edge * edge.transpose();
    sums.change += (after.col(b) - after.col(a) - edge) * edge.transpose();
  }
  const auto area_before = area_vector(corners, before), area_after = area_vector(corners, after);
  const double scale = std::sqrt(area_before.norm() * area_after.norm());
  if (scale > 0) sums.sides = area_after * area_before.transpose() / scale;
  return sums;
}

// The inverse transpose of a matrix times its determinant, also defined if it has no inverse.
Matrix3 cofactors(const Matrix3& j) {
  Matrix3 result;
  result << j.col(1).cross(j.col(2)), j.col(2).cross(j.col(0)), j.col(0).cross(j.col(1));
  return result;
}

// The motion of a normal, summed over its corners.
struct Motion {
  bool is_still = true;                  // if true, the normal must not change even by rounding
  Vector<3> before = Vector<3>::Zero();  // area vectors
  Vector<3> after = Vector<3>::Zero();
  Matrix3 change = Matrix3::Zero();
  int num_corners = 0;

  Vector<3> turn(const Vector<3>& normal) const {
    if (is_still || before.isZero(0) || after.isZero(0)) return normal;
    const Matrix3 turns = cofactors(Matrix3::Identity() + change / num_corners);
    const Vector<3> turned =
        Eigen::Quaterniond::FromTwoVectors(turns * before, after).normalized() * (turns * normal);
    const double length = turned.norm();
    return length > 0 ? Vector<3>(normal.norm() / length * turned) : normal;
  }
};

Index count_zeros(const PointList<3>& vectors) {
  return static_cast<Index>((vectors.array() == 0).colwise().all().count());
}

}  // namespace

Vector<3> transformed_normal(const Matrix3& j, const Vector<3>& normal) {
  const Matrix3 turns = cofactors(j);
  const double determinant = j.col(0).dot(turns.col(0));
  const Vector<3> turned = (determinant < 0 ? -1 : 1) * (turns * normal);
  const double length = turned.norm();
  return length > 0 ? Vector<3>(normal.norm() / length * turned) : normal;
}

std::vector<Matrix3> changes_of_space(const std::vector<Polygon>& polygons,
                                      const PointList<3>& before, const PointList<3>& after) {
  std::vector<Surroundings> around(static_cast<std::size_t>(before.cols()));
  Surroundings all;
  for (const auto& polygon : polygons) {
    const auto sums = surroundings_in(polygon, before, after);
    all.add(sums);
    for (const Index vertex : polygon) around[vertex].add(sums);
  }
  constexpr double kOfAll = 1e-6, kOfOne = 1e-3;
  const Matrix3 identity = Matrix3::Identity();
  const Matrix3 edges = all.change + all.spread;
  const Matrix3 turn = dense::nearest_rotation(edges + all.sides);
  const double scale = turn.cwiseProduct(edges).sum() / all.spread.trace();
  const Matrix3 mean = identity + all.fit(scale * turn - identity, kOfAll);
  std::vector<Matrix3> changes;
  changes.reserve(around.size());
  for (const auto& own : around) {
    if (own.is_still) {
      changes.emplace_back(Matrix3::Zero());
      continue;
    }
    // From where the mean would move the edges to where they are.
    const Matrix3 own_turn = dense::nearest_rotation((own.change + own.spread) * mean.transpose() +
                                                     own.sides * cofactors(mean).transpose());
    changes.push_back(own.fit(own_turn * mean - identity, kOfOne));
  }
  return changes;
}

FollowingNormals::FollowingNormals(const Model& model, const PointList<3>& face_normals)
    : model_(model), face_normals_(face_normals) {
  if (!has_normals()) return;
  rest_ = to_points<3>(model.soup, "");
  rest_areas_ = area_vectors(model.soup, rest_);
  PointList<3> areas = PointList<3>::Zero(3, model.attributes.normals.cols());
  for (std::size_t f = 0; f < model.attributes.corners.size(); ++f) {
    for (const auto& corner : model.attributes.corners[f]) {
      if (corner.normal >= 0) areas.col(corner.normal) += rest_areas_.col(f);
    }
  }
  num_loose_ = count_zeros(areas);
  if (face_normals_.cols() > 0) num_loose_ += count_zeros(rest_areas_);
}

bool FollowingNormals::has_normals() const {
  return model_.attributes.normals.cols() + face_normals_.cols() > 0;
}

FollowingNormals::Turned FollowingNormals::at(const PointList<3>& points) const {
  Turned turned{model_.attributes.normals, face_normals_};
  if (!has_normals()) return turned;
  const auto& polygons = model_.soup.polygons;
  const auto changes = changes_of_space(polygons, rest_, points);
  std::vector<Motion> motions(static_cast<std::size_t>(turned.normals.cols()));
  for (std::size_t f = 0; f < polygons.size(); ++f) {
    const bool stays = is_still(polygons[f], rest_, points);
    const Vector<3> area = area_vector(polygons[f], points);
    const auto add_corner = [&](Motion& motion, std::size_t corner) {
      motion.is_still &= stays;
      motion.before += rest_areas_.col(f);
      motion.after += area;
      motion.change += changes[polygons[f][corner]];
      ++motion.num_corners;
    };
    Motion of_face;
    for (std::size_t k = 0; k < polygons[f].size(); ++k) {
      add_corner(of_face, k);
      if (motions.empty()) continue;
      const Index normal = model_.attributes.corners[f][k].normal;
      if (normal >= 0) add_corner(motions[normal], k);
    }
    if (face_normals_.cols() > 0) turned.face_normals.col(f) = of_face.turn(face_normals_.col(f));
  }
  for (std::size_t k = 0; k < motions.size(); ++k) {
    turned.normals.col(k) = motions[k].turn(model_.attributes.normals.col(k));
  }
  return turned;
}

FollowingNormals::Turned FollowingNormals::by(const Eigen::MatrixXd& jacobians) const {
  Turned turned{model_.attributes.normals, face_normals_};
  if (!has_normals()) return turned;
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(9, turned.normals.cols());
  const auto& polygons = model_.soup.polygons;
  for (std::size_t f = 0; f < polygons.size(); ++f) {
    Eigen::VectorXd of_face = Eigen::VectorXd::Zero(9);
    for (std::size_t k = 0; k < polygons[f].size(); ++k) {
      const auto jacobian = jacobians.col(polygons[f][k]);
      of_face += jacobian;
      if (turned.normals.cols() == 0) continue;
      const Index normal = model_.attributes.corners[f][k].normal;
      if (normal >= 0) sums.col(normal) += jacobian;
    }
    if (face_normals_.cols() > 0) {
      turned.face_normals.col(f) = transformed_normal(of_face.reshaped(3, 3), face_normals_.col(f));
    }
  }
  // Points without polygons may have a normal each.
  const bool is_by_vertex = turned.normals.cols() == jacobians.cols();
  for (Eigen::Index k = 0; k < turned.normals.cols(); ++k) {
    if (is_by_vertex && sums.col(k).isZero(0)) sums.col(k) = jacobians.col(k);
    turned.normals.col(k) =
        transformed_normal(sums.col(k).reshaped(3, 3), model_.attributes.normals.col(k));
  }
  return turned;
}

}  // namespace flbc::io
