// SPDX-License-Identifier: BSD-3-Clause
#define FLBC_ISA baseline
#include "solver/methods/splitting/compact_kernel.inl"
