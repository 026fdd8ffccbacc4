// SPDX-License-Identifier: BSD-3-Clause
#include "polytope/affine_weights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

#include "linear/dense.h"
#include "polytope/scaling.h"

namespace flbc {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// The nearest point of the cone {y : b . y >= 0 for all corners b}, by the non-negative least
// squares of Lawson and Hanson, 1974, in the polar cone.
// \param face  output: the projection onto the span of the face of the cone that it lies on
template <int N>
Eigen::Matrix<double, N, 1> nearest_in_cone(const Eigen::Matrix<double, N, Eigen::Dynamic>& corners,
                                            const Eigen::Matrix<double, N, 1>& v,
                                            Eigen::Matrix<double, N, N>& face) {
  using Vectors = Eigen::Matrix<double, N, Eigen::Dynamic, Eigen::ColMajor, N, N>;
  constexpr int kSteps = 20 * N;
  Eigen::Matrix<double, N, 1> y = v;
  face.setIdentity();
  std::vector<int> active;
  std::vector<double> pushes;
  for (int step = 0; step < kSteps && static_cast<int>(active.size()) < N; ++step) {
    int worst = 0;
    if ((corners.transpose() * y).minCoeff(&worst) >= -kEpsilon * v.norm()) return y;
    if (std::find(active.begin(), active.end(), worst) != active.end()) return y;
    active.push_back(worst);
    pushes.push_back(0);
    while (!active.empty()) {
      const Vectors normals = corners(Eigen::all, active);
      const Eigen::HouseholderQR<Vectors> factor(normals);
      const Eigen::VectorXd wanted = factor.solve(-v);
      double t = 1;
      std::size_t first = active.size();
      for (std::size_t k = 0; k < active.size(); ++k) {
        if (wanted[k] > 0 || pushes[k] > t * (pushes[k] - wanted[k])) continue;
        first = k;
        t = pushes[k] > 0 ? pushes[k] / (pushes[k] - wanted[k]) : 0;
      }
      for (std::size_t k = 0; k < active.size(); ++k) pushes[k] += t * (wanted[k] - pushes[k]);
      if (first == active.size()) {
        Vectors q = Vectors::Identity(N, normals.cols());
        q.applyOnTheLeft(factor.householderQ());
        face.setIdentity();
        face -= q * q.transpose();
        break;
      }
      active.erase(active.begin() + static_cast<std::ptrdiff_t>(first));
      pushes.erase(pushes.begin() + static_cast<std::ptrdiff_t>(first));
      if (active.empty()) face.setIdentity();
    }
    if (static_cast<int>(active.size()) == N) face.setZero();
    y = face * v;
  }
  return y;
}

// The control points with columns other than 0, largest first.
template <class Columns>
std::vector<Index> by_size(const Columns& y) {
  const Eigen::RowVectorXd sizes = y.colwise().squaredNorm();
  auto order = positive_entries(sizes);
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return sizes[a] > sizes[b]; });
  return order;
}

// The first and last points along the axes.
template <class Columns>
std::set<Index> extremes(const Columns& points) {
  std::set<Index> found;
  for (int k = 1; k < points.rows(); ++k) {
    Index low = 0, high = 0;
    points.row(k).minCoeff(&low);
    points.row(k).maxCoeff(&high);
    found.insert({low, high});
  }
  return found;
}

std::vector<Index> list(const std::set<Index>& set) {
  return {set.begin(), set.end()};
}

}  // namespace

template <int Dim>
AffineWeights<Dim>::AffineWeights(const PointList<Dim>& control_points,
                                  const PointList<Dim>& region)
    : center_(region.rowwise().mean()) {
  const double scale = scale_of<Dim>(control_points);
  const PointList<Dim> offsets = region.colwise() - center_;
  axes_ = dense::principal_axes<Dim>(dense::moments<Dim>(offsets));
  lengths_ = (axes_.transpose() * offsets).rowwise().norm() /
             std::sqrt(static_cast<double>(region.cols()));
  // Along an axis without extent, weights hardly change, so rounding errors are not amplified.
  lengths_ = lengths_.cwiseMax(std::max(1e-6 * lengths_.maxCoeff(), 1e-12 * scale));
  basis_.resize(kSize, region.cols());
  for (Eigen::Index p = 0; p < region.cols(); ++p) basis_.col(p) = basis_at(region.col(p));
  places_.resize(kSize, control_points.cols());
  places_.row(0).setOnes();
  places_.bottomRows(Dim) = axes_.transpose() * (control_points.colwise() - center_) / scale;
  sums_.setZero();
  sums_.diagonal() << 1, lengths_ / scale;
}

