// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Which of the copies of an inner loop, compiled for several instruction sets, this processor is
//! given.
#pragma once

namespace flbc {

template <class Kernel>
const Kernel& choose_kernel([[maybe_unused]] const Kernel& avx512,
                            [[maybe_unused]] const Kernel& avx2, const Kernel& baseline) {
#ifdef FLBC_WITH_X86_KERNELS
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512dq")) {
    return avx512;
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return avx2;
#endif
  return baseline;
}

}  // namespace flbc

//! The best of the kernels of this name in the namespaces of the instruction sets.
#ifdef FLBC_WITH_X86_KERNELS
#define FLBC_CHOOSE_KERNEL(name) choose_kernel(avx512::name, avx2::name, baseline::name)
#else
#define FLBC_CHOOSE_KERNEL(name) choose_kernel(baseline::name, baseline::name, baseline::name)
#endif
