// SPDX-License-Identifier: BSD-3-Clause
#include "compare/distortion.h"

#include "front/instantiate.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>

namespace flbc::app {
namespace {

constexpr double kBend = 45 * static_cast<double>(EIGEN_PI) / 180;
constexpr double kStretch = 0.4;
constexpr double kTwist = 60 * static_cast<double>(EIGEN_PI) / 180;

template <int Dim>
Eigen::Matrix<double, Dim, Dim> edges_of(const PointList<Dim>& points, const CellList<Dim>& cells,
                                         Eigen::Index cell) {
  Eigen::Matrix<double, Dim, Dim> edges;
  for (int k = 0; k < Dim; ++k) {
    edges.col(k) = points.col(cells(k + 1, cell)) - points.col(cells(0, cell));
  }
  return edges;
}

// Turns the axes a and b of vectors.
template <class Vector>
void turn(Vector&& vector, int a, int b, double angle) {
  const Eigen::Vector2d turned = Eigen::Rotation2Dd(angle) * Eigen::Vector2d(vector[a], vector[b]);
  vector[a] = turned[0];
  vector[b] = turned[1];
}

}  // namespace

template <int Dim>
Distortion distortion_of(const DomainMesh<Dim>& mesh, const PointList<Dim>& posed) {
  Distortion sum;
  double total = 0;
  for (Eigen::Index cell = 0; cell < mesh.cells.cols(); ++cell) {
    const auto rest = edges_of<Dim>(mesh.points, mesh.cells, cell);
    const Eigen::Matrix<double, Dim, Dim> jacobian =
        edges_of<Dim>(posed, mesh.cells, cell) * rest.inverse();
    const Eigen::JacobiSVD<Eigen::Matrix<double, Dim, Dim>> svd(jacobian);
    const double volume = std::abs(rest.determinant());
    const double scale = jacobian.determinant();
    sum.isometric += volume * (svd.singularValues().array() - 1).square().sum();
    sum.volume += volume * std::abs(scale - 1);
    sum.flipped += scale < 0 ? volume : 0;
    total += volume;
  }
  return {sum.isometric / total, sum.volume / total, sum.flipped / total};
}

template <int Dim>
std::vector<PointList<Dim>> test_poses(const PointList<Dim>& control_points) {
  const Eigen::AlignedBox<double, Dim> box(control_points.rowwise().minCoeff(),
                                           control_points.rowwise().maxCoeff());
  Eigen::Index longest = 0;
  const double half = box.sizes().maxCoeff(&longest) / 2;
  const int along = static_cast<int>(longest);
  const int across = (along + 1) % Dim;
  std::vector<PointList<Dim>> poses(Dim, control_points);
  for (Eigen::Index i = 0; i < control_points.cols(); ++i) {
    const Eigen::Matrix<double, Dim, 1> offset = control_points.col(i) - box.center();
    const double end = offset[along] / half;  // -1 at one end, 1 at the other
    Eigen::Matrix<double, Dim, 1> moved[] = {offset, offset, offset};
    turn(moved[0], along, across, kBend * end);
    moved[1][along] *= 1 + kStretch * std::abs(end);
    if (Dim == 3) turn(moved[2], across, (across + 1) % Dim, kTwist * end);
    for (std::size_t k = 0; k < poses.size(); ++k) poses[k].col(i) = box.center() + moved[k];
  }
  return poses;
}

FLBC_INSTANTIATE_FUNCTION(distortion_of)
FLBC_INSTANTIATE_FUNCTION(test_poses)

}  // namespace flbc::app
