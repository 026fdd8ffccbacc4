// SPDX-License-Identifier: BSD-3-Clause
// The weights w of a point x maximize the entropy -sum_i w_i log(w_i / m_i) relative to the priors
// m_i, subject to sum_i w_i = 1 and sum_i w_i (c_i - x) = 0. By duality
// w_i = m_i exp(lambda . (c_i - x)) / Z, where lambda minimizes log Z, and Z is the sum of the
// numerators. The prior of c_i is the product of 1 / rho_f over its facets, where rho_f vanishes on
// facet f only: |a| + |b| - |a - b| for an edge whose ends are a and b as seen from x, and the same
// with areas instead of lengths for a triangle, relative to its own area, because control points
// have different numbers of triangles. Weights at x on a facet then vanish for all other control
// points, also in concave cages.
#include "flbc/pointwise.h"

#include <cmath>

#include <Eigen/Geometry>

#include "base/instantiate.h"
#include "coordinates/points_in_cage.h"
#include "linear/dense.h"

namespace flbc {
namespace {

// rho without cancellation near the facet. \param seen  corners relative to x
double excess(const Eigen::Matrix2d& seen) {
  const double a = seen.col(0).norm(), b = seen.col(1).norm();
  const double dot = seen.col(0).dot(seen.col(1));
  const double cross = seen.determinant();
  const double twice = dot < 0 ? cross * cross / (a * b - dot) : a * b + dot;
  return 2 * twice / (a + b + (seen.col(0) - seen.col(1)).norm());
}

double excess(const Eigen::Matrix3d& seen) {
  const Vector<3> doubled =
      (seen.col(1) - seen.col(0)).cross(seen.col(2) - seen.col(0));  // normal of length 2 A
  const Vector<3> normal = doubled.normalized();
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const Vector<3> side = seen.col((k + 1) % 3).cross(seen.col((k + 2) % 3));
    const double flat = side.dot(normal);  // area below x, signed; the sum of the three is 2 A
    const double area = side.norm();
    const double beyond = (side - flat * normal).squaredNorm();
    sum += flat > 0 ? beyond / (area + flat) : area - flat;
  }
  return sum / doubled.norm();
}

// Minimizes log Z by Newton steps. Near the cage, most weights are tiny at first, and full steps
// are far too long: no step changes a ratio of weights by more than a constant factor, or passes
// the minimum along its line by much.
template <int Dim>
class Dual {
 public:
  // \param offsets  c_i - x in units of cage size \param priors  log m_i
  Dual(const PointList<Dim>& offsets, const Eigen::VectorXd& priors)
      : offsets_(offsets), priors_(priors), weights_(priors.size()) {}

  const Eigen::VectorXd& minimize() {
    constexpr int kMostSteps = 100;
    constexpr double kMostChange = 3;  // of a logarithm
    Vector<Dim> lambda = Vector<Dim>::Zero();
    Vector<Dim> gradient = evaluate(lambda);
    for (int step = 0; step < kMostSteps && gradient.norm() > kRounding; ++step) {
      Eigen::Matrix<double, Dim, Dim> hessian =
          dense::moments<Dim>(offsets_, weights_) - gradient * gradient.transpose();
      hessian.diagonal().array() += kRounding;  // near a facet, rounding hides the curvature
      Vector<Dim> direction = -dense::solve_symmetric<Dim>(hessian, gradient);
      const double change = (offsets_.transpose() * direction).cwiseAbs().maxCoeff();
      if (change > kMostChange) direction *= kMostChange / change;
      const double descent = -gradient.dot(direction);
      Vector<Dim> next = evaluate(lambda + direction);
      while (next.dot(direction) > descent / 2 && direction.norm() > kRounding) {
        direction /= 2;
        next = evaluate(lambda + direction);
      }
      lambda += direction;
      gradient = next;
      if (descent < kRounding * kRounding) break;
    }
    return weights_;
  }

 private:
  static constexpr double kRounding = 1e-15;

  // \return the gradient
  Vector<Dim> evaluate(const Vector<Dim>& lambda) {
    weights_.noalias() = priors_ + offsets_.transpose() * lambda;
    weights_ = (weights_.array() - weights_.maxCoeff()).exp();
    weights_ /= weights_.sum();
    return offsets_ * weights_;
  }

  const PointList<Dim>& offsets_;
  const Eigen::VectorXd& priors_;
  Eigen::VectorXd weights_;
};

// \param offsets  c_i - x in units of cage size \return log m_i
template <int Dim>
Eigen::VectorXd log_priors(const FacetList<Dim>& facets, const PointList<Dim>& offsets) {
  Eigen::VectorXd priors = Eigen::VectorXd::Zero(offsets.cols());
  for (const auto& facet : facets.colwise()) {
    const Eigen::Matrix<double, Dim, Dim> seen = offsets(Eigen::all, facet);
    const double prior = -std::log(excess(seen));
    for (const Index i : facet) priors[i] += prior;
  }
  return priors;
}

}  // namespace

template <int Dim>
WeightMatrix maximum_entropy_coordinates(const Cage<Dim>& cage, const PointList<Dim>& points) {
  const double size = bounding_box_diagonal(cage.points);
  return weights_in_cage<Dim>(cage, points,
                              [&](const Vector<Dim>& x, Eigen::Ref<Eigen::VectorXd> weights) {
                                const PointList<Dim> offsets = (cage.points.colwise() - x) / size;
                                const auto priors = log_priors<Dim>(cage.facets, offsets);
                                weights = Dual<Dim>(offsets, priors).minimize();
                                return true;
                              });
}

FLBC_INSTANTIATE_FUNCTION(maximum_entropy_coordinates)

}  // namespace flbc
