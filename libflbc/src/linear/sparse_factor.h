// SPDX-License-Identifier: BSD-3-Clause
// The Cholesky factor of a sparse matrix in supernodal form: dense blocks of columns with the same
// rows.
#pragma once

#include <memory>
#include <vector>

#include <Eigen/SparseCore>

#include "flbc/types.h"

namespace flbc {

//! Neighboring columns of the factor that are stored with the same rows.
struct Supernode {
  Index first;           //!< first of its consecutive columns
  Index width;           //!< number of columns
  Index num_rows;        //!< number of rows, at least `width`
  const Index* rows;     //!< ascending; the first `width` are the columns themselves
  const double* values;  //!< num_rows x width, column-major; undefined above the diagonal
};

//! P A P^T = L L^T.
struct SparseFactor {
  std::vector<Index> position;        //!< elimination position of every unknown: P
  std::vector<Supernode> supernodes;  //!< L, in the order of their columns
  std::shared_ptr<const void> owner;  //!< owns the data of the supernodes
};

//! Factors with CHOLMOD if the library was built with it, otherwise with Eigen.
//! \param matrix  symmetric positive definite; only the lower triangle is read
//! \throws SolverError naming the size if the matrix is not positive definite, or too large
SparseFactor factor_sparse(const Eigen::SparseMatrix<double>& matrix);

}  // namespace flbc
