// SPDX-License-Identifier: BSD-3-Clause
// The state of an interrupted solve: read as `flbc solve --checkpoint` does, and gone on from.
#include <cmath>
#include <string>

#include "flbc/cage.h"
#include "flbc/solver.h"
#include "fuzz/reader.h"
#include "solve/checkpoint.h"

namespace flbc::fuzz {
namespace {

constexpr const char* kLines = "cage of the fuzzer\n";

// The points +-e_k, and the cells between them and the origin.
template <int Dim>
struct CrossPolytope {
  Cage<Dim> cage;
  DomainMesh<Dim> mesh;

  CrossPolytope() {
    constexpr Index kFacets = 1 << Dim;
    mesh.points = PointList<Dim>::Zero(Dim, 2 * Dim + 1);
    for (Index k = 0; k < 2 * Dim; ++k) mesh.points(k / 2, k) = k % 2 == 0 ? 1 : -1;
    cage.points = mesh.points.leftCols(2 * Dim);
    cage.facets.resize(Dim, kFacets);
    mesh.cells.resize(Dim + 1, kFacets);
    for (Index signs = 0; signs < kFacets; ++signs) {
      for (int k = 0; k < Dim; ++k) mesh.cells(k, signs) = 2 * k + ((signs >> k) & 1);
      mesh.cells(Dim, signs) = 2 * Dim;
    }
    normalize_and_validate(mesh);
    for (Index f = 0; f < kFacets; ++f) {
      for (int k = 0, kept = 0; k <= Dim; ++k) {
        if (mesh.cells(k, f) != 2 * Dim) cage.facets(kept++, f) = mesh.cells(k, f);
      }
    }
  }
};

// By value in the plane a run on all pairs, in space one on supports: their states differ.
template <int Dim, Method kMethod>
SolverOptions options_of_run() {
  SolverOptions options;
  options.method = kMethod;
  if (kMethod == Method::kValue) {
    options.active_pairs = Dim == 2 ? ActivePairs::kOff : ActivePairs::kOn;
  }
  options.tolerance = 1e-12;
  options.gap = 0;
  options.check_interval = 2;
  options.max_iterations = 12;
  options.threads = 1;
  return options;
}

template <int Dim, Method kMethod>
void read_checkpoint(const std::string& path) {
  const auto run = app::Checkpoint<Dim>({path}, kLines).find();
  require(run.has_value(), "a file that is there is read or refused");
  const auto& domain = run->solved.domain;
  require_indices_in_range(domain);
  static const CrossPolytope<Dim> sample;
  auto options = options_of_run<Dim, kMethod>();
  options.resume_from = run->state;
  require(!run->state.empty(), "there is a state");
  const auto solution = solve_sparse(sample.cage, domain, options);
  for (const double weight : solution.weights.values()) {
    require(std::isfinite(weight), "weights are finite");
  }
}

// Of a run after its first iterations, without the checksum.
template <int Dim, Method kMethod>
std::string checkpoint() {
  const CrossPolytope<Dim> sample;
  app::SolvedDomain<Dim> solved;
  solved.domain = sample.mesh;
  return written("a.state", [&](const std::string& path) {
    auto options = options_of_run<Dim, kMethod>();
    options.progress = [&](const Progress& progress) {
      app::Checkpoint<Dim>({path, 0}, kLines).look(progress, solved, {app::HistoryEntry{2, 0}});
      return false;
    };
    solve_sparse(sample.cage, sample.mesh, options);
  });
}

template <int Dim, Method kMethod>
Reader checkpoint_reader(const std::string& name) {
  return {name,
          "input.state",
          read_checkpoint<Dim, kMethod>,
          {without_hash(checkpoint<Dim, kMethod>())},
          {},
          with_hash};
}

}  // namespace

std::vector<Reader> checkpoint_readers() {
  return {checkpoint_reader<2, Method::kValue>("checkpoint_2d"),
          checkpoint_reader<3, Method::kValue>("checkpoint_3d"),
          checkpoint_reader<2, Method::kGradient>("checkpoint_gradient"),
          checkpoint_reader<3, Method::kLbc2014>("checkpoint_lbc2014")};
}

}  // namespace flbc::fuzz
