// SPDX-License-Identifier: BSD-3-Clause
#include "paper/machine.h"

#include <malloc.h>

#include <fstream>
#include <sstream>
#include <thread>

#include "flbc/version.h"

namespace flbc::bench {
namespace {

// The text behind `name` and a colon in a file of /proc; empty if there is none.
std::string proc_entry(const char* path, const std::string& name) {
  std::ifstream file(path);
  std::string line;
  while (std::getline(file, line)) {
    const auto colon = line.find(':');
    if (colon == std::string::npos || line.compare(0, name.size(), name) != 0) continue;
    const auto begin = line.find_first_not_of(" \t", colon + 1);
    return begin == std::string::npos ? "" : line.substr(begin);
  }
  return "";
}

double status_mebibytes(const std::string& name) {
  std::istringstream text(proc_entry("/proc/self/status", name));
  double kibibytes = 0;
  text >> kibibytes;
  return kibibytes / 1024;
}

}  // namespace

int available_cores() {
  const unsigned cores = std::thread::hardware_concurrency();
  return cores > 0 ? static_cast<int>(cores) : 1;
}

std::string describe_machine(int threads) {
  auto processor = proc_entry("/proc/cpuinfo", "model name");
  if (processor.empty()) processor = "unknown processor";
  std::ostringstream text;
  text << processor << ", " << available_cores() << " cores; " << threads << " threads; compiler "
       << __VERSION__ << "; libflbc " << FLBC_VERSION;
  return text.str();
}

double resident_mebibytes() {
  malloc_trim(0);
  return status_mebibytes("VmRSS");
}

double peak_mebibytes() {
  return status_mebibytes("VmHWM");
}

void reset_peak() {
  std::ofstream("/proc/self/clear_refs") << 5;
}

}  // namespace flbc::bench
