// SPDX-License-Identifier: BSD-3-Clause
#include "toolkit.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <memory>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "flbc/io/files.h"
#include "flbc/version.h"

namespace flbc::bench {
namespace {

// From a child process: a line per row, a tab after each column's name and each cell.
std::string text_of(const Rows& rows) {
  std::string text;
  for (const auto& row : rows) {
    for (const auto& [column, cell] : row.cells()) text += column + '\t' + cell + '\t';
    text += '\n';
  }
  return text;
}

Rows rows_of(std::FILE* file) {
  Rows rows;
  std::string word;
  std::optional<std::string> column;
  Row row;
  for (int c = std::getc(file); c != EOF; c = std::getc(file)) {
    if (c == '\n') {
      rows.push_back(std::exchange(row, {}));
    } else if (c != '\t') {
      word += static_cast<char>(c);
    } else if (!column) {
      column = std::exchange(word, {});
    } else {
      row.add(*std::exchange(column, {}), std::exchange(word, {}));
    }
  }
  return rows;
}

[[noreturn]] void run_child(const std::string& what, const std::function<Rows()>& body,
                            std::FILE* result) {
  bool ok = false;
  try {
    ok = std::fputs(text_of(body()).c_str(), result) >= 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", what.c_str(), error.what());
  }
  ok = std::fflush(nullptr) == 0 && ok;
  std::_Exit(ok ? EXIT_SUCCESS : EXIT_FAILURE);
}

// The text behind `name` and a colon in a file of /proc; empty if there is none.
std::string proc_entry(const char* path, const std::string& name) {
  std::ifstream file(path);
  std::string line;
  while (std::getline(file, line)) {
    const auto begin = line.find_first_not_of(" \t", line.find(':') + 1);
    if (line.compare(0, name.size(), name) == 0 && begin != std::string::npos)
      return line.substr(begin);
  }
  return "";
}

double status_mebibytes(const char* name) {
  return std::strtod(proc_entry("/proc/self/status", name).c_str(), nullptr) / 1024;
}

constexpr const char* kIncomplete = "# incomplete: some cases are missing";

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream text(line);
  for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
  return cells;
}

// Processor, number of its cores, threads used, compiler, library version; one line, no date.
std::string describe_machine(int threads) {
  const auto processor = proc_entry("/proc/cpuinfo", "model name");
  std::ostringstream text;
  text << (processor.empty() ? "unknown processor" : processor) << ", " << available_cores()
       << " cores; " << threads << " threads; compiler " << __VERSION__ << "; libflbc "
       << FLBC_VERSION;
  return text.str();
}

}  // namespace

std::string Row::text_of(double number) {
  if (!std::isfinite(number)) return "";
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", number);
  return text;
}

std::optional<Rows> in_child(const std::string& what, const std::function<Rows()>& body) {
  const auto check = [](bool ok, const std::string& call) {
    if (!ok) throw std::runtime_error(call + ": " + std::strerror(errno));
  };
  std::printf("%s\n", what.c_str());
  std::fflush(nullptr);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> result(std::tmpfile(), std::fclose);
  check(result != nullptr, "tmpfile");
  const pid_t child = fork();
  check(child >= 0, "fork");
  if (child == 0) run_child(what, body, result.get());
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status)) {
    std::fprintf(stderr, "%s: %s\n", what.c_str(), strsignal(WTERMSIG(status)));
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != EXIT_SUCCESS) return std::nullopt;
  std::rewind(result.get());
  return rows_of(result.get());
}

ResultTable::ResultTable(const Context& context, std::string name, const std::string& about)
    : context_(context),
      name_(std::move(name)),
      comments_{about, describe_machine(context.threads), context.origin} {
  if (context.busy) comments_.emplace_back("busy machine: seconds are too long");
  if (context.quick) comments_.emplace_back("quick run: small meshes, few iterations");
  if (!context.only_models.empty()) comments_.emplace_back("only models that were asked for");
  if (context.origin.find("-dirty") != std::string::npos) return;
  std::ifstream file(context.out + "/" + name_ + ".csv");
  std::vector<std::string> comments;
  std::vector<std::string> columns;
  for (std::string line; std::getline(file, line);) {
    if (line.compare(0, 2, "# ") == 0) {
      if (line != kIncomplete) comments.push_back(line.substr(2));
    } else if (columns.empty()) {
      columns = cells_of(line);
    } else {
      const auto cells = cells_of(line);
      Row row;
      for (std::size_t k = 0; k < columns.size(); ++k) {
        row.add(columns[k], k < cells.size() ? cells[k] : "");
      }
      rows_.push_back(std::move(row));
    }
  }
  if (comments != comments_) rows_.clear();
}

bool ResultTable::has(const std::string& which) const {
  return std::any_of(rows_.begin(), rows_.end(),
                     [&](const auto& row) { return row.cells().front().second == which; });
}

void ResultTable::add(const std::string& which, const std::function<Rows()>& body) {
  if (has(which)) return;
  const auto rows = in_child(name_ + ": " + which, body);
  failed_ = failed_ || !rows;
  for (const auto& measured : rows.value_or(Rows{})) {
    auto row = Row().add("case", which);
    for (const auto& [column, cell] : measured.cells()) row.add(column, cell);
    for (const auto& [column, cell] : row.cells()) std::printf("%s,", cell.c_str());
    std::printf("\n");
    rows_.push_back(std::move(row));
  }
  std::fflush(stdout);
  write();
}

bool ResultTable::finish() {
  finished_ = !failed_;
  write();
  return finished_;
}

void ResultTable::write() const {
  std::vector<std::string> columns;
  for (const auto& row : rows_) {
    for (const auto& [column, cell] : row.cells()) {
      if (std::find(columns.begin(), columns.end(), column) == columns.end())
        columns.push_back(column);
    }
  }
  io::write_file(context_.out + "/" + name_ + ".csv", [&](std::ostream& file) {
    const auto put = [&](const auto& words, const auto& text_of) {
      const char* before = "";
      for (const auto& word : words) {
        file << before << text_of(word);
        before = ",";
      }
      file << '\n';
    };
    for (const auto& comment : comments_) file << "# " << comment << '\n';
    if (!finished_) file << kIncomplete << '\n';
    put(columns, [](const auto& column) { return column; });
    for (const auto& row : rows_) {
      put(columns, [&](const auto& column) {
        const auto& cells = row.cells();
        const auto cell = std::find_if(cells.begin(), cells.end(),
                                       [&](const auto& c) { return c.first == column; });
        return cell == cells.end() ? "" : cell->second;
      });
    }
  });
}

int available_cores() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

double peak_mebibytes() {
  return status_mebibytes("VmHWM");
}

}  // namespace flbc::bench
