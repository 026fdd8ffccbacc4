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

// Covariance of edges before and after, and of a normal vector, which distinguishes the sides of a
// flat polygon. Lengths are squared, so large polygons have more weight.
Matrix3 correlation(const Polygon& corners, const PointList<3>& before, const PointList<3>& after,
                    const Vector<3>& area_before, const Vector<3>& area_after) {
  Matrix3 sum = Matrix3::Zero();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Index a = corners[k], b = corners[(k + 1) % corners.size()];
    sum += (after.col(b) - after.col(a)) * (before.col(b) - before.col(a)).transpose();
  }
  const double scale = std::sqrt(area_before.norm() * area_after.norm());
  if (scale > 0) sum += area_after * area_before.transpose() / scale;
  return sum;
}

bool is_still(const Polygon& corners, const PointList<3>& before, const PointList<3>& after) {
  return std::all_of(corners.begin(), corners.end(),
                     [&](Index v) { return after.col(v) == before.col(v); });
}

// The motion of a normal, summed over its polygons.
struct Motion {
  bool is_still = true;  // if true, the normal must not change even by rounding
  Vector<3> before = Vector<3>::Zero();
  Vector<3> after = Vector<3>::Zero();
  Matrix3 correlation = Matrix3::Zero();

  void add(const Motion& other) {
    is_still &= other.is_still;
    before += other.before;
    after += other.after;
    correlation += other.correlation;
  }

  Vector<3> turn(const Vector<3>& normal) const {
    if (is_still || before.isZero(0) || after.isZero(0)) return normal;
    const Matrix3 rotation = dense::nearest_rotation(correlation);
    const Vector<3> turned_before = rotation * before;
    return Eigen::Quaterniond::FromTwoVectors(turned_before, after).normalized() *
           (rotation * normal);
  }
};

Index count_zeros(const PointList<3>& vectors) {
  return static_cast<Index>((vectors.array() == 0).colwise().all().count());
}

}  // namespace

// The cofactors of J are its inverse transpose times its determinant, and also defined if J has no
// inverse.
Vector<3> transformed_normal(const Matrix3& j, const Vector<3>& normal) {
  Matrix3 cofactors;
  cofactors << j.col(1).cross(j.col(2)), j.col(2).cross(j.col(0)), j.col(0).cross(j.col(1));
  const double determinant = j.col(0).dot(cofactors.col(0));
  const Vector<3> turned = (determinant < 0 ? -1 : 1) * (cofactors * normal);
  const double length = turned.norm();
  return length > 0 ? Vector<3>(normal.norm() / length * turned) : normal;
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
  std::vector<Motion> motions(static_cast<std::size_t>(turned.normals.cols()));
  const auto& polygons = model_.soup.polygons;
  for (std::size_t f = 0; f < polygons.size(); ++f) {
    Motion motion{is_still(polygons[f], rest_, points),
                  rest_areas_.col(f),
                  area_vector(polygons[f], points),
                  {}};
    motion.correlation = correlation(polygons[f], rest_, points, motion.before, motion.after);
    if (face_normals_.cols() > 0) turned.face_normals.col(f) = motion.turn(face_normals_.col(f));
    if (motions.empty()) continue;
    for (const auto& corner : model_.attributes.corners[f]) {
      if (corner.normal >= 0) motions[corner.normal].add(motion);
    }
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
