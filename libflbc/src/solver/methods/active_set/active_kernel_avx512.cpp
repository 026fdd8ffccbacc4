// SPDX-License-Identifier: BSD-3-Clause
#define FLBC_ISA avx512
#include "solver/methods/active_set/active_kernel.inl"
