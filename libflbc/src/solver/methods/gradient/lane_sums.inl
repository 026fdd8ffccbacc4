// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Packs of control points of two widths, and sums over their lanes. Included by
//! gradient_steps.inl within its namespace of the instruction set.

template <class Scalar>
using Pack = PackN<Scalar, kLanes>;

// Lanes of the packs that fill the widest registers.
template <class Scalar>
constexpr int kWide = sizeof(Scalar) == 4 ? kWideLanes : kLanes;

// Each step halves the number of values per argument; results are adjacent.
template <class Scalar>
inline Pack<Scalar> sum_halves(Pack<Scalar> a, Pack<Scalar> b) {
  return __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11) +
         __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15);
}
template <class Scalar>
inline Pack<Scalar> sum_quarters(Pack<Scalar> a, Pack<Scalar> b) {
  return __builtin_shufflevector(a, b, 0, 1, 4, 5, 8, 9, 12, 13) +
         __builtin_shufflevector(a, b, 2, 3, 6, 7, 10, 11, 14, 15);
}
template <class Scalar>
inline Pack<Scalar> sum_neighbours(Pack<Scalar> a, Pack<Scalar> b) {
  return __builtin_shufflevector(a, b, 0, 2, 4, 6, 8, 10, 12, 14) +
         __builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15);
}

// The sums of eight packs, one per lane.
template <class Scalar>
inline Pack<Scalar> sum_each(const Pack<Scalar>* packs) {
  return sum_neighbours<Scalar>(sum_quarters<Scalar>(sum_halves<Scalar>(packs[0], packs[1]),
                                                     sum_halves<Scalar>(packs[2], packs[3])),
                                sum_quarters<Scalar>(sum_halves<Scalar>(packs[4], packs[5]),
                                                     sum_halves<Scalar>(packs[6], packs[7])));
}

template <class Scalar>
inline double sum(Pack<Scalar> pack) {
  double total = 0;
  for (int l = 0; l < kLanes; ++l) total += static_cast<double>(pack[l]);
  return total;
}

// Sums squares of a row of control points, if requested.
template <class Scalar, bool wanted>
class SquareSum {
 public:
  template <int Lanes>
  [[gnu::always_inline]] inline void add(PackN<Scalar, Lanes> pack) {
    if constexpr (!wanted) return;
    if constexpr (Lanes == kLanes) {
      total_ += pack * pack;
    } else {
      total_ += fold<Scalar>(pack * pack);
    }
  }
  double total() const { return sum<Scalar>(total_); }

 private:
  Pack<Scalar> total_{};
};
