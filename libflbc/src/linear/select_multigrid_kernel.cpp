// SPDX-License-Identifier: BSD-3-Clause
#include "base/kernel_dispatch.h"
#include "linear/multigrid_kernel.h"

namespace flbc::multigrid {

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

template <>
const Kernel<float>& select_kernel() {
  return FLBC_CHOOSE_KERNEL(kFloat);
}
template <>
const Kernel<double>& select_kernel() {
  return FLBC_CHOOSE_KERNEL(kDouble);
}

}  // namespace flbc::multigrid
