// SPDX-License-Identifier: BSD-3-Clause
#include "splitting/splitting_kernel.h"

namespace flbc::splitting {

#define FLBC_DECLARE_KERNELS(isa)          \
  namespace isa {                          \
  extern const Kernel<float, 2> kFloat2;   \
  extern const Kernel<float, 3> kFloat3;   \
  extern const Kernel<double, 2> kDouble2; \
  extern const Kernel<double, 3> kDouble3; \
  }
FLBC_DECLARE_KERNELS(baseline)
#ifdef FLBC_WITH_X86_KERNELS
FLBC_DECLARE_KERNELS(avx2)
FLBC_DECLARE_KERNELS(avx512)
#endif
#undef FLBC_DECLARE_KERNELS

namespace {

template <class Scalar, int Dim>
const Kernel<Scalar, Dim>& choose([[maybe_unused]] const Kernel<Scalar, Dim>& avx512,
                                  [[maybe_unused]] const Kernel<Scalar, Dim>& avx2,
                                  const Kernel<Scalar, Dim>& baseline) {
#ifdef FLBC_WITH_X86_KERNELS
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512dq")) {
    return avx512;
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return avx2;
#endif
  return baseline;
}

}  // namespace

#ifdef FLBC_WITH_X86_KERNELS
#define FLBC_CHOOSE(name) choose(avx512::name, avx2::name, baseline::name)
#else
#define FLBC_CHOOSE(name) choose(baseline::name, baseline::name, baseline::name)
#endif

template <>
const Kernel<float, 2>& select_kernel() {
  return FLBC_CHOOSE(kFloat2);
}
template <>
const Kernel<float, 3>& select_kernel() {
  return FLBC_CHOOSE(kFloat3);
}
template <>
const Kernel<double, 2>& select_kernel() {
  return FLBC_CHOOSE(kDouble2);
}
template <>
const Kernel<double, 3>& select_kernel() {
  return FLBC_CHOOSE(kDouble3);
}

#undef FLBC_CHOOSE

}  // namespace flbc::splitting
