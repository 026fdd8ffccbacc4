// SPDX-License-Identifier: BSD-3-Clause
#include "linear/panel_kernel.h"

namespace flbc::panel {

#define FLBC_DECLARE_KERNELS(isa)      \
  namespace isa {                      \
  extern const Kernel<float> kFloat;   \
  extern const Kernel<double> kDouble; \
  }
FLBC_DECLARE_KERNELS(baseline)
#ifdef FLBC_WITH_X86_KERNELS
FLBC_DECLARE_KERNELS(avx2)
FLBC_DECLARE_KERNELS(avx512)
#endif
#undef FLBC_DECLARE_KERNELS

#ifdef FLBC_WITH_X86_KERNELS
namespace {

bool has_avx512() {
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
         __builtin_cpu_supports("avx512dq");
}

bool has_avx2() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
}

template <class Scalar>
KernelList<Scalar> supported(const Kernel<Scalar>& avx512, const Kernel<Scalar>& avx2,
                             const Kernel<Scalar>& baseline) {
  KernelList<Scalar> list{};
  if (has_avx512()) list.kernels[list.size++] = &avx512;
  if (has_avx2()) list.kernels[list.size++] = &avx2;
  list.kernels[list.size++] = &baseline;
  return list;
}

}  // namespace
#define FLBC_SUPPORTED(name) supported(avx512::name, avx2::name, baseline::name)
#else
#define FLBC_SUPPORTED(name) \
  { {&baseline::name}, 1 }
#endif

template <>
KernelList<float> supported_kernels() {
  return FLBC_SUPPORTED(kFloat);
}
template <>
KernelList<double> supported_kernels() {
  return FLBC_SUPPORTED(kDouble);
}

#undef FLBC_SUPPORTED

}  // namespace flbc::panel
