// SPDX-License-Identifier: BSD-3-Clause
#define FLBC_ISA avx2
#include "solver/methods/gradient/gradient_kernel.inl"
