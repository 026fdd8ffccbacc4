// SPDX-License-Identifier: BSD-3-Clause
#include "solve/weights_cache.h"

#include <unistd.h>

#include <cerrno>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>
#include <vector>

#include "flbc/byte_archive.h"
#include "flbc/io/files.h"
#include "solve/sealed_file.h"

namespace flbc::app {

namespace {

namespace fs = std::filesystem;

// The number is the format's.
constexpr std::string_view kFirstLine = "flbc weights, format 7\n";

// Content of a file, for reading and writing alike. All members are named: one that is added to a
// report does not compile until it is added here.

template <class Archive, class Level>
void visit_level(Archive& archive, Level& level) {
  auto& [vertices, cells, iterations, mesh_seconds, setup_seconds, solve_seconds] = level;
  archive(vertices, cells, iterations, mesh_seconds, setup_seconds, solve_seconds);
}

void visit_levels(ByteWriter& archive, const std::vector<LevelReport>& levels) {
  archive(static_cast<std::int64_t>(levels.size()));
  for (const auto& level : levels) visit_level(archive, level);
}

void visit_levels(ByteReader& archive, std::vector<LevelReport>& levels) {
  levels.resize(static_cast<std::size_t>(archive.count(1)));
  for (auto& level : levels) visit_level(archive, level);
}

template <class Archive, class Report>
void visit_report(Archive& archive, Report& report);

void visit_parts(ByteWriter& archive, const std::vector<SolveReport>& parts) {
  archive(static_cast<std::int64_t>(parts.size()));
  for (const auto& part : parts) visit_report(archive, part);
}

void visit_parts(ByteReader& archive, std::vector<SolveReport>& parts) {
  parts.resize(static_cast<std::size_t>(archive.count(1)));
  for (auto& part : parts) visit_report(archive, part);
}

template <class Archive, class Report>
void visit_report(Archive& archive, Report& report) {
  auto& [method, status, criterion, control_points, vertices, cells, iterations, primal_residual,
         dual_residual, penalty, published_penalty, objective, certificate, state_scalars_per_cell,
         distances, active_pairs, seconds, quality, coarse_levels, parts] = report;
  archive(method, status, criterion, control_points, vertices, cells, iterations, primal_residual,
          dual_residual, penalty, published_penalty, objective, state_scalars_per_cell);
  visit_levels(archive, coarse_levels);
  auto& [source, coarse_vertices, phi_error] = distances;
  archive(source, coarse_vertices, phi_error);
  auto& [density, growths] = active_pairs;
  archive(density, growths);
  auto& [certified, lower_bound, relative_gap] = certificate;
  archive(certified, lower_bound, relative_gap);
  auto& [setup, solve, recover, certify] = seconds;
  archive(setup, solve, recover, certify);
  auto& [min_weight, partition_error, reproduction_error, influences] = quality;
  archive(min_weight, partition_error, reproduction_error, influences);
  visit_parts(archive, parts);
}

void visit_weights(ByteWriter& archive, const SparseWeights& weights) {
  archive(weights.num_control_points(), weights.starts(), weights.control_points(),
          weights.values());
}

void visit_weights(ByteReader& archive, SparseWeights& weights) {
  Index num_control_points = 0;
  std::vector<std::int64_t> starts;
  std::vector<std::uint32_t> control_points;
  std::vector<double> values;
  archive(num_control_points, starts, control_points, values);
  weights = {num_control_points, std::move(starts), std::move(control_points), std::move(values)};
}

template <class Archive, class Solved>
void visit_solved(Archive& archive, Solved& solved) {
  archive(solved.domain.points, solved.domain.cells, solved.mesh_seconds, solved.mesher);
  visit_weights(archive, solved.solution.weights);
  visit_report(archive, solved.solution.report);
}

// The rest was true of the mesh when it was solved.
template <int Dim>
void require_in_range(const DomainMesh<Dim>& mesh) {
  const bool holds = mesh.points.allFinite() && (mesh.cells.array() >= 0).all() &&
                     (mesh.cells.array() < mesh.num_vertices()).all();
  if (!holds) throw InputError("its mesh is damaged");
}

template <int Dim>
SolvedDomain<Dim> read_entry(const std::string& path, const std::string& key) {
  const auto content = io::read_file(path);
  const auto entry = open_sealed(content, kFirstLine, "weights");
  if (entry.key != key) {
    throw InputError("it was made of another cage or mesh, with other options or another version");
  }
  ByteReader reader(entry.payload);
  SolvedDomain<Dim> solved;
  visit_solved(reader, solved);
  if (!reader.is_at_end() || solved.solution.weights.num_points() != solved.domain.num_vertices()) {
    throw InputError("a size in it is impossible");
  }
  require_in_range(solved.domain);
  return solved;
}

}  // namespace

WeightsCache::WeightsCache(std::string folder) : folder_(std::move(folder)) {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) {
    throw IoError("--cache " + folder_ + ": cannot make this folder: " + error.message());
  }
  if (access(folder_.c_str(), R_OK | W_OK | X_OK) != 0) {
    throw IoError("--cache " + folder_ + ": cannot write in this folder: " + std::strerror(errno));
  }
}

std::string WeightsCache::path_of(const std::string& key) const {
  char name[32];
  std::snprintf(name, sizeof name, "%016" PRIx64 ".weights", hash_of(key));
  return (fs::path(folder_) / name).string();
}

template <int Dim>
CacheAnswer<Dim> WeightsCache::find(const std::string& key) const {
  const auto path = path_of(key);
  std::error_code error;
  if (!fs::exists(path, error) && !error) return {};
  try {
    return {read_entry<Dim>(path, key), ""};
  } catch (const std::exception& why) {
    return {std::nullopt, path + ": not used, because " + why.what()};
  }
}

template <int Dim>
void WeightsCache::store(const std::string& key, const SolvedDomain<Dim>& solved) const {
  const auto path = path_of(key);
  // A file that must not be written could not be replaced.
  std::error_code ignored;
  fs::remove(path, ignored);
  write_sealed(path, kFirstLine, key, [&](std::ostream& out) {
    ByteWriter writer(out);
    visit_solved(writer, solved);
  });
}

#define FLBC_INSTANTIATE(Dim)                                             \
  template CacheAnswer<Dim> WeightsCache::find(const std::string&) const; \
  template void WeightsCache::store(const std::string&, const SolvedDomain<Dim>&) const;
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::app