template <int Dim>
typename AffineWeights<Dim>::Column AffineWeights<Dim>::basis_at(const Vector<Dim>& point) const {
  Column b;
  b << 1, (axes_.transpose() * (point - center_)).cwiseQuotient(lengths_);
  return b;
}

template <int Dim>
Eigen::VectorXd AffineWeights<Dim>::at(const Vector<Dim>& point, const Columns& y) const {
  const Eigen::VectorXd weights = y.transpose() * basis_at(point);
  return (weights.array().abs() > kEpsilon).select(weights, 0);
}

template <int Dim>
typename AffineWeights<Dim>::Columns AffineWeights<Dim>::fit(const SparseWeights& weights) const {
  Columns y = Columns::Zero(kSize, places_.cols());
  for (Index p = 0; p < weights.num_points(); ++p) {
    weights.visit(p, [&](Index i, double weight) { y.col(i) += weight * basis_.col(p); });
  }
  return y / weights.num_points();
}

template <int Dim>
bool AffineWeights<Dim>::project(const std::vector<Index>& support, const Columns& given,
                                 Columns& nearest) const {
  auto corners = extremes(basis_);
  nearest.setZero(kSize, places_.cols());
  for (bool is_new = !support.empty(); is_new;) {
    Columns found;
    if (!minimize(given(Eigen::all, support), places_(Eigen::all, support),
                  basis_(Eigen::all, list(corners)), found)) {
      return false;
    }
    is_new = false;
    for (const auto& y : found.colwise()) {
      Index worst = 0;
      if ((y.transpose() * basis_).minCoeff(&worst) >= -kEpsilon) continue;
      is_new = corners.insert(worst).second || is_new;
    }
    nearest(Eigen::all, support) = found;
  }
  return !support.empty();
}

// By duality, mu minimizes F(mu) = sum_i |P(z_i + mu p_i)|^2 / 2 - <mu, S> + delta |mu|^2 / 2,
// which is convex and piecewise quadratic. Since sum_i y_i p_i^T is given, z_i + mu p_i has the
// same projection as z_i; restarting from there removes the effect of delta (DualNewton).
template <int Dim>
bool AffineWeights<Dim>::minimize(Columns given, const Columns& places, const Columns& corners,
                                  Columns& nearest) const {
  constexpr int kRounds = 12, kSteps = 40, kTrials = 30, kUnknowns = kSize * kSize;
  constexpr double kExact = 2e-15, kReproduced = 2e-14, kFirstDelta = 1e-8, kLastDelta = 1e-14;
  using Hessian = Eigen::Matrix<double, kUnknowns, kUnknowns>;
  const auto count = given.cols();
  std::vector<Square> faces(static_cast<std::size_t>(count));
  nearest.resize(kSize, count);
  double delta = kFirstDelta;
  const auto gradient_at = [&](const Square& mu) -> Square {
    for (Eigen::Index i = 0; i < count; ++i) {
      nearest.col(i) = nearest_in_cone<kSize>(corners, given.col(i) + mu * places.col(i), faces[i]);
    }
    return nearest * places.transpose() - sums_ + delta * mu;
  };
  for (int round = 0; round < kRounds; ++round) {
    Square mu = Square::Zero(), gradient = gradient_at(mu);
    for (int step = 0; step < kSteps && gradient.norm() > kEpsilon * (1 + mu.norm()); ++step) {
      Hessian hessian = delta * Hessian::Identity();
      for (Eigen::Index i = 0; i < count; ++i) {
        for (int k = 0; k < kUnknowns && !faces[i].isZero(0); ++k) {
          const int a = k / kSize, b = k % kSize;
          hessian.template block<kSize, kSize>(kSize * a, kSize * b) +=
              places(a, i) * places(b, i) * faces[i];
        }
      }
      const Eigen::Matrix<double, kUnknowns, 1> solved = hessian.ldlt().solve(gradient.reshaped());
      const Square direction = -solved.reshaped(kSize, kSize);
      // The slope of F along the direction increases; it vanishes at the minimum.
      const double first = gradient.cwiseProduct(direction).sum();
      double low = 0, high = 1, t = 1;
      for (int trial = 0; trial < kTrials; ++trial) {
        gradient = gradient_at(mu + t * direction);
        const double slope = gradient.cwiseProduct(direction).sum();
        if (std::abs(slope) <= 0.1 * std::abs(first) || (t == 1 && slope < 0)) break;
        (slope > 0 ? high : low) = t;
        t = (low + high) / 2;
      }
      mu += t * direction;
    }
    const double error = (nearest * places.transpose() - sums_).cwiseAbs().maxCoeff();
    if (error <= kExact || (error <= kReproduced && delta == kLastDelta)) return true;
    given += mu * places;
    delta = std::max(kLastDelta, 0.1 * delta);
  }
  return false;
}

