// SPDX-License-Identifier: BSD-3-Clause
#define FLBC_ISA baseline
#include "linear/multigrid_kernel.inl"
