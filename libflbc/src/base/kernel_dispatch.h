// SPDX-License-Identifier: BSD-3-Clause
// Selects the copy of an inner loop for this processor, from copies for several instruction sets.
//
// A kernel is a table of functions, the type Kernel<...> of its namespace. Its header declares it
// by FLBC_DECLARE_KERNEL; its .inl file, compiled once per instruction set with FLBC_ISA as the
// set's name, has a table `kKernel<...>` in the namespace of that name and exports it by
// FLBC_DEFINE_KERNEL.
#pragma once

namespace flbc {

enum class InstructionSet { baseline, avx2, avx512 };

//! The table compiled for one instruction set.
template <class Kernel, InstructionSet set>
const Kernel& kernel_for();

//! The tables this processor can run, best first.
template <class Kernel>
struct KernelList {
  const Kernel* kernels[3];
  int size;
};

template <class Kernel>
KernelList<Kernel> supported_kernels() {
  KernelList<Kernel> list{};
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512dq")) {
    list.kernels[list.size++] = &kernel_for<Kernel, InstructionSet::avx512>();
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    list.kernels[list.size++] = &kernel_for<Kernel, InstructionSet::avx2>();
  }
#endif
  list.kernels[list.size++] = &kernel_for<Kernel, InstructionSet::baseline>();
  return list;
}

//! The best table for this processor.
template <class Kernel>
const Kernel& select_kernel() {
  return *supported_kernels<Kernel>().kernels[0];
}

}  // namespace flbc

#define FLBC_KERNEL_FOR(set, space, ...) \
  template <>                            \
  const space::Kernel<__VA_ARGS__>& kernel_for<space::Kernel<__VA_ARGS__>, InstructionSet::set>()

//! Within namespace flbc: the kernel space::Kernel<arguments> exists for every instruction set.
#define FLBC_DECLARE_KERNEL(space, ...)          \
  FLBC_KERNEL_FOR(baseline, space, __VA_ARGS__); \
  FLBC_KERNEL_FOR(avx2, space, __VA_ARGS__);     \
  FLBC_KERNEL_FOR(avx512, space, __VA_ARGS__);

//! Within namespace flbc: the copy for the instruction set this file is compiled for.
#define FLBC_DEFINE_KERNEL(space, ...)            \
  FLBC_KERNEL_FOR(FLBC_ISA, space, __VA_ARGS__) { \
    return space::FLBC_ISA::kKernel<__VA_ARGS__>; \
  }

//! The same for Scalar = float, double and Dim = 2, 3.
#define FLBC_DECLARE_KERNELS(space)     \
  FLBC_DECLARE_KERNEL(space, float, 2)  \
  FLBC_DECLARE_KERNEL(space, float, 3)  \
  FLBC_DECLARE_KERNEL(space, double, 2) \
  FLBC_DECLARE_KERNEL(space, double, 3)
#define FLBC_DEFINE_KERNELS(space)     \
  FLBC_DEFINE_KERNEL(space, float, 2)  \
  FLBC_DEFINE_KERNEL(space, float, 3)  \
  FLBC_DEFINE_KERNEL(space, double, 2) \
  FLBC_DEFINE_KERNEL(space, double, 3)
