// SPDX-License-Identifier: BSD-3-Clause
// The loops, included once per instruction set with FLBC_ISA as its name. Each including file is
// compiled with the flags of that set (see libflbc/CMakeLists.txt).
//
// The operations on one column of the right-hand side do not depend on neighboring columns or on
// the start of its slice.
#include "linear/panel_kernel.h"

#include <utility>

// Widths are known at compile time, so sums can stay in registers. With sanitizers this would
// generate too much code for the compiler.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define FLBC_UNROLL _Pragma("GCC unroll 1")
#else
#define FLBC_UNROLL _Pragma("GCC unroll 16")
#endif

namespace flbc::panel::FLBC_ISA {
namespace {

#if defined(__AVX512F__)
constexpr int kRegisterBytes = 64;
constexpr int kAccumulators = 16;  // of 32 registers
#elif defined(__AVX__)
constexpr int kRegisterBytes = 32;
constexpr int kAccumulators = 12;  // of 16 registers
#else
constexpr int kRegisterBytes = 16;
constexpr int kAccumulators = 12;
#endif
constexpr int kRowBlock = 4;

// One register of a row. Rows are padded and aligned to 8 values.
template <class Scalar, int Bytes>
struct RegisterOf {
  static constexpr int kAlignment = Bytes < 8 * int(sizeof(Scalar)) ? Bytes : 8 * sizeof(Scalar);
  using type [[gnu::vector_size(Bytes), gnu::aligned(kAlignment), gnu::may_alias]] = Scalar;
};

// Count adjacent registers.
template <class Scalar, int Bytes, int Count>
struct Chunk {
  using Register = typename RegisterOf<Scalar, Bytes>::type;
  static constexpr int kLanes = Bytes / static_cast<int>(sizeof(Scalar));
  static constexpr int kWidth = Count * kLanes;
  Register part[Count];

