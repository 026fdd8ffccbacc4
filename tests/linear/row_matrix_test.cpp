// SPDX-License-Identifier: BSD-3-Clause
// Sparse matrices assembled by several threads equal those of the textbook, and are bit-identical
// for any number of threads.
#include "linear/row_matrix.h"
#include "linear/matrix_arrays.h"
#include "support/test.h"

namespace flbc::testing {
namespace {

using Triplet = Eigen::Triplet<double, Index>;

// Several parts of one entry among them, and empty rows.
std::vector<Triplet> random_parts(Index rows, Index columns, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Triplet> parts;
  for (Index row = 0; row < rows; ++row) {
    for (int k = static_cast<int>(random() % 9); k-- > 0;) {
      const double value = std::uniform_real_distribution<double>(-1, 1)(random);
      parts.emplace_back(row, static_cast<Index>(random() % columns), value);
    }
  }
  return parts;
}

RowMatrix by_eigen(Index rows, Index columns, const std::vector<Triplet>& parts) {
  RowMatrix matrix(rows, columns);
  matrix.setFromTriplets(parts.begin(), parts.end());
  return matrix;
}

RowMatrix by_rows(Index rows, Index columns, const std::vector<Triplet>& parts) {
  std::vector<std::vector<Triplet>> of_row(rows);
  for (const auto& part : parts) of_row[part.row()].push_back(part);
  return assemble_rows(rows, columns, [&](Index row, const auto& add) {
    for (const auto& part : of_row[row]) add(part.col(), part.value());
  });
}

void expect_same_bits(const RowMatrix& a, const RowMatrix& b) {
  ASSERT_EQ(a.rows(), b.rows());
  ASSERT_EQ(a.cols(), b.cols());
  ASSERT_EQ(a.nonZeros(), b.nonZeros());
  for (Eigen::Index k = 0; k <= a.rows(); ++k) {
    ASSERT_EQ(a.outerIndexPtr()[k], b.outerIndexPtr()[k]);
  }
  for (Eigen::Index k = 0; k < a.nonZeros(); ++k) {
    ASSERT_EQ(a.innerIndexPtr()[k], b.innerIndexPtr()[k]);
    ASSERT_EQ(std::memcmp(a.valuePtr() + k, b.valuePtr() + k, sizeof(double)), 0);
  }
}

TEST(RowMatrix, IsTheSumOfItsParts) {
  for (const Index rows : {0, 1, 7, 999, 1000, 5003}) {
    SCOPED_TRACE(rows);
    const auto parts = random_parts(rows, 40, 1);
    const auto expected = by_eigen(rows, 40, parts);
    for (const int threads : {1, 2, 5}) {
      const ThreadScope scope(threads);
      expect_same_bits(by_rows(rows, 40, parts), expected);
    }
  }
}

TEST(RowMatrix, MultipliesAsDenseMatricesDo) {
  const auto a = by_eigen(1500, 60, random_parts(1500, 60, 2));
  const auto b = by_eigen(60, 90, random_parts(60, 90, 3));
  const Eigen::MatrixXd expected = Eigen::MatrixXd(a) * Eigen::MatrixXd(b);
  const auto whole = product(a, b);
  EXPECT_LT((Eigen::MatrixXd(whole) - expected).cwiseAbs().maxCoeff(), 1e-14);
  for (const int threads : {1, 3}) {
    const ThreadScope scope(threads);
    expect_same_bits(product(a, b), whole);
  }
}

TEST(RowMatrix, MovesRowsAndColumns) {
  const auto matrix = by_eigen(6, 4, random_parts(6, 4, 4));
  const std::vector<Index> rows = {3, 0, 5, 1, 2, 4};
  const std::vector<Index> columns = {2, 0, 3, 1};
  const Eigen::MatrixXd before = matrix;
  const Eigen::MatrixXd moved = reordered(matrix, rows, columns);
  for (Index i = 0; i < 6; ++i) {
    for (Index j = 0; j < 4; ++j) EXPECT_EQ(moved(rows[i], columns[j]), before(i, j));
  }
}

}  // namespace
}  // namespace flbc::testing
