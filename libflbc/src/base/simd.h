// SPDX-License-Identifier: BSD-3-Clause
// Packs of control points for the inner loops. The compiler maps a pack to the available
// registers. Everything has internal linkage, so copies for different instruction sets cannot be
// mixed by the linker.
#pragma once

#include <cmath>
#include <cstddef>
#include <type_traits>

#ifdef __AVX__
#include <immintrin.h>
#endif
#ifdef __wasm_simd128__
#include <wasm_simd128.h>
#endif

#include "base/padded_rows.h"

namespace flbc {
namespace {

//! The alignment of rows equals their padding.
template <class Scalar, int Lanes>
struct PackOf {
  using type
      [[gnu::vector_size(Lanes * sizeof(Scalar)), gnu::aligned(kRowLanes * sizeof(Scalar))]] =
          Scalar;
};
template <class Scalar, int Lanes>
using PackN = typename PackOf<Scalar, Lanes>::type;

template <int Lanes, class Scalar>
inline PackN<Scalar, Lanes> load_pack(const Scalar* from) {
  return *reinterpret_cast<const PackN<Scalar, Lanes>*>(from);
}

template <int Lanes, class Scalar>
inline void store_pack(Scalar* to, PackN<Scalar, Lanes> value) {
  *reinterpret_cast<PackN<Scalar, Lanes>*>(to) = value;
}

//! The number of values in the widest registers, if larger than the padding of rows.
#ifdef __AVX512F__
constexpr int kWideLanes = 16;
#else
constexpr int kWideLanes = 8;
#endif

//! The sum of both halves.
template <class Scalar>
inline PackN<Scalar, 8> fold(PackN<Scalar, 16> pack) {
  return __builtin_shufflevector(pack, pack, 0, 1, 2, 3, 4, 5, 6, 7) +
         __builtin_shufflevector(pack, pack, 8, 9, 10, 11, 12, 13, 14, 15);
}

//! Calls `body(lanes, first)` for packs that cover the columns begin .. end - 1, multiples of 8;
//! the number of lanes, `Wide` or 8, is the constant lanes().
template <int Wide, class Body>
[[gnu::always_inline]] inline void for_packs(std::size_t begin, std::size_t end, const Body& body) {
  std::size_t i = begin;
  for (; i + Wide <= end; i += Wide) body(std::integral_constant<int, Wide>{}, i);
  if constexpr (Wide > 8) {
    if (i < end) body(std::integral_constant<int, 8>{}, i);
  }
}

template <class Scalar, int Lanes>
inline PackN<Scalar, Lanes> inverse_square_root_exact(PackN<Scalar, Lanes> pack) {
  PackN<Scalar, Lanes> root;
#ifdef __wasm_simd128__
  // Clang 14 compiles the loop below to roots of one number at a time, which are three times
  // slower.
  constexpr int kLanes = sizeof(v128_t) / sizeof(Scalar);
  v128_t parts[Lanes / kLanes];
  static_assert(sizeof parts == sizeof pack);
  __builtin_memcpy(parts, &pack, sizeof parts);
  for (auto& part : parts) {
    part = sizeof(Scalar) == 4 ? wasm_f32x4_sqrt(part) : wasm_f64x2_sqrt(part);
  }
  __builtin_memcpy(&root, parts, sizeof parts);
#else
  for (int l = 0; l < Lanes; ++l) root[l] = std::sqrt(pack[l]);
#endif
  return Scalar(1) / root;
}

//! 1 / sqrt(x) for normal x > 0, to rounding of the Scalar or about 1e-7 relative in single
//! precision: the processor estimate plus one Newton step is several times faster than a root and a
//! division.
template <class Scalar, int Lanes>
inline PackN<Scalar, Lanes> inverse_square_root(PackN<Scalar, Lanes> pack) {
  if constexpr (sizeof(Scalar) == 8) {
    return inverse_square_root_exact<Scalar, Lanes>(pack);
  } else {
    PackN<float, Lanes> estimate;
#if defined(__AVX512F__) && defined(__AVX512VL__)
    if constexpr (Lanes == 16) {
      // The form without a mask causes a warning in a header of GCC 12.
      estimate = (PackN<float, Lanes>)_mm512_maskz_rsqrt14_ps(0xffff, (__m512)pack);
    } else {
      estimate = (PackN<float, Lanes>)_mm256_rsqrt14_ps((__m256)pack);
    }
#elif defined(__AVX__)
    if constexpr (Lanes == 16) {
      return inverse_square_root_exact<Scalar, Lanes>(pack);
    } else {
      estimate = (PackN<float, Lanes>)_mm256_rsqrt_ps((__m256)pack);
    }
#else
    return inverse_square_root_exact<Scalar, Lanes>(pack);
#endif
    return estimate * (1.5f - 0.5f * pack * estimate * estimate);
  }
}

}  // namespace
}  // namespace flbc
