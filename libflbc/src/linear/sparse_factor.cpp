// SPDX-License-Identifier: BSD-3-Clause
#include "linear/sparse_factor.h"

#include <cmath>
#include <mutex>
#include <new>
#include <string>

#include "flbc/errors.h"

#ifdef FLBC_WITH_CHOLMOD
#include <sys/mman.h>

#include <Eigen/CholmodSupport>
#else
#include <Eigen/SparseCholesky>
#endif

namespace flbc {
namespace {

constexpr const char* kNotDefinite =
    "not positive definite; nearly flat cells of the mesh are the usual cause";

[[noreturn]] void fail(Eigen::Index size, const char* reason) {
  throw SolverError("a linear system with " + std::to_string(size) +
                    " unknowns cannot be factored: it is " + reason);
}

#ifdef FLBC_WITH_CHOLMOD

class CholmodFactor : public Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>> {
 public:
  CholmodFactor() {
    cholmod().print = 0;  // otherwise CHOLMOD prints errors to standard output
    // Solves with a dozen or more right-hand sides are fast on narrower columns than CHOLMOD
    // assumes: merging supernodes less saves a tenth of their time.
    cholmod().nrelax[0] = 2;
    cholmod().nrelax[1] = 8;
    cholmod().zrelax[0] = 0.5;
  }

  void check(Eigen::Index size) {
    const int status = cholmod().status;
    if (status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
    if (status == CHOLMOD_NOT_POSDEF) fail(size, kNotDefinite);
    if (status == CHOLMOD_TOO_LARGE) fail(size, "too large");
    if (status < CHOLMOD_OK) fail(size, "not understood by CHOLMOD");
  }

  const cholmod_factor& factor() const { return *m_cholmodFactor; }
  void free_work() { cholmod_free_work(&cholmod()); }
};

// OpenBLAS takes a buffer at its first use, and tries for ever if there is no room for it.
// One thread at a time.
void require_room_for_blas(std::size_t numbers_in_factor) {
  static bool has_room = false;
  if (has_room) return;
  constexpr std::size_t kBuffer = 160 << 20;
  const std::size_t size = kBuffer + numbers_in_factor * sizeof(double);
  void* const room =
      mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED) throw std::bad_alloc();
  munmap(room, size);
  has_room = true;
}

SparseFactor factor_nonempty(const Eigen::SparseMatrix<double>& matrix) {
  // OpenBLAS without threads, which Debian has, returns wrong numbers when threads call it at once.
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  const auto cholmod = std::make_shared<CholmodFactor>();
  cholmod->analyzePattern(matrix);
  cholmod->check(matrix.rows());
  require_room_for_blas(cholmod->factor().xsize);
  cholmod->factorize(matrix);
  cholmod->check(matrix.rows());
  cholmod->free_work();

  const cholmod_factor& factor = cholmod->factor();
  SparseFactor result;
  result.owner = cholmod;
  result.position.resize(factor.n);
  const auto* order = static_cast<const Index*>(factor.Perm);
  for (std::size_t k = 0; k < factor.n; ++k) result.position[order[k]] = static_cast<Index>(k);
  const auto* first = static_cast<const Index*>(factor.super);
  const auto* row_offsets = static_cast<const Index*>(factor.pi);
  const auto* value_offsets = static_cast<const Index*>(factor.px);
  result.supernodes.reserve(factor.nsuper);
  for (std::size_t s = 0; s < factor.nsuper; ++s) {
    result.supernodes.push_back({first[s], first[s + 1] - first[s],
                                 row_offsets[s + 1] - row_offsets[s],
                                 static_cast<const Index*>(factor.s) + row_offsets[s],
                                 static_cast<const double*>(factor.x) + value_offsets[s]});
  }
  return result;
}

#else

using Factor = Eigen::SparseMatrix<double>;

// A growing supernode: neighboring columns, each the parent of the previous one in the elimination
// tree. Its rows are the columns themselves and the rows of the last column.
struct Run {
  Index first;
  Index width;
  Index last_rows;       // number of rows of the last column, including the diagonal
  std::int64_t entries;  // of the columns, without added zeros

