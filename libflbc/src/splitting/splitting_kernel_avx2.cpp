// SPDX-License-Identifier: BSD-3-Clause
#define FLBC_ISA avx2
#include "splitting/splitting_kernel.inl"
