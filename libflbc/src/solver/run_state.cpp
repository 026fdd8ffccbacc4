// SPDX-License-Identifier: BSD-3-Clause
#include "solver/run_state.h"

#include <chrono>
#include <cstring>
#include <utility>

#include "flbc/errors.h"
#include "flbc/option_lines.h"
#include "flbc/version.h"

namespace flbc {
namespace {

// Of all that the bits of a run depend on.
template <int Dim>
std::uint64_t origin_of(const SolverOptions& options, const Cage<Dim>& cage,
                        const DomainMesh<Dim>& mesh) {
  const std::string lines =
      "flbc run of " FLBC_VERSION ", of supports or all pairs\n" + option_lines(options);
  ContentHash hash;
  hash.add(lines.data(), lines.size());
  const Index sizes[] = {Dim, cage.size(), mesh.num_vertices(), mesh.num_cells()};
  char bytes[sizeof sizes];
  std::memcpy(bytes, sizes, sizeof sizes);
  hash.add(bytes, sizeof bytes);
  hash.add(cage.points);
  hash.add(cage.facets);
  hash.add(mesh.points);
  hash.add(mesh.cells);
  return hash.value();
}

// Options by which a state that is offered is preceded by what `write` writes.
SolverOptions preceded_by(SolverOptions options, std::function<void(ByteWriter&)> write) {
  if (!options.progress) return options;
  options.progress = [write = std::move(write),
                      tell = std::move(options.progress)](Progress progress) {
    if (!progress.write_state) return tell(progress);
    progress.write_state = [&write, rest = std::move(progress.write_state)](std::ostream& out) {
      ByteWriter writer(out);
      write(writer);
      rest(out);
    };
    return tell(progress);
  };
  return options;
}

}  // namespace

SolverOptions offering(SolverOptions options, std::function<void(ByteWriter&)> write) {
  if (!options.progress) return options;
  options.progress = [write = std::move(write),
                      tell = std::move(options.progress)](Progress progress) {
    progress.write_state = [&write](std::ostream& out) {
      ByteWriter writer(out);
      write(writer);
    };
    return tell(progress);
  };
  return options;
}

SolverOptions offering_nothing(SolverOptions options) {
  if (!options.progress) return options;
  options.progress = [tell = std::move(options.progress)](Progress progress) {
    progress.write_state = {};
    return tell(progress);
  };
  return options;
}

SolverOptions offering_levels(SolverOptions options, std::vector<LevelReport> levels) {
  return preceded_by(std::move(options),
                     [levels = std::move(levels)](ByteWriter& write) { write(levels); });
}

template <int Dim>
SolverOptions offering_record(SolverOptions options, const Cage<Dim>& cage,
                              const DomainMesh<Dim>& mesh, const DistanceMatrix& distances,
                              const DistanceReport& source, double setup_seconds,
                              double solve_seconds) {
  const auto start = std::chrono::steady_clock::now();
  const auto origin = origin_of(options, cage, mesh);
  return preceded_by(std::move(options), [=, &distances](ByteWriter& write) {
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    const double so_far = solve_seconds + seconds.count();
    write(origin, distances, source.source, source.vertices, source.phi_error, setup_seconds,
          so_far);
  });
}

template <int Dim>
RunRecord take_record(SolverOptions& options, const Cage<Dim>& cage, const DomainMesh<Dim>& mesh) {
  ByteReader read(options.resume_from);
  std::uint64_t origin = 0;
  read(origin);
  if (origin != origin_of(options, cage, mesh)) {
    throw InputError(
        "the state to go on from is of another cage, mesh or version, or of other options");
  }
  RunRecord record;
  read(record.distances, record.source.source, record.source.vertices, record.source.phi_error,
       record.setup_seconds, record.solve_seconds, record.levels);
  const auto& distances = record.distances;
  const bool fits = options.phi == DistanceScheme::kConstant
                        ? distances.size() == 0
                        : distances.rows() == cage.size() &&
                              distances.cols() == mesh.num_vertices() && distances.allFinite() &&
                              distances.minCoeff() >= 0 && distances.maxCoeff() > 0;
  const auto source = record.source.source;
  require_undamaged(fits && (source == Distances::kExact || source == Distances::kInterpolated));
  options.resume_from = read.rest();
  return record;
}

void require_undamaged(bool can_be) {
  if (!can_be) throw InputError("the state to go on from is damaged");
}

void require_whole_state(const ByteReader& read, const SolveReport& report,
                         const SolverOptions& options) {
  if (!read.is_at_end()) throw InputError("the state to go on from is longer than it should be");
  if (report.iterations < 0 || report.iterations > options.max_iterations) {
    throw InputError("the state to go on from is damaged: it has " +
                     std::to_string(report.iterations) + " iterations");
  }
}

void refuse_state(const SolverOptions& options) {
  if (options.resume_from.empty()) return;
  throw OptionError("resume_from is read by solve() of a cage and a mesh alone");
}

#define FLBC_INSTANTIATE(Dim)                                                                     \
  template SolverOptions offering_record(SolverOptions, const Cage<Dim>&, const DomainMesh<Dim>&, \
                                         const DistanceMatrix&, const DistanceReport&, double,    \
                                         double);                                                 \
  template RunRecord take_record(SolverOptions&, const Cage<Dim>&, const DomainMesh<Dim>&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
