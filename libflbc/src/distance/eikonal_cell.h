// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! One cell of a mesh, as the fast marching method sees it: the distance of one corner from those
//! of the others.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "cell_geometry.h"
#include "flbc/domain_mesh.h"

namespace flbc::distance {

//! What is shared by all sources: lengths and angles.
template <int Dim>
struct EikonalCell {
  static constexpr int kPairs = Dim * (Dim + 1) / 2;
  float products[kPairs];  //!< of the hat functions' gradients, for k < l; a row sums to zero
  float lengths2[kPairs];  //!< squared lengths of the edges

  //! Place of the pair k < l in the order (0, 1), (0, 2), (1, 2), (0, 3), ...
  static constexpr int pair(int k, int l) {
    return k < l ? l * (l - 1) / 2 + k : k * (k - 1) / 2 + l;
  }
};

template <int Dim>
EikonalCell<Dim> eikonal_cell(const DomainMesh<Dim>& mesh, Index s) {
  EikonalCell<Dim> cell;
  const auto hat = cell_geometry(mesh, s).hat_gradients;
  for (int l = 0; l <= Dim; ++l) {
    for (int k = 0; k < l; ++k) {
      const int pair = EikonalCell<Dim>::pair(k, l);
      cell.products[pair] = static_cast<float>(hat.col(k).dot(hat.col(l)));
      cell.lengths2[pair] = static_cast<float>(
          (mesh.points.col(mesh.cells(k, s)) - mesh.points.col(mesh.cells(l, s))).squaredNorm());
    }
  }
  return cell;
}

//! Bit 4 c + o tells whether the edge from corner c to corner o includes more than a right angle
//! with another one at c.
template <int Dim>
std::uint16_t obtuse_angles(const EikonalCell<Dim>& cell) {
  using Cell = EikonalCell<Dim>;
  unsigned bits = 0;
  for (int c = 0; c <= Dim; ++c) {
    for (int o = 0; o <= Dim; ++o) {
      for (int k = 0; k <= Dim; ++k) {
        if (c == o || c == k || k == o) continue;
        const bool is_obtuse = cell.lengths2[Cell::pair(c, k)] + cell.lengths2[Cell::pair(c, o)] <
                               cell.lengths2[Cell::pair(k, o)];
        if (is_obtuse) bits |= 1u << (4 * c + o);
      }
    }
  }
  return static_cast<std::uint16_t>(bits);
}

//! A triangle with these squared lengths of its edges (0, 1), (0, 2), (1, 2).
inline EikonalCell<2> eikonal_triangle(const float (&lengths2)[3]) {
  const double a = lengths2[0], b = lengths2[1], c = lengths2[2];
  const double area2 = (2 * (a * b + b * c + c * a) - a * a - b * b - c * c) / 16;
  const double scale = area2 > 0 ? -1 / (8 * area2) : 0;
  EikonalCell<2> cell;
  for (int k = 0; k < 3; ++k) {
    cell.lengths2[k] = lengths2[k];
    cell.products[k] = static_cast<float>(scale * (a + b + c - 2 * double(lengths2[k])));
  }
  return cell;
}

//! No distance.
constexpr float kNone = -1;

//! The distance D of `corner` from the source that has the distances d_k from the other corners and
//! lies on their far side; kNone if the ray from there does not pass between them. With f(x) =
//! |x - source|^2, which is |x|^2 plus an affine function, |grad f|^2 = 4 f at the corner says, for
//! t = D^2 - m^2, m = min d_k and gamma_k = d_k^2 - m^2 - |e_k|^2,
//!
//!     H_cc t^2 + 2 t (sum_k H_ck gamma_k - 2) + sum_kl H_kl gamma_k gamma_l - 4 m^2 = 0
//!
//! with the products H of the hat functions' gradients. Exact wherever the way is straight.
template <int corner, int Dim>
inline float distance_through(const EikonalCell<Dim>& cell, const float (&known)[Dim + 1]) {
  using Cell = EikonalCell<Dim>;
  // Rays along a side common to two cells must not be lost between them by rounding.
  constexpr float kSlack = 1e-4f;
  float nearest = std::numeric_limits<float>::max();
  for (int k = 0; k <= Dim; ++k) {
    if (k != corner) nearest = std::min(nearest, known[k]);
  }
  float gamma[Dim + 1];
  for (int k = 0; k <= Dim; ++k) {
    gamma[k] = k == corner ? 0
                           : (known[k] - nearest) * (known[k] + nearest) -
                                 cell.lengths2[Cell::pair(k, corner)];
  }
  // Rows of H gamma, of which the diagonal is minus the sum of the others in its row.
  float rows[Dim + 1] = {};
  float diagonal = 0;
  int pair = 0;
  for (int l = 1; l <= Dim; ++l) {
    for (int k = 0; k < l; ++k) {
      const float product = cell.products[pair++];
      rows[k] += product * (gamma[l] - gamma[k]);
      rows[l] += product * (gamma[k] - gamma[l]);
      if (k == corner || l == corner) diagonal -= product;
    }
  }
  float square = 0;
  for (int k = 0; k <= Dim; ++k) square += gamma[k] * rows[k];
  const float half = 2 - rows[corner];
  const float discriminant = half * half - diagonal * (square - 4 * nearest * nearest);
  if (!(discriminant >= 0)) return kNone;
  const float t = (half + std::sqrt(discriminant)) / diagonal;
  // The rate at which lambda_k grows towards the source.
  const float slack = kSlack * (diagonal * t + std::abs(rows[corner]));
  for (int k = 0; k <= Dim; ++k) {
    if (k != corner && rows[k] + t * cell.products[Cell::pair(k, corner)] > slack) return kNone;
  }
  return std::sqrt(std::max(0.f, nearest * nearest + t));
}

//! The same for a corner that the compiler does not know.
template <int Dim>
inline float distance_through(const EikonalCell<Dim>& cell, int corner,
                              const float (&known)[Dim + 1]) {
  switch (corner) {
    case 0:
      return distance_through<0>(cell, known);
    case 1:
      return distance_through<1>(cell, known);
    case 2:
      return distance_through<2>(cell, known);
    default:
      return distance_through<Dim>(cell, known);
  }
}

}  // namespace flbc::distance
