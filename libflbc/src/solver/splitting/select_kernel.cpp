// SPDX-License-Identifier: BSD-3-Clause
#include "base/kernel_dispatch.h"
#include "solver/splitting/splitting_kernel.h"

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

template <>
const Kernel<float, 2>& select_kernel() {
  return FLBC_CHOOSE_KERNEL(kFloat2);
}
template <>
const Kernel<float, 3>& select_kernel() {
  return FLBC_CHOOSE_KERNEL(kFloat3);
}
template <>
const Kernel<double, 2>& select_kernel() {
  return FLBC_CHOOSE_KERNEL(kDouble2);
}
template <>
const Kernel<double, 3>& select_kernel() {
  return FLBC_CHOOSE_KERNEL(kDouble3);
}

}  // namespace flbc::splitting
