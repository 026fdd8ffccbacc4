// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Coarser unknowns for a matrix, by smoothed aggregation (Vanek, Mandel, Brezina 1996).
#pragma once

#include <vector>

#include "flbc/types.h"
#include "linear/row_matrix.h"

namespace flbc {

//! Groups each unknown with those it is strongly coupled to.
//! \param matrix  symmetric, N x N \return of each unknown the number of its group, 0 .. groups - 1
std::vector<Index> aggregate(const RowMatrix& matrix, Index& num_groups);

//! P = (I - omega D^-1 A) P_0, where P_0 is 1 for the members of each group: functions that are
//! constant on groups, made smooth. \return N x groups
RowMatrix smoothed_prolongation(const RowMatrix& matrix);

//! P^T A P. \param matrix  A \param prolongation  P
RowMatrix coarse_matrix(const RowMatrix& matrix, const RowMatrix& prolongation);

}  // namespace flbc
