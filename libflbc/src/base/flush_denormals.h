// SPDX-License-Identifier: BSD-3-Clause
// Flushes denormal numbers to zero.
#pragma once

#ifdef __SSE__
#include <xmmintrin.h>
#endif

namespace flbc {

//! Within its scope, the calling thread treats denormal numbers as zero. Where weights are flat,
//! the state of the iteration decays through the denormal range, where operations are many times
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
