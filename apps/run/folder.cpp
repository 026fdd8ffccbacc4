// SPDX-License-Identifier: BSD-3-Clause
#include "run/folder.h"

#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <nlohmann/json.hpp>

#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "front/load.h"
#include "front/system/held_signals.h"
#include "front/system/system.h"
#include "help/options.h"
#include "report/report_json.h"
#include "run/inputs.h"

namespace flbc::app {
namespace {

namespace fs = std::filesystem;

// Empty if there is no report, or none of this command.
std::vector<std::string> names_in_report(const std::string& path, const std::string& command) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return {};
  try {
    const auto report = nlohmann::json::parse(io::read_file(path));
    if (report.at("command") != command) return {};
    return report.at("files").get<std::vector<std::string>>();
  } catch (const std::exception&) {
    return {};
  }
}

// A file in the folder itself, neither below nor outside.
bool is_plain_name(const std::string& name) {
  const fs::path path(name);
  return path.filename() == path && name != "." && name != "..";
}

constexpr int kNameColumn = 20;

}  // namespace

RunFolder::RunFolder(std::string path, const RunFiles& files)
    : path_(std::move(path)), report_(files.report), quiet_(files.quiet), names_(files.names) {
  const auto old = names_in_report(path_of(report_), files.command);
  check_results(files, old);
  make_folder(path_);
  const auto reason = why_not_writable(path_);
  if (!reason.empty()) throw IoError(path_ + ": cannot write in this folder: " + reason);
  remove_old(files, old);
  write_report({{"command", files.command}, {"unfinished", true}, {"files", files.names}});
}

void RunFolder::check_results(const RunFiles& files, const std::vector<std::string>& old) const {
  std::error_code error;
  for (const auto& name : files.names) {
    const auto result = path_of(name);
    require_distinct(files.inputs, {result});
    const bool is_own = std::find(old.begin(), old.end(), name) != old.end();
    if (files.force || is_own || !fs::exists(result, error)) continue;
    throw OptionError(result + ": exists and is not from an earlier flbc " + files.command +
                      "; use another folder, or --force to replace it");
  }
}

void RunFolder::remove_old(const RunFiles& files, const std::vector<std::string>& old) const {
  std::error_code error;
  for (const auto& name : old) {
    const auto file = path_of(name);
    if (!is_plain_name(name) || !fs::is_regular_file(fs::symlink_status(file, error))) continue;
    const bool is_input =
        std::any_of(files.inputs.begin(), files.inputs.end(),
                    [&](const auto& input) { return fs::equivalent(file, input, error); });
    if (!is_input) fs::remove(file, error);
  }
}

std::string RunFolder::path_of(const std::string& name) const {
  return (fs::path(path_) / name).string();
}

void RunFolder::add(const std::string& name, const std::string& facts,
                    const std::function<void(const std::string& path)>& write) {
  const std::lock_guard lock(mutex_);
  {
    const HeldSignals held;
    write(path_of(name));
  }
  made_.insert(name);
  if (!facts.empty()) print_line(name, facts);
}

void RunFolder::add_text(const std::string& name, const std::string& facts,
                         const std::string& text) {
  add(name, facts, [&](const std::string& path) {
    io::write_file(path, [&](std::ostream& file) { file << text; });
  });
}

void RunFolder::print(const std::string& name, const std::string& facts) const {
  const std::lock_guard lock(mutex_);
  print_line(name, facts);
}

void RunFolder::print_line(const std::string& name, const std::string& facts) const {
  if (quiet_) return;
  const auto indent = "\n" + std::string(2 + kNameColumn, ' ');
  // On a terminal a progress line may be there.
  std::cerr << (is_terminal() ? "\r\033[K  " : "  ") << std::left << std::setw(kNameColumn) << name
            << (is_terminal() ? wrapped(facts, 77 - kNameColumn, indent) : facts) << '\n';
}

void RunFolder::add_report(nlohmann::ordered_json& report, const std::string& facts) {
  auto& files = report["files"] = nlohmann::ordered_json::array();
  for (const auto& name : names_) {
    if (made_.count(name) != 0) files.push_back(name);
  }
  files.push_back(report_);
  write_report(report);
  if (!facts.empty()) print(report_, facts);
}

void RunFolder::write_report(const nlohmann::ordered_json& report) const {
  write_text(path_of(report_), to_text(report));
}

}  // namespace flbc::app
