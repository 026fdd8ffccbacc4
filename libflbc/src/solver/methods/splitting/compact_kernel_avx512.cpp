// SPDX-License-Identifier: BSD-3-Clause
#define FLBC_ISA avx512
#include "solver/methods/splitting/compact_kernel.inl"