template <int Dim>
bool AffineWeights<Dim>::reduce(const std::vector<Index>& support, Index most, const Columns& given,
                                Columns& nearest) const {
  constexpr std::size_t kPool = 40, kTrials = 8;
  constexpr double kGain = 0.999;
  nearest = given;
  const auto order = by_size(given);
  if (static_cast<Index>(order.size()) <= most) return true;
  std::set<Index> pool;
  const Columns places = places_(Eigen::all, support);
  for (const Index k : extremes(places)) pool.insert(support[k]);
  for (const Index i : order) {
    if (pool.size() < kPool) pool.insert(i);
  }
  const auto simplex = best_simplex(list(pool), given);
  std::set<Index> chosen(simplex.begin(), simplex.end());
  // Larger regions need more control points, of which too many are dropped.
  const auto step = 2 * static_cast<std::size_t>(std::max(most, 1));
  for (auto size = simplex.empty() ? step : 0; !project(list(chosen), given, nearest);
       size += step) {
    if (simplex.empty() ? chosen.size() == order.size() : size > order.size()) return false;
    chosen.insert(order.begin(),
                  order.begin() + static_cast<std::ptrdiff_t>(std::min(size, order.size())));
  }
  // Takes the nearest of feasible variants. \return the square of its distance
  const auto take_best = [&](const std::vector<std::set<Index>>& variants) {
    double least = std::numeric_limits<double>::infinity();
    Columns trial;
    for (const auto& variant : variants) {
      if (!project(list(variant), given, trial) || (trial - given).squaredNorm() >= least) continue;
      least = (trial - given).squaredNorm();
      chosen = variant;
      nearest = trial;
    }
    return least;
  };
  for (;;) {
    const auto before = static_cast<Index>(chosen.size());
    const Columns found = nearest;
    std::vector<std::set<Index>> variants;
    for (auto i = order.begin(); before <= most && i != order.end(); ++i) {
      auto variant = chosen;
      if (variants.size() < kTrials && variant.insert(*i).second) variants.push_back(variant);
    }
    double distance = take_best(variants);
    while (static_cast<Index>(chosen.size()) > most && distance >= 0) {
      variants.assign(chosen.size(), chosen);
      auto variant = variants.begin();
      for (const Index i : std::set<Index>(chosen)) (variant++)->erase(i);
      const auto size = chosen.size();
      distance = take_best(variants);
      if (chosen.size() == size) distance = -1;  // all are needed
    }
    if (distance >= 0 && (before != most || distance < kGain * (found - given).squaredNorm()) &&
        std::isfinite(distance)) {
      continue;
    }
    nearest = found;
    return before <= most;
  }
}

// The simplex of control points that holds the region and is nearest to given columns; empty if
// there is none.
template <int Dim>
std::vector<Index> AffineWeights<Dim>::best_simplex(const std::vector<Index>& pool,
                                                    const Columns& given) const {
  const Columns corners = basis_(Eigen::all, list(extremes(basis_)));
  const auto count = static_cast<int>(pool.size());
  std::vector<Index> best, simplex(kSize);
  std::vector<int> chosen(kSize);
  std::iota(chosen.begin(), chosen.end(), 0);
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k >= 0 && count >= kSize;) {
    for (int j = 0; j < kSize; ++j) simplex[j] = pool[chosen[j]];
    const Square places = places_(Eigen::all, simplex), wanted = given(Eigen::all, simplex);
    const Square y = sums_ * places.inverse().transpose();
    const double cost = (y - wanted).squaredNorm() - wanted.squaredNorm();
    if (cost < least && (corners.transpose() * y).minCoeff() >= -kEpsilon &&
        (basis_.transpose() * y).minCoeff() >= -kEpsilon) {
      least = cost;
      best = simplex;
    }
    for (k = kSize - 1; k >= 0 && chosen[k] == count - kSize + k;) --k;
    if (k >= 0) std::iota(chosen.begin() + k, chosen.end(), chosen[k] + 1);
  }
  return best;
}

template class AffineWeights<2>;
template class AffineWeights<3>;

}  // namespace flbc
