// SPDX-License-Identifier: BSD-3-Clause
#include "solve/cache_key.h"

#include <sstream>

#include "flbc/names.h"
#include "flbc/version.h"

namespace flbc::app {
namespace {

void add_options(std::ostream& key, const SolverOptions& options) {
  // All members are named, so that a new one does not compile until it is decided whether weights
  // depend on it. They do not on these: results are the same bits for any number of threads, and a
  // run that was stopped has not converged.
  [[maybe_unused]] const auto& [method, phi, distances, precision, recovery, non_negative,
                                linear_solver, coarse_to_fine, coarse_levels, tolerance, gap,
                                active_pairs, max_iterations, penalty, relaxation, check_interval,
                                certify, threads, progress, stage_progress] = options;
  const auto& [coarsest, factor, looseness] = coarse_levels;
  key << "method " << name_of(method) << '\n'
      << "phi " << name_of(phi) << '\n'
      << "distances " << name_of(distances) << '\n'
      << "precision " << name_of(precision) << '\n'
      << "recovery " << name_of(recovery) << '\n'
      << "non_negative " << name_of(non_negative) << '\n'
      << "linear_solver " << name_of(linear_solver) << '\n'
      << "coarse_to_fine " << name_of(coarse_to_fine) << '\n'
      << "coarse_levels " << coarsest << ' ' << factor << ' ' << looseness << '\n'
      << "tolerance " << tolerance << '\n'
      << "gap " << gap.value_or(0) << '\n'
      << "active_pairs " << name_of(active_pairs) << '\n'
      << "max_iterations " << max_iterations << '\n'
      << "penalty " << penalty << '\n'
      << "relaxation " << relaxation << '\n'
      << "check_interval " << check_interval << '\n'
      << "certify " << certify << '\n';
}

template <class Matrix>
void add_numbers(std::ostream& key, const char* name, const Matrix& matrix) {
  key << name << ' ' << matrix.rows() << " x " << matrix.cols() << '\n';
  key.write(reinterpret_cast<const char*>(matrix.data()),
            static_cast<std::streamsize>(sizeof(typename Matrix::Scalar)) * matrix.size());
  key << '\n';
}

}  // namespace

template <int Dim>
std::string key_of(const WeightOrigin<Dim>& origin) {
  std::ostringstream key;
  key << std::hexfloat;  // all bits of a number
  key << "version " << FLBC_VERSION << '\n'
      << "dim " << Dim << '\n'
      << "published_penalty " << origin.penalty << '\n'
      << "can_mesh " << origin.can_mesh << '\n'
      << "mesher " << name_of(origin.mesher) << '\n';
  add_options(key, resolve(origin.options));
  add_numbers(key, "control_points", origin.cage.points);
  add_numbers(key, "facets", origin.cage.facets);
  if (origin.domain) {
    add_numbers(key, "domain_points", origin.domain->points);
    add_numbers(key, "domain_cells", origin.domain->cells);
    return key.str();
  }
  key << "vertices " << origin.vertices << '\n';
  if (origin.embedded) add_numbers(key, "embedded", *origin.embedded);
  return key.str();
}

template std::string key_of(const WeightOrigin<2>&);
template std::string key_of(const WeightOrigin<3>&);

}  // namespace flbc::app
