// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The Cholesky factor of a sparse matrix in the form in which sparse libraries have it: dense
//! blocks of columns with the same rows.
#pragma once

#include <memory>
#include <vector>

#include <Eigen/SparseCore>

#include "flbc/types.h"

namespace flbc {

//! Neighbouring columns of the factor that are stored with the same rows.
struct Supernode {
  Index first;           //!< the first of its columns, which stand one after the other
  Index width;           //!< number of columns
  Index num_rows;        //!< number of rows, at least `width`
  const Index* rows;     //!< ascending; the first `width` are the columns themselves
  const double* values;  //!< num_rows x width, column-major; nothing is said above the diagonal
};

//! P A P^T = L L^T.
struct SparseFactor {
  std::vector<Index> position;        //!< of every unknown in the order of elimination: P
  std::vector<Supernode> supernodes;  //!< L, in the order of their columns
  std::shared_ptr<const void> owner;  //!< keeps what the supernodes point to
};

//! Factors with CHOLMOD where the library was built with it, with Eigen otherwise.
//! \param matrix  symmetric positive definite; only the lower triangle is read
//! \throws SolverError naming the size if the matrix is not positive definite, or too large
SparseFactor factor_sparse(const Eigen::SparseMatrix<double>& matrix);

}  // namespace flbc
