// SPDX-License-Identifier: BSD-3-Clause
#define FLBC_ISA baseline
#include "solver/methods/active_set/active_kernel.inl"
