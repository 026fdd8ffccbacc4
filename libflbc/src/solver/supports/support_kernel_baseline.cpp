// SPDX-License-Identifier: BSD-3-Clause
#define FLBC_ISA baseline
#include "solver/supports/support_kernel.inl"
