// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Judges whether a cage encloses a model, by winding numbers and crossings of edges and facets.
//! Shares nothing with the library but its types.
#pragma once

#include "support/test.h"

namespace flbc::testing {

using Exact = long double;  // 64 bits: products of three differences of doubles are good to 1e-18

template <int Dim>
using LongVector = Eigen::Matrix<Exact, Dim, 1>;

//! Winding number of the cage around a point: the sum of the angles subtended by its facets.
template <int Dim>
double winding_number(const Cage<Dim>& cage, const Vector<Dim>& point) {
  const double pi = std::acos(-1.0);
  double sum = 0;
  for (Index f = 0; f < cage.facets.cols(); ++f) {
    const Vector<Dim> a = cage.points.col(cage.facets(0, f)) - point;
    const Vector<Dim> b = cage.points.col(cage.facets(1, f)) - point;
    if constexpr (Dim == 2) {
      sum += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)) / (2 * pi);
    } else {
      const Vector<3> c = cage.points.col(cage.facets(2, f)) - point;
      const double la = a.norm(), lb = b.norm(), lc = c.norm();
      sum += 2 *
             std::atan2(a.dot(b.cross(c)),
                        la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb) /
             (4 * pi);
    }
  }
  return sum;
}

template <int Dim>
LongVector<Dim> corner(const Cage<Dim>& shape, Index facet, int k) {
  return shape.points.col(shape.facets(k, facet)).template cast<Exact>();
}

inline Exact area(const LongVector<2>& a, const LongVector<2>& b, const LongVector<2>& c) {
  const LongVector<2> u = b - a, v = c - a;
  return u.x() * v.y() - u.y() * v.x();
}

inline Exact volume(const LongVector<3>& a, const LongVector<3>& b, const LongVector<3>& c,
                    const LongVector<3>& d) {
  return (b - a).cross(c - a).dot(d - a);
}

//! Whether the segment p q meets facet f of the cage.
inline bool crosses(const LongVector<2>& p, const LongVector<2>& q, const Cage<2>& cage, Index f) {
  const auto a = corner(cage, f, 0), b = corner(cage, f, 1);
  return area(a, b, p) * area(a, b, q) <= 0 && area(p, q, a) * area(p, q, b) <= 0 &&
         !(area(a, b, p) == 0 && area(a, b, q) == 0);
}

inline bool crosses(const LongVector<3>& p, const LongVector<3>& q, const Cage<3>& cage, Index f) {
  const auto a = corner(cage, f, 0), b = corner(cage, f, 1), c = corner(cage, f, 2);
  const Exact start = volume(a, b, c, p), end = volume(a, b, c, q);
  if (start * end > 0 || (start == 0 && end == 0)) return false;
  const Exact u = volume(p, q, a, b), v = volume(p, q, b, c), w = volume(p, q, c, a);
  return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

//! Pairs of a facet of either whose edges (2D: which themselves) cross the other.
template <int Dim>
Index count_crossings(const Cage<Dim>& model, const Cage<Dim>& cage) {
  const auto box = [](const Cage<Dim>& shape, Index f) {
    Eigen::AlignedBox<double, Dim> around;
    for (int k = 0; k < Dim; ++k) around.extend(Vector<Dim>(shape.points.col(shape.facets(k, f))));
    return around;
  };
  const auto edges_cross = [](const Cage<Dim>& one, Index f, const Cage<Dim>& other, Index g) {
    for (int k = 0; k < (Dim == 2 ? 1 : 3); ++k) {
      if (crosses(corner(one, f, k), corner(one, f, (k + 1) % Dim), other, g)) return true;
    }
    return false;
  };
  Index count = 0;
  for (Index g = 0; g < cage.facets.cols(); ++g) {
    const auto around = box(cage, g);
    for (Index f = 0; f < model.facets.cols(); ++f) {
      if (!around.intersects(box(model, f))) continue;
      if (edges_cross(model, f, cage, g) || edges_cross(cage, g, model, f)) ++count;
    }
  }
  return count;
}

//! Vertices, and points spread over edges and facets, round which the cage does not wind once.
template <int Dim>
Index count_outside(const Cage<Dim>& model, const Cage<Dim>& cage) {
  Index count = 0;
  const auto judge = [&](const Vector<Dim>& point) {
    if (std::abs(winding_number(cage, point) - 1) > 1e-6) ++count;
  };
  for (Index v = 0; v < model.size(); ++v) judge(model.points.col(v));
  for (Index f = 0; f < model.facets.cols(); ++f) {
    Eigen::Matrix<double, Dim, Dim> corners;
    for (int k = 0; k < Dim; ++k) corners.col(k) = model.points.col(model.facets(k, f));
    judge(corners.rowwise().mean());
    for (int k = 0; k < Dim; ++k) {
      judge(0.3 * corners.col(k) + 0.7 * corners.col((k + 1) % Dim));
    }
  }
  return count;
}

}  // namespace flbc::testing
