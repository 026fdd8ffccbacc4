// SPDX-License-Identifier: BSD-3-Clause
// Coarse unknowns of a matrix, by smoothed aggregation (Vanek, Mandel, Brezina 1996).
#pragma once

#include "linear/row_matrix.h"

namespace flbc {

//! P = (I - omega D^-1 A) P_0, where P_0 is 1 for the members of each group of unknowns that are
//! strongly coupled: smoothed piecewise constant functions.
//! \param matrix  A, symmetric, N x N \return N x groups
RowMatrix smoothed_prolongation(const RowMatrix& matrix);

//! P^T A P. \param matrix  A \param prolongation  P
RowMatrix coarse_matrix(const RowMatrix& matrix, const RowMatrix& prolongation);

}  // namespace flbc
