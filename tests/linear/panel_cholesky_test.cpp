// SPDX-License-Identifier: BSD-3-Clause
#include "linear/panel_cholesky.h"

#include <omp.h>
#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <future>

#include "linear/sparse_factor.h"
#include "problem/laplacian.h"
#include "support/test.h"

namespace flbc::testing {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

constexpr std::size_t kStrides[] = {8, 32, 56, 64};

// A random pattern with a dominant diagonal. The denser, the wider the supernodes.
Sparse random_matrix(Index size, int per_column, unsigned seed) {
  std::mt19937 random(seed);
  Sparse matrix(size, size);
  std::vector<Eigen::Triplet<double, Index>> entries;
  Eigen::VectorXd diagonal = Eigen::VectorXd::Constant(size, 0.1);
  for (Index j = 0; j < size; ++j) {
    for (int k = 0; k < per_column; ++k) {
      const auto i = static_cast<Index>(random() % unsigned(size));
      if (i == j) continue;
      const double value = static_cast<double>(random() % 2001) / 1000 - 1;
      entries.emplace_back(i, j, value);
      entries.emplace_back(j, i, value);
      diagonal[i] += std::abs(value);
      diagonal[j] += std::abs(value);
    }
  }
  for (Index j = 0; j < size; ++j) entries.emplace_back(j, j, diagonal[j]);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

// Stiffness and some mass on a sample mesh.
template <int Dim>
Sparse mesh_matrix(Shape shape, Index subdivisions) {
  const auto sample = make_sample<Dim>(shape, subdivisions, 0.2);
  Sparse matrix = stiffness_matrix(sample.mesh);
  const Eigen::VectorXd mass = lumped_mass(sample.mesh);
  for (Index v = 0; v < mass.size(); ++v) matrix.coeffRef(v, v) += mass[v];
  return matrix;
}

struct NamedMatrix {
  std::string name;
  Sparse matrix;
};

// From a diagonal, where every supernode has one column and no rows below it, to nearly dense.
const std::vector<NamedMatrix>& matrices() {
  static const std::vector<NamedMatrix> kMatrices{
      {"diagonal", random_matrix(40, 0, 1)},
      {"sparse", random_matrix(300, 1, 2)},
      {"denser", random_matrix(300, 4, 3)},
      {"dense", random_matrix(130, 100, 4)},
      {"box in the plane", mesh_matrix<2>(Shape::kBox, 25)},
      {"ring in the plane", mesh_matrix<2>(Shape::kRing, 10)},
      {"box in space", mesh_matrix<3>(Shape::kBox, 8)},
      {"corner in space", mesh_matrix<3>(Shape::kCorner, 5)}};
  return kMatrices;
}

template <class Scalar>
using RowMajor = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Numbers of -1 .. 1 that both precisions hold exactly, the same for every precision.
template <class Scalar>
AlignedArray<Scalar> random_rows(Index size, std::size_t stride) {
  std::mt19937 random(5);
  AlignedArray<Scalar> rows(size * stride);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    rows[k] = static_cast<Scalar>(int(random() % 2049) - 1024) / 1024;
  }
  return rows;
}

template <class Scalar>
AlignedArray<Scalar> solution_of(const PanelCholesky<Scalar>& cholesky, std::size_t stride = 8) {
  auto rows = random_rows<Scalar>(cholesky.size(), stride);
  cholesky.solve(rows.data(), stride);
  return rows;
}

template <class Scalar>
bool same_bits(const AlignedArray<Scalar>& a, const AlignedArray<Scalar>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Scalar)) == 0;
}

// Largest difference from Eigen's solution, relative to the largest number of that.
template <class Scalar>
double error_against_eigen(const Sparse& matrix, const std::vector<Index>& position,
                           const AlignedArray<Scalar>& right_hand_side,
                           const AlignedArray<Scalar>& solution, std::size_t stride) {
  const Eigen::Map<const RowMajor<Scalar>> b(right_hand_side.data(), matrix.rows(), stride);
  const Eigen::Map<const RowMajor<Scalar>> x(solution.data(), matrix.rows(), stride);
  Eigen::MatrixXd ordered(matrix.rows(), stride);
  for (Index v = 0; v < matrix.rows(); ++v) {
    ordered.row(v) = b.row(position[v]).template cast<double>();
  }
  const Eigen::SimplicialLDLT<Sparse> reference(matrix);
  const Eigen::MatrixXd expected = reference.solve(ordered);
  double error = 0;
  for (Index v = 0; v < matrix.rows(); ++v) {
    const Eigen::RowVectorXd row = x.row(position[v]).template cast<double>();
    error = std::max(error, (row - expected.row(v)).cwiseAbs().maxCoeff());
  }
  return error / expected.cwiseAbs().maxCoeff();
}

