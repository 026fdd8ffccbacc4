// SPDX-License-Identifier: BSD-3-Clause
#include "solve/checkpoint.h"

#include <filesystem>
#include <iostream>
#include <sstream>

#include "flbc/byte_archive.h"
#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "solve/sealed_file.h"

namespace flbc::app {
namespace {

// The number is the format's.
constexpr std::string_view kFirstLine = "flbc checkpoint, format 1\n";

// The first word of the first line in which two texts differ.
std::string first_difference(const std::string& a, const std::string& b) {
  std::istringstream lines_of_a(a), lines_of_b(b);
  for (;;) {
    std::string line_of_a, line_of_b;
    const bool more_of_a = bool(std::getline(lines_of_a, line_of_a));
    const bool more_of_b = bool(std::getline(lines_of_b, line_of_b));
    if (line_of_a == line_of_b && more_of_a && more_of_b) continue;
    const auto& line = more_of_a ? line_of_a : line_of_b;
    return line.substr(0, line.find(' '));
  }
}

// Of a file that is there.
template <int Dim>
KeptRun<Dim> read_run(const std::string& path, const std::string& lines) {
  const auto content = io::read_file(path);
  const auto sealed = open_sealed(content, kFirstLine, "a checkpoint");
  if (sealed.key != lines) {
    throw InputError(
        "it was left by another command: '" + first_difference(lines, std::string(sealed.key)) +
        "' differs; repeat that command, name another --checkpoint, or remove the file");
  }
  ByteReader read(sealed.payload);
  KeptRun<Dim> run;
  auto& solved = run.solved;
  read(solved.domain.points, solved.domain.cells, solved.mesh_seconds, solved.mesher, run.history,
       run.iteration);
  if (read.is_at_end()) throw InputError("it ends early");
  run.state = read.rest();
  normalize_and_validate(solved.domain);
  return run;
}

}  // namespace

template <int Dim>
std::optional<KeptRun<Dim>> Checkpoint<Dim>::find() const {
  std::error_code error;
  if (!std::filesystem::exists(settings_.file, error) && !error) return std::nullopt;
  try {
    return read_run<Dim>(settings_.file, lines_);
  } catch (const InputError& why) {
    throw InputError("--checkpoint " + settings_.file + ": " + why.what());
  }
}

template <int Dim>
bool Checkpoint<Dim>::look(const Progress& progress, const SolvedDomain<Dim>& solved,
                           const std::vector<HistoryEntry>& history) {
  if (!progress.write_state) return false;
  if (!signals_) signals_.emplace();
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - last_;
  const bool came = signals_->came_any();
  if (came || passed.count() >= settings_.interval) write(progress, solved, history);
  return came;
}

template <int Dim>
void Checkpoint<Dim>::write(const Progress& progress, const SolvedDomain<Dim>& solved,
                            const std::vector<HistoryEntry>& history) {
  try {
    write_sealed(settings_.file, kFirstLine, lines_, [&](std::ostream& out) {
      ByteWriter write(out);
      write(solved.domain.points, solved.domain.cells, solved.mesh_seconds, solved.mesher, history,
            progress.iteration);
      progress.write_state(out);
    });
    iteration_ = progress.iteration;
  } catch (const IoError& error) {
    std::cerr << "flbc: the state of the run is not kept: " << error.what() << '\n';
  }
  last_ = std::chrono::steady_clock::now();
}

template <int Dim>
void Checkpoint<Dim>::end() {
  if (iteration_ > 0) {
    std::cerr << "flbc: stopped; the same command goes on from " << settings_.file
              << ", at iteration " << iteration_ << '\n';
  }
  release_signals();
}

template <int Dim>
void Checkpoint<Dim>::remove() const {
  std::error_code ignored;
  std::filesystem::remove(settings_.file, ignored);
}

template class Checkpoint<2>;
template class Checkpoint<3>;

}  // namespace flbc::app
