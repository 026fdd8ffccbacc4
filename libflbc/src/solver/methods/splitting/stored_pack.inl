// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Packs of values that may be stored in half precision, and sums of packs. Included by
//! compact_kernel.inl within its namespace of the instruction set.

#ifdef __F16C__
template <int Lanes>
inline PackN<float, Lanes> load_half(const Half* from) {
#ifdef __AVX512F__
  if constexpr (Lanes == 16) {
    const __m256i bits = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
    return (PackN<float, Lanes>)_mm512_maskz_cvtph_ps(0xffff, bits);
  } else
#endif
  {
    const __m128i bits = _mm_loadu_si128(reinterpret_cast<const __m128i*>(from));
    return (PackN<float, Lanes>)_mm256_cvtph_ps(bits);
  }
}
template <int Lanes>
inline void store_half(Half* to, PackN<float, Lanes> value) {
#ifdef __AVX512F__
  if constexpr (Lanes == 16) {
    const __m256i bits = _mm512_maskz_cvtps_ph(0xffff, (__m512)value, _MM_FROUND_TO_NEAREST_INT);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), bits);
  } else
#endif
  {
    const __m128i bits = _mm256_cvtps_ph((__m256)value, _MM_FROUND_TO_NEAREST_INT);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to), bits);
  }
}
#endif

template <int Lanes, class Stored>
inline auto load_stored(const Stored* from) {
#ifdef __F16C__
  if constexpr (std::is_same_v<Stored, Half>) return load_half<Lanes>(from);
#endif
  if constexpr (!std::is_same_v<Stored, Half>) return load_pack<Lanes>(from);
}
template <int Lanes, class Stored, class Pack>
inline void store_stored(Stored* to, Pack value) {
#ifdef __F16C__
  if constexpr (std::is_same_v<Stored, Half>) store_half<Lanes>(to, value);
#endif
  if constexpr (!std::is_same_v<Stored, Half>) store_pack<Lanes>(to, value);
}

// Limited to the range of half precision.
template <class Stored, class Scalar, int Lanes>
inline PackN<Scalar, Lanes> saturated(PackN<Scalar, Lanes> pack) {
  if constexpr (std::is_same_v<Stored, Half>) {
    constexpr Scalar kLargest = 60000;
    const PackN<Scalar, Lanes> largest = PackN<Scalar, Lanes>{} + kLargest;
    pack = pack < largest ? pack : largest;
    pack = pack > -largest ? pack : -largest;
  }
  return pack;
}

// min(1, radius / sqrt(length2)). For half precision storage, the processor estimate of the root is
// accurate enough.
template <class Stored, class Scalar, int Lanes>
inline PackN<Scalar, Lanes> shrinkage(PackN<Scalar, Lanes> radius, PackN<Scalar, Lanes> length2) {
  using Numbers = PackN<Scalar, Lanes>;
#if defined(__AVX512F__) && defined(__AVX512VL__)
  if constexpr (std::is_same_v<Stored, Half>) {
    Numbers estimate;
    if constexpr (Lanes == 16) {
      estimate = (Numbers)_mm512_maskz_rsqrt14_ps(0xffff, (__m512)length2);
    } else {
      estimate = (Numbers)_mm256_rsqrt14_ps((__m256)length2);
    }
    const Numbers ratio = radius * estimate;
    const Numbers one = Numbers{} + Scalar(1);
    return ratio < one ? ratio : one;  // also 1 for 0 / 0
  }
#endif
  Numbers norm2 = radius * radius + std::numeric_limits<Scalar>::min();
  norm2 = length2 > norm2 ? length2 : norm2;
  return radius * inverse_square_root<Scalar, Lanes>(norm2);
}

template <class Scalar, int Lanes>
inline Scalar sum_of(PackN<Scalar, Lanes> pack) {
  if constexpr (Lanes == 16) {
    return sum_of<Scalar, 8>(fold<Scalar>(pack));
  } else {
    const auto four = __builtin_shufflevector(pack, pack, 0, 1, 2, 3) +
                      __builtin_shufflevector(pack, pack, 4, 5, 6, 7);
    const auto two =
        __builtin_shufflevector(four, four, 0, 1) + __builtin_shufflevector(four, four, 2, 3);
    return two[0] + two[1];
  }
}

// Sums over a row, from wide packs and the remainder.
template <class Scalar>
struct LaneSum {
  PackN<Scalar, kWideLanes> wide{};
  PackN<Scalar, 8> rest{};

  template <int Lanes>
  [[gnu::always_inline]] void add(PackN<Scalar, Lanes> pack) {
    if constexpr (Lanes == kWideLanes) {
      wide += pack;
    } else {
      rest += pack;
    }
  }
  Scalar total() const { return sum_of<Scalar, kWideLanes>(wide) + sum_of<Scalar, 8>(rest); }
};