template <class Scalar>
class PanelCholeskyTest : public ::testing::Test {
 protected:
  static constexpr double kTolerance = sizeof(Scalar) == 4 ? 1e-5 : 1e-12;
};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(PanelCholeskyTest, Scalars);

TYPED_TEST(PanelCholeskyTest, AnyNumberOfThreadsGivesTheSameBits) {
  for (const auto& [name, matrix] : matrices()) {
    const PanelCholesky<TypeParam> cholesky(matrix);
    for (const std::size_t stride : kStrides) {
      auto alone = random_rows<TypeParam>(cholesky.size(), stride);
      cholesky.solve_slice(alone.data(), stride, 0, stride);
      for (const int threads : {1, 2, 3}) {
        const ThreadScope scope(threads);
        EXPECT_TRUE(same_bits(alone, solution_of(cholesky, stride)))
            << name << ", " << threads << " threads";
      }
    }
  }
}

// The loops for every instruction set this processor has, in slices of every width.
TYPED_TEST(PanelCholeskyTest, EveryKernelSolvesTheSameSystem) {
  const auto list = supported_kernels<panel::Kernel<TypeParam>>();
  ASSERT_GE(list.size, 1);
  for (const auto& [name, matrix] : matrices()) {
    for (int k = 0; k < list.size; ++k) {
      const PanelCholesky<TypeParam> cholesky(matrix, *list.kernels[k]);
      ASSERT_EQ(cholesky.size(), matrix.rows());
      for (const std::size_t stride : kStrides) {
        SCOPED_TRACE(name + ", kernel " + std::to_string(k) + ", " + std::to_string(stride));
        const auto right_hand_side = random_rows<TypeParam>(cholesky.size(), stride);
        auto whole = random_rows<TypeParam>(cholesky.size(), stride);
        cholesky.solve_slice(whole.data(), stride, 0, stride);
        EXPECT_LT(error_against_eigen(matrix, cholesky.position(), right_hand_side, whole, stride),
                  TestFixture::kTolerance);
        for (const std::size_t width : {8, 16, 24, 40}) {
          auto parts = random_rows<TypeParam>(cholesky.size(), stride);
          for (std::size_t begin = 0; begin < stride; begin += width) {
            cholesky.solve_slice(parts.data(), stride, begin, std::min(stride, begin + width));
          }
          EXPECT_TRUE(same_bits(whole, parts)) << "slices of " << width;
        }
      }
    }
  }
}

TYPED_TEST(PanelCholeskyTest, ReadsTheLowerTriangleOnly) {
  const Sparse matrix = matrices()[2].matrix;
  Sparse lower = matrix.triangularView<Eigen::Lower>();
  Sparse spoilt = matrix;
  for (Index j = 0; j < spoilt.cols(); ++j) {
    for (Sparse::InnerIterator it(spoilt, j); it; ++it) {
      if (it.row() < j) it.valueRef() = 1e9;
    }
  }
  const PanelCholesky<TypeParam> reference(matrix);
  for (const Sparse* other : {&lower, &spoilt}) {
    const PanelCholesky<TypeParam> cholesky(*other);
    EXPECT_EQ(cholesky.position(), reference.position());
    EXPECT_TRUE(same_bits(solution_of(cholesky), solution_of(reference)));
  }
}

TYPED_TEST(PanelCholeskyTest, NoUnknownAndOne) {
  const PanelCholesky<TypeParam> none(Sparse(0, 0));
  EXPECT_EQ(none.size(), 0);
  EXPECT_EQ(none.num_entries(), 0u);
  none.solve(nullptr, 8);

  Sparse four(1, 1);
  four.insert(0, 0) = 4;
  const PanelCholesky<TypeParam> one(four);
  EXPECT_EQ(one.position(), std::vector<Index>{0});
  AlignedArray<TypeParam> rows(8);
  for (int k = 0; k < 8; ++k) rows[k] = static_cast<TypeParam>(k);
  one.solve(rows.data(), 8);
  for (int k = 0; k < 8; ++k) EXPECT_EQ(rows[k], static_cast<TypeParam>(k) / 4);
}

