// SPDX-License-Identifier: BSD-3-Clause
#define FLBC_ISA baseline
#include "solver/methods/gradient/gradient_kernel.inl"
