// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Numbers too small to matter, made zero.
#pragma once

#ifdef __SSE__
#include <xmmintrin.h>
#endif

namespace flbc {

//! Within its scope the calling thread takes denormal numbers for zero. Where weights are flat the
//! iteration's state dies out through the denormal range, in which every operation is many times
//! slower.
class FlushDenormals {
 public:
#ifdef __SSE__
  FlushDenormals() : before_(_mm_getcsr()) {
    constexpr unsigned kFlushToZero = 0x8000;
    constexpr unsigned kDenormalsAreZero = 0x0040;
    _mm_setcsr(before_ | kFlushToZero | kDenormalsAreZero);
  }
  ~FlushDenormals() {
    _mm_setcsr(before_);
  }
#else
  FlushDenormals() {
  }  // not defaulted, so that the variable counts as used
#endif
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
#ifdef __SSE__
  unsigned before_;
#endif
};

}  // namespace flbc
