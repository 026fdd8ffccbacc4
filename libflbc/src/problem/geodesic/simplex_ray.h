// SPDX-License-Identifier: BSD-3-Clause
// Computes the distance of one corner of a triangle or tetrahedron from the distances of the
// others.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "flbc/types.h"

namespace flbc::distance {

//! No distance.
constexpr float kNone = -1;

//! Relative tolerance, so that rounding does not lose rays along a side shared by two simplices.
constexpr float kSlack = 1e-4f;

//! The shape of a triangle, shared by all sources.
struct Triangle {
  float lengths2[3];  //!< squared lengths of the sides opposite to the corners
  float area;         //!< of the parallelogram
};

//! The distance of `corner` from a source beyond the opposite side, in the triangle's plane, with
//! the distances `first` and `second` from the next two corners. The difference of their squares
//! gives the position of the source along that side, and Pythagoras its distance from the side.
//! \return kNone if that is not below `limit` or the ray does not cross that side
inline float distance_through(const Triangle& triangle, int corner, float first, float second,
                              float limit) {
  const int one = corner == 2 ? 0 : corner + 1;
  const int two = corner == 0 ? 2 : corner - 1;
  // Products with the side vector, with origin at the first corner.
  const float side2 = triangle.lengths2[corner];
  const float leg2 = triangle.lengths2[two];
  const float source = 0.5f * (side2 - (second - first) * (second + first));
  const float apex = 0.5f * (side2 + leg2 - triangle.lengths2[one]);
  // Heights times the length of the side.
  const float height2 = first * first * side2 - source * source;
  if (!(height2 >= 0)) return kNone;
  const float height = std::sqrt(height2);
  const float whole = height + triangle.area;
  // Squared distance minus the smaller given squared distance, times side2.
  const float nearest = std::min(first, second);
  const float gain = side2 * ((first - nearest) * (first + nearest) + leg2) -
                     2 * (source * apex - height * triangle.area);
  if (!(gain < side2 * (limit - nearest) * (limit + nearest))) return kNone;
  // Barycentric coordinates of the crossing of ray and side, times side2 * whole.
  const float share = height * apex + triangle.area * source;
  const float least = std::min(share, side2 * whole - share);
  const float slack = kSlack * std::max(whole, gain / triangle.area - whole);
  if (least < -side2 * slack) return kNone;
  return std::sqrt(std::max(0.f, nearest * nearest + gain / side2));
}

using Float4 [[gnu::vector_size(16)]] = float;
using Int4 [[gnu::vector_size(16)]] = std::int32_t;

//! The shape of a tetrahedron, shared by all sources, in one cache line, because memory latency
//! dominates. Pairs of corners are in the order (0, 1), (0, 2), (0, 3) and, opposite to these, (2,
//! 3), (1, 3), (1, 2).
struct alignas(64) Tetrahedron {
  Index corners[4];
  float lengths2[6];  //!< squared lengths of the edges
  float products[6];  //!< products of hat gradients; with the diagonal a row sums to zero
};

//! Selects from the pairs, three at a time, those that contain a corner: the one of corners c and
//! c ^ j is pair j - 1 either of the first or of the second three.
struct PairChoice {
  Int4 first, second;
};
constexpr std::int32_t kYes = -1;
constexpr PairChoice kPairsOf[4] = {{{kYes, kYes, kYes, 0}, {0, 0, 0, 0}},
                                    {{kYes, 0, 0, 0}, {0, kYes, kYes, 0}},
                                    {{0, kYes, 0, 0}, {kYes, 0, kYes, 0}},
                                    {{0, 0, kYes, 0}, {kYes, kYes, 0, 0}}};

inline Int4 load_bits(const float* from) {
  Int4 bits;
  __builtin_memcpy(&bits, from, sizeof(bits));
  return bits;
}

inline Float4 turn(Float4 v) {
  return __builtin_shufflevector(v, v, 1, 2, 0, 3);
}

inline Float4 turn_back(Float4 v) {
  return __builtin_shufflevector(v, v, 2, 0, 1, 3);
}

inline bool any(Int4 mask) {
  std::int64_t halves[2];
  __builtin_memcpy(halves, &mask, sizeof(halves));
  return (halves[0] | halves[1]) != 0;
}

inline float sum(Float4 v) {
  const Float4 pairs = v + __builtin_shufflevector(v, v, 2, 3, 0, 1);
  return pairs[0] + pairs[1];
}

//! The distance D of `corner` c from the source that has the distances known[j - 1] from corners c
//! ^ j, j = 1, 2, 3, and lies on their far side. With f(x) = |x - source|^2, which is |x|^2 plus an
//! affine function, |grad f|^2 = 4 f at the corner gives, for t = D^2 - m^2, m = min d_k and
//! gamma_k = d_k^2 - m^2 - |e_k|^2,
//!
//!     H_cc t^2 + 2 t (sum_k H_ck gamma_k - 2) + sum_kl H_kl gamma_k gamma_l - 4 m^2 = 0
//!
//! with the products H of hat gradients. Exact if the path is straight.
//! \return kNone if that is not below `limit`, or if the ray does not cross the opposite facet
inline float distance_through(const Tetrahedron& cell, int corner, const float (&known)[3],
                              float limit) {
  const PairChoice& choice = kPairsOf[corner];
  const Int4 first_lengths2 = load_bits(cell.lengths2);
  const Int4 second_lengths2 = load_bits(cell.lengths2 + 3);
  const Float4 lengths2 =
      (Float4)((first_lengths2 & choice.first) | (second_lengths2 & choice.second));
  const Int4 first_products = load_bits(cell.products);
  Int4 second_products = load_bits(cell.products + 2);
  second_products = __builtin_shufflevector(second_products, second_products, 1, 2, 3, 0);
  // Products of the corner with the others, and of the opposite pairs.
  const Float4 own = (Float4)((first_products & choice.first) | (second_products & choice.second));
  const Float4 rest = (Float4)((first_products & choice.second) | (second_products & choice.first));

  const float nearest = std::min(std::min(known[0], known[1]), known[2]);
  const Float4 distances = {known[0], known[1], known[2], nearest};
  const Float4 gamma = (distances - nearest) * (distances + nearest) - lengths2;
  const Float4 row_terms = own * gamma;
  const Float4 rows =  // of H gamma
      turn_back(rest) * (turn(gamma) - gamma) + turn(rest) * (turn_back(gamma) - gamma) - row_terms;
  const float row = sum(row_terms);
  const float square = sum(gamma * rows);
  const float diagonal = -sum(own);

  // t is the larger root, (half + sqrt(discriminant)) / diagonal.
  const float half = 2 - row;
  const float discriminant = half * half - diagonal * (square - 4 * nearest * nearest);
  const float room = diagonal * ((limit - nearest) * (limit + nearest)) - half;
  if (!(discriminant >= 0 && room > 0 && discriminant < room * room)) return kNone;
  const float scaled = half + std::sqrt(discriminant);
  const float t = scaled / diagonal;
  // Derivatives of the hat functions toward the source.
  const Float4 rates = rows + t * own;
  const float slack = kSlack * (scaled + std::abs(row));
  if (any(rates > slack)) return kNone;
  return std::sqrt(std::max(0.f, nearest * nearest + t));
}

}  // namespace flbc::distance