  [[gnu::always_inline]] static Chunk load(const Scalar* from) {
    Chunk chunk;
    for (int c = 0; c < Count; ++c) {
      chunk.part[c] = *reinterpret_cast<const Register*>(from + c * kLanes);
    }
    return chunk;
  }
  [[gnu::always_inline]] void store(Scalar* to) const {
    for (int c = 0; c < Count; ++c) *reinterpret_cast<Register*>(to + c * kLanes) = part[c];
  }
  [[gnu::always_inline]] void add(Scalar factor, const Chunk& other) {
    for (int c = 0; c < Count; ++c) part[c] += factor * other.part[c];
  }
};

// Rows of B from `row` on: y_below -= B D^-1 b for Rows of them.
template <class Piece, int Width, int Rows, class Scalar>
[[gnu::always_inline]] inline void update_below(const Scalar* entries, const std::int32_t* below,
                                                const Piece (&panel)[Width], Scalar* column,
                                                std::size_t stride) {
  Piece sum[Rows];
  FLBC_UNROLL
  for (int r = 0; r < Rows; ++r) {
    sum[r] = Piece::load(column + static_cast<std::size_t>(below[r]) * stride);
  }
  FLBC_UNROLL
  for (int k = 0; k < Width; ++k) {
    FLBC_UNROLL
    for (int r = 0; r < Rows; ++r) sum[r].add(entries[r * Width + k], panel[k]);
  }
  FLBC_UNROLL
  for (int r = 0; r < Rows; ++r) {
    sum[r].store(column + static_cast<std::size_t>(below[r]) * stride);
  }
}

// One panel and one piece of the rows: y_below -= B D^-1 b, then y = D^-1 b.
template <class Piece, int Width, class Scalar>
inline void forward_piece(const Scalar* entries, const std::int32_t* below, std::int32_t num_below,
                          Scalar* own, Scalar* column, std::size_t stride) {
  Piece panel[Width];
  FLBC_UNROLL
  for (int k = 0; k < Width; ++k) panel[k] = Piece::load(own + k * stride);
  FLBC_UNROLL
  for (int k = 0; k < Width; ++k) {
    Piece sum{};
    FLBC_UNROLL
    for (int j = 0; j <= k; ++j) sum.add(entries[k * (k + 1) / 2 + j], panel[j]);
    sum.store(own + k * stride);
  }
  entries += Width * (Width + 1) / 2;
  std::int32_t r = 0;
  for (; r + kRowBlock <= num_below; r += kRowBlock, entries += kRowBlock * Width) {
    update_below<Piece, Width, kRowBlock>(entries, below + r, panel, column, stride);
  }
  switch (num_below - r) {
    case 3:
      return update_below<Piece, Width, 3>(entries, below + r, panel, column, stride);
    case 2:
      return update_below<Piece, Width, 2>(entries, below + r, panel, column, stride);
    case 1:
      return update_below<Piece, Width, 1>(entries, below + r, panel, column, stride);
    default:
      return;
  }
}

// Unknowns Begin .. End - 1 of one panel: x = D^-T y - (B D^-1)^T x_below.
template <class Piece, int Width, int Begin, int End, class Scalar>
[[gnu::always_inline]] inline void backward_part(const Scalar* entries, const std::int32_t* below,
                                                 std::int32_t num_below, Scalar* own,
                                                 const Scalar* column, std::size_t stride) {
  Piece sum[End - Begin] = {};
  FLBC_UNROLL
  for (int j = Begin; j < Width; ++j) {
    const Piece y = Piece::load(own + j * stride);
    FLBC_UNROLL
    for (int k = Begin; k < End && k <= j; ++k) sum[k - Begin].add(entries[j * (j + 1) / 2 + k], y);
  }
  entries += Width * (Width + 1) / 2;
  for (std::int32_t r = 0; r < num_below; ++r, entries += Width) {
    const Piece x = Piece::load(column + static_cast<std::size_t>(below[r]) * stride);
    FLBC_UNROLL
    for (int k = Begin; k < End; ++k) sum[k - Begin].add(entries[k], x);
  }
  FLBC_UNROLL
  for (int k = Begin; k < End; ++k) sum[k - Begin].store(own + k * stride);
}

// As many unknowns at a time as fit the registers. Later parts do not need y of earlier ones.
template <class Piece, int Width, int Begin = 0, class Scalar>
inline void backward_piece(const Scalar* entries, const std::int32_t* below, std::int32_t num_below,
                           Scalar* own, const Scalar* column, std::size_t stride) {
  constexpr int kPieceRegisters = sizeof(Piece) / sizeof(Piece::part[0]);
  constexpr int kParts = (Width * kPieceRegisters + kAccumulators - 1) / kAccumulators;
  constexpr int kStep = (Width + kParts - 1) / kParts;
  constexpr int kEnd = Begin + kStep < Width ? Begin + kStep : Width;
  backward_part<Piece, Width, Begin, kEnd>(entries, below, num_below, own, column, stride);
  if constexpr (kEnd < Width) {
    backward_piece<Piece, Width, kEnd>(entries, below, num_below, own, column, stride);
  }
}

// Applies a step to the columns begin .. end - 1, multiples of 8, in pieces of two registers, one,
// or half a register. Two registers are used only in single precision: double is used only in
// setup, and its copies would double the compile time of this file.
template <class Scalar, class Step>
[[gnu::always_inline]] inline void for_pieces(std::size_t begin, std::size_t end, Step step) {
  using Single = Chunk<Scalar, kRegisterBytes, 1>;
  using Pair = Chunk<Scalar, kRegisterBytes, 2>;
  constexpr bool kPairs = sizeof(Scalar) == sizeof(float);
  std::size_t i = begin;
  if constexpr (kPairs) {
    for (; i + Pair::kWidth <= end; i += Pair::kWidth) step(Pair{}, i);
  }
  if constexpr (!kPairs || Pair::kWidth > 8) {
    for (; i + Single::kWidth <= end; i += Single::kWidth) step(Single{}, i);
  }
  if constexpr (Single::kWidth > 8) {
    if (i < end) step(Chunk<Scalar, kRegisterBytes / 2, 1>{}, i);
  }
}

template <class Scalar>
struct RowSlice {
  Scalar* rows;
  std::size_t stride, begin, end;
};

template <bool Forward, int Width, class Scalar>
void solve_panel(const Panels<Scalar>& panels, const Panel& panel, const RowSlice<Scalar>& slice) {
  const Scalar* entries = panels.entries + panel.entries;
  const std::int32_t* below = panels.below + panel.below;
  for_pieces<Scalar>(slice.begin, slice.end, [&](auto piece, std::size_t i) {
    Scalar* column = slice.rows + i;
    Scalar* own = column + static_cast<std::size_t>(panel.first) * slice.stride;
    if constexpr (Forward) {
      forward_piece<decltype(piece), Width>(entries, below, panel.num_below, own, column,
                                            slice.stride);
    } else {
      backward_piece<decltype(piece), Width>(entries, below, panel.num_below, own, column,
                                             slice.stride);
    }
  });
}

// The steps for every width, so the values of a panel stay in registers.
template <class Scalar>
struct Steps {
  void (*of_width[kMaxWidth])(const Panels<Scalar>&, const Panel&, const RowSlice<Scalar>&);
};

template <bool Forward, class Scalar, int... Widths>
constexpr Steps<Scalar> steps(std::integer_sequence<int, Widths...>) {
  return {{solve_panel<Forward, Widths + 1, Scalar>...}};
}

template <bool Forward, class Scalar>
void solve(const Panels<Scalar>& panels, Scalar* rows, std::size_t stride, std::size_t begin,
           std::size_t end) {
  static constexpr auto kSteps =
      steps<Forward, Scalar>(std::make_integer_sequence<int, kMaxWidth>());
  const RowSlice<Scalar> slice{rows, stride, begin, end};
  for (std::size_t p = 0; p < panels.num_panels; ++p) {
    const Panel& panel = panels.panels[Forward ? p : panels.num_panels - 1 - p];
    kSteps.of_width[panel.width - 1](panels, panel, slice);
  }
}

template <class Scalar>
constexpr Kernel<Scalar> kKernel{solve<true, Scalar>, solve<false, Scalar>};

}  // namespace
}  // namespace flbc::panel::FLBC_ISA

namespace flbc {
FLBC_DEFINE_KERNEL(panel, float)
FLBC_DEFINE_KERNEL(panel, double)
}  // namespace flbc

#undef FLBC_UNROLL