TYPED_TEST(PanelCholeskyTest, RefusesWhatIsNotPositiveDefinite) {
  const double kNotANumber = std::numeric_limits<double>::quiet_NaN();
  for (const double pivot : {-1.0, 0.0, kNotANumber}) {
    Sparse matrix = matrices()[1].matrix;
    matrix.coeffRef(17, 17) = pivot;
    expect_error<SolverError>([&] { const PanelCholesky<TypeParam> cholesky(matrix); },
                              {"300 unknowns"});
  }
}

TEST(SparseFactorTest, TimesItsTransposeIsTheMatrix) {
  for (const auto& [name, matrix] : matrices()) {
    const SparseFactor factor = factor_sparse(matrix);
    Eigen::MatrixXd lower = Eigen::MatrixXd::Zero(matrix.rows(), matrix.cols());
    Index next = 0;
    for (const Supernode& supernode : factor.supernodes) {
      EXPECT_EQ(supernode.first, next) << name;
      next += supernode.width;
      for (Index k = 0; k < supernode.width; ++k) {
        EXPECT_EQ(supernode.rows[k], supernode.first + k) << name;
        for (Index r = k; r < supernode.num_rows; ++r) {
          lower(supernode.rows[r], supernode.first + k) =
              supernode.values[r + std::ptrdiff_t(k) * supernode.num_rows];
        }
      }
    }
    EXPECT_EQ(next, matrix.rows()) << name;
    const Eigen::MatrixXd product = lower * lower.transpose();
    double error = 0;
    for (Index i = 0; i < matrix.rows(); ++i) {
      for (Index j = 0; j < matrix.rows(); ++j) {
        error = std::max(
            error, std::abs(product(factor.position[i], factor.position[j]) - matrix.coeff(i, j)));
      }
    }
    EXPECT_LT(error, 1e-12 * Eigen::MatrixXd(matrix).cwiseAbs().maxCoeff()) << name;
  }
}

TEST(SliceOfTest, CoversEveryColumnOnceAndStartsOnCacheLines) {
  for (std::size_t stride = 0; stride <= 200; stride += 8) {
    for (int threads = 1; threads <= 9; ++threads) {
      std::size_t next = 0;
      for (int t = 0; t < threads; ++t) {
        const Slice slice = slice_of(stride, t, threads);
        EXPECT_EQ(slice.begin, next);
        EXPECT_GE(slice.end, slice.begin);
        if (slice.begin < stride) {
          EXPECT_EQ(slice.begin % 16, 0u);
        }
        // Nobody has more than one unit above the fair share.
        EXPECT_LT(slice.end - slice.begin, stride / threads + 16 + 16);
        next = slice.end;
      }
      EXPECT_EQ(next, stride);
    }
  }
}

// BLAS libraries need not be reentrant: OpenBLAS without threads returned wrong factors.
TEST(SparseFactorTest, ThreadsFactorAtOnce) {
  const Sparse matrix = random_matrix(300, 8, 1);
  const auto values = [](const SparseFactor& factor) {
    std::vector<double> lower;
    for (const Supernode& supernode : factor.supernodes) {
      for (Index k = 0; k < supernode.width; ++k) {
        const double* const column = supernode.values + std::size_t(k) * supernode.num_rows;
        lower.insert(lower.end(), column + k, column + supernode.num_rows);
      }
    }
    return lower;
  };
  const auto expected = values(factor_sparse(matrix));
  const auto count_others = [&] {
    int others = 0;
    for (int k = 0; k < 100; ++k) others += values(factor_sparse(matrix)) != expected;
    return others;
  };
  std::array<std::future<int>, 4> threads;
  for (auto& thread : threads) thread = std::async(std::launch::async, count_others);
  for (auto& thread : threads) EXPECT_EQ(thread.get(), 0);
}

}  // namespace
}  // namespace flbc::testing
