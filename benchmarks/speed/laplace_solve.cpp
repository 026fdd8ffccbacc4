// SPDX-License-Identifier: BSD-3-Clause
// Times the direct solver of the library on the Laplacian of a domain mesh, for all control points
// at once: seconds to factor, milliseconds to solve, best and median of the repetitions.
//
//   flbc_bench_laplace DOMAIN_FILE | grid2 VERTICES | grid3 VERTICES
//                      [--columns N] [--threads T] [--repeat R] [--double]
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <string>

#include "flbc/io/mesh_io.h"
#include "linear/panel_cholesky.h"
#include "mesh/cell_geometry.h"
#include "problem/laplacian.h"

namespace {

using namespace flbc;

struct Arguments {
  std::string domain;
  Index vertices = 0;
  Index columns = 32;
  int threads = 2;
  int repeat = 50;
  bool in_double = false;
};

double seconds() {
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

// Stiffness on a grid with Dirichlet conditions all round.
Eigen::SparseMatrix<double> grid_laplacian(int dim, Index vertices) {
  const auto side = static_cast<Index>(std::lround(std::pow(vertices, 1.0 / dim)));
  Index size = 1;
  for (int d = 0; d < dim; ++d) size *= side;
  std::vector<Eigen::Triplet<double, Index>> entries;
  for (Index v = 0; v < size; ++v) {
    entries.emplace_back(v, v, 2 * dim);
    for (Index step = 1; step < size; step *= side) {
      if (v / step % side > 0) entries.emplace_back(v, v - step, -1.0);
    }
  }
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

// The part of the stiffness matrix that belongs to interior vertices.
template <int Dim>
Eigen::SparseMatrix<double> mesh_laplacian(const std::string& path) {
  const auto mesh = io::read_domain<Dim>(path);
  const auto on_boundary = boundary_vertices(build_topology(mesh), mesh.num_vertices());
  std::vector<Index> interior;
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    if (!on_boundary[v]) interior.push_back(v);
  }
  return stiffness_matrix(mesh, cell_measures(mesh), interior);
}

Eigen::SparseMatrix<double> make_matrix(const Arguments& arguments) {
  if (arguments.domain == "grid2") return grid_laplacian(2, arguments.vertices);
  if (arguments.domain == "grid3") return grid_laplacian(3, arguments.vertices);
  const auto dot = arguments.domain.rfind('.');
  const std::string extension = dot == std::string::npos ? "" : arguments.domain.substr(dot);
  const bool flat = extension == ".obj" || extension == ".off";
  return flat ? mesh_laplacian<2>(arguments.domain) : mesh_laplacian<3>(arguments.domain);
}

template <class Scalar>
void run(const Arguments& arguments) {
  const auto matrix = make_matrix(arguments);
  double start = seconds();
  const PanelCholesky<Scalar> cholesky(matrix);
  const double factor_seconds = seconds() - start;

  const std::size_t stride = padded(arguments.columns);
  AlignedArray<Scalar> rows(cholesky.size() * stride);
  std::vector<double> times;
  for (int repetition = 0; repetition < arguments.repeat; ++repetition) {
    // The same numbers every time: what is solved again and again fades to denormal numbers.
    for (std::size_t k = 0; k < rows.size(); ++k) rows[k] = static_cast<Scalar>(k % 17) - 8;
    start = seconds();
    cholesky.solve(rows.data(), stride);
    times.push_back(1e3 * (seconds() - start));
  }
  std::sort(times.begin(), times.end());
  std::printf("%s: %d unknowns, %.3f M entries, stride %zu, %d threads: factor %.3f s, ",
              arguments.domain.c_str(), int(cholesky.size()), 1e-6 * double(cholesky.num_entries()),
              stride, arguments.threads, factor_seconds);
  std::printf("solve %.3f ms best, %.3f ms median\n", times.front(), times[times.size() / 2]);
}

Arguments parse(int count, char** words) {
  if (count < 2) throw std::invalid_argument("no domain given");
  Arguments arguments;
  arguments.domain = words[1];
  for (int k = 2; k < count; ++k) {
    const std::string word = words[k];
    if (word == "--double") {
      arguments.in_double = true;
    } else if (word.rfind("--", 0) != 0) {
      arguments.vertices = std::atoi(words[k]);
    } else if (k + 1 == count) {
      throw std::invalid_argument(word + " needs a number");
    } else if (word == "--columns") {
      arguments.columns = std::atoi(words[++k]);
    } else if (word == "--threads") {
      arguments.threads = std::atoi(words[++k]);
    } else if (word == "--repeat") {
      arguments.repeat = std::atoi(words[++k]);
    } else {
      throw std::invalid_argument("unknown option " + word);
    }
  }
  if (arguments.columns < 1 || arguments.repeat < 1 || arguments.threads < 1) {
    throw std::invalid_argument("numbers must be positive");
  }
  return arguments;
}

}  // namespace

int main(int count, char** words) {
  try {
    const Arguments arguments = parse(count, words);
    omp_set_num_threads(arguments.threads);
    arguments.in_double ? run<double>(arguments) : run<float>(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "flbc_bench_laplace: %s\n", error.what());
    return 1;
  }
}
