// SPDX-License-Identifier: BSD-3-Clause
#include "solve/weights_cache.h"

#include <unistd.h>

#include <cerrno>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "flbc/io/files.h"
#include "solve/byte_archive.h"

namespace flbc::app {

namespace {

namespace fs = std::filesystem;

// The number is the format's.
constexpr std::string_view kMagic = "flbc weights, format 6\n";

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
         distances, seconds, quality, coarse_levels, parts] = report;
  archive(method, status, criterion, control_points, vertices, cells, iterations, primal_residual,
          dual_residual, penalty, published_penalty, objective, state_scalars_per_cell);
  visit_levels(archive, coarse_levels);
  auto& [source, coarse_vertices, phi_error] = distances;
  archive(source, coarse_vertices, phi_error);
  auto& [certified, lower_bound, relative_gap] = certificate;
  archive(certified, lower_bound, relative_gap);
  auto& [setup, solve, recover, certify] = seconds;
  archive(setup, solve, recover, certify);
  auto& [min_weight, partition_error, reproduction_error, influences] = quality;
  archive(min_weight, partition_error, reproduction_error, influences);
  visit_parts(archive, parts);
}

template <class Archive, class Solved>
void visit_solved(Archive& archive, Solved& solved) {
  archive(solved.domain.points, solved.domain.cells, solved.solution.weights, solved.mesh_seconds,
          solved.mesher);
  visit_report(archive, solved.solution.report);
}

std::uint64_t number_at(std::string_view bytes) {
  std::uint64_t number = 0;
  std::memcpy(&number, bytes.data(), sizeof number);
  return number;
}

// The parts of a file between its first line and its hash.
struct Entry {
  std::string_view key;
  std::string_view payload;
};

// \throws InputError saying what is wrong with the file
Entry take_apart(std::string_view content) {
  constexpr auto kNumber = sizeof(std::uint64_t);
  if (content.substr(0, kMagic.size()) != kMagic || content.size() < kMagic.size() + 2 * kNumber) {
    throw InputError("it is no file of weights of this format");
  }
  const auto checked = content.substr(0, content.size() - kNumber);
  if (hash_of(checked) != number_at(content.substr(checked.size()))) {
    throw InputError("it is damaged: its checksum is wrong");
  }
  const auto rest = checked.substr(kMagic.size() + kNumber);
  const auto key_size = number_at(checked.substr(kMagic.size()));
  if (key_size > rest.size()) throw InputError("it ends early");
  return {rest.substr(0, key_size), rest.substr(key_size)};
}

template <int Dim>
SolvedDomain<Dim> read_entry(const std::string& path, const std::string& key) {
  const auto content = io::read_file(path);
  const auto entry = take_apart(content);
  if (entry.key != key) {
    throw InputError("it was made of another cage or mesh, with other options or another version");
  }
  ByteReader reader(entry.payload);
  SolvedDomain<Dim> solved;
  visit_solved(reader, solved);
  if (!reader.is_at_end() || solved.solution.weights.cols() != solved.domain.num_vertices()) {
    throw InputError("a size in it is impossible");
  }
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
  io::write_file(path, [&](std::ostream& file) {
    ByteWriter writer(file);
    writer.bytes(kMagic.data(), kMagic.size());
    writer(static_cast<std::uint64_t>(key.size()));
    writer.bytes(key.data(), key.size());
    visit_solved(writer, solved);
    writer(writer.hash());
  });
}

#define FLBC_INSTANTIATE(Dim)                                             \
  template CacheAnswer<Dim> WeightsCache::find(const std::string&) const; \
  template void WeightsCache::store(const std::string&, const SolvedDomain<Dim>&) const;
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::app