  std::int64_t stored() const {
    return std::int64_t(width) * last_rows + std::int64_t(width) * (width - 1) / 2;
  }
};

// Storing zeros pays if it makes a block of columns wide enough for the registers.
bool is_worth_storing(const Run& run) {
  const double zeros = static_cast<double>(run.stored() - run.entries);
  const double allowed = run.width <= 4 ? 0.6 : run.width <= 16 ? 0.2 : 0.05;
  return zeros <= allowed * static_cast<double>(run.stored());
}

std::vector<Run> group_columns(const Factor& factor) {
  std::vector<Run> runs;
  const Index* offset = factor.outerIndexPtr();
  for (Index j = 0; j < factor.cols(); ++j) {
    const Index count = offset[j + 1] - offset[j];
    if (j > 0 && offset[j] - offset[j - 1] > 1 && factor.innerIndexPtr()[offset[j - 1] + 1] == j) {
      const Run& run = runs.back();
      const Run longer{run.first, run.width + 1, count, run.entries + count};
      if (is_worth_storing(longer)) {
        runs.back() = longer;
        continue;
      }
    }
    runs.push_back({j, 1, count, count});
  }
  return runs;
}

struct SupernodeStorage {
  std::vector<Index> rows;
  std::vector<double> values;
};

// Copies the columns of a run, including zeros.
void append(const Factor& factor, const Run& run, SupernodeStorage& storage) {
  const std::size_t num_rows = run.last_rows + run.width - 1;
  const std::size_t begin = storage.rows.size();
  for (Index k = 0; k + 1 < run.width; ++k) storage.rows.push_back(run.first + k);
  for (Factor::InnerIterator it(factor, run.first + run.width - 1); it; ++it) {
    storage.rows.push_back(static_cast<Index>(it.row()));
  }
  storage.values.resize(storage.values.size() + num_rows * run.width);
  double* values = storage.values.data() + storage.values.size() - num_rows * run.width;
  for (Index k = 0; k < run.width; ++k, values += num_rows) {
    const Index* row = storage.rows.data() + begin;
    for (Factor::InnerIterator it(factor, run.first + k); it; ++it) {
      while (*row != it.row()) ++row;
      values[row - storage.rows.data() - begin] = it.value();
    }
  }
}

SparseFactor factor_nonempty(const Eigen::SparseMatrix<double>& matrix) {
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower> cholesky(matrix);
  if (cholesky.info() != Eigen::Success) fail(matrix.rows(), kNotDefinite);
  const Factor& factor = cholesky.matrixL().nestedExpression();
  // The test for a positive pivot accepts NaN.
  if (!factor.coeffs().isFinite().all()) fail(matrix.rows(), kNotDefinite);

  SparseFactor result;
  const auto& order = cholesky.permutationP().indices();
  result.position.assign(order.data(), order.data() + order.size());
  const auto storage = std::make_shared<SupernodeStorage>();
  const auto runs = group_columns(factor);
  for (const Run& run : runs) append(factor, run, *storage);
  const Index* rows = storage->rows.data();
  const double* values = storage->values.data();
  for (const Run& run : runs) {
    const Index num_rows = run.last_rows + run.width - 1;
    result.supernodes.push_back({run.first, run.width, num_rows, rows, values});
    rows += num_rows;
    values += std::size_t(num_rows) * run.width;
  }
  result.owner = storage;
  return result;
}

#endif

// Some BLAS libraries do not detect NaN and continue.
bool has_positive_diagonal(const SparseFactor& factor) {
  for (const Supernode& supernode : factor.supernodes) {
    for (Index k = 0; k < supernode.width; ++k) {
      const double pivot = supernode.values[std::size_t(k) * supernode.num_rows + k];
      if (!(pivot > 0) || !std::isfinite(pivot)) return false;
    }
  }
  return true;
}

}  // namespace

SparseFactor factor_sparse(const Eigen::SparseMatrix<double>& matrix) {
  if (matrix.rows() == 0) return {};
  auto factor = factor_nonempty(matrix);
  if (!has_positive_diagonal(factor)) fail(matrix.rows(), kNotDefinite);
  return factor;
}

}  // namespace flbc
