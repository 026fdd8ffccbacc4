// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Differences of weights.
#pragma once

#include "flbc/sparse_weights.h"

namespace flbc {

//! \return after - before, of P points \throws InputError if sizes differ
SparseWeights difference_of(const SparseWeights& before, const SparseWeights& after);

}  // namespace flbc
