// SPDX-License-Identifier: BSD-3-Clause
// flbc_mutations COUNT [CALL [SEED]]: calls public functions with damaged arguments until each kind
// of argument was damaged COUNT times. With SEED, makes one call. Exit status 1 for a finding.
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include <unistd.h>

#include "fuzz/mutations.h"

namespace {

using flbc::fuzz::Call;
using flbc::fuzz::Counts;

constexpr unsigned kSecondsPerCall = 10;

const Call* current = nullptr;
std::uint32_t current_seed = 0;

void print_current() {
  if (current == nullptr) return;
  std::fprintf(stderr, "finding: flbc_mutations 1 %s %u\n", current->name.c_str(), current_seed);
}

extern "C" void on_signal(int signal) {
  print_current();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

bool is_finding(const Call& call, std::uint32_t seed, Counts& counts) {
  current = &call;
  current_seed = seed;
  alarm(kSecondsPerCall);
  try {
    flbc::fuzz::accepts(call, seed, counts);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    print_current();
    return true;
  }
  return false;
}

}  // namespace

// Called by the sanitizer before it ends the process.
extern "C" void __asan_on_error() {
  print_current();
}

int main(int count, char** words) {
  if (count < 2) {
    std::fputs("usage: flbc_mutations COUNT [CALL [SEED]]\n", stderr);
    return 1;
  }
  for (const int signal : {SIGABRT, SIGALRM, SIGFPE, SIGILL}) std::signal(signal, on_signal);
  const long least = std::atol(words[1]);
  auto calls = flbc::fuzz::all_calls();
  if (count > 2) {
    const std::string name = words[2];
    calls.erase(std::remove_if(calls.begin(), calls.end(),
                               [&](const Call& call) { return call.name != name; }),
                calls.end());
  }
  Counts counts{};
  if (count > 3) {
    return is_finding(calls.at(0), static_cast<std::uint32_t>(std::atol(words[3])), counts) ? 1 : 0;
  }
  int findings = 0;
  std::uint32_t seed = 0;
  // A single call does not have arguments of every kind.
  const auto goes_on = [&] {
    const auto least_damaged = *std::min_element(counts.begin(), counts.end());
    return calls.size() > 1 ? least_damaged < least : seed < static_cast<std::uint32_t>(least);
  };
  // Calls that have only arguments of kinds that were damaged often enough are left out.
  constexpr std::uint32_t kLearn = 100;
  std::vector<Counts> of_call(calls.size(), Counts{});
  const auto is_useful = [&](const Counts& of) {
    if (seed < kLearn || calls.size() == 1) return true;
    for (std::size_t kind = 0; kind < of.size(); ++kind) {
      if (of[kind] > 0 && counts[kind] < least) return true;
    }
    return false;
  };
  std::int64_t made = 0;
  for (; findings < 10 && !calls.empty() && goes_on(); ++seed) {
    for (std::size_t k = 0; k < calls.size(); ++k) {
      if (!is_useful(of_call[k])) continue;
      const Counts before = counts;
      findings += is_finding(calls[k], seed, counts) ? 1 : 0;
      for (std::size_t kind = 0; kind < counts.size(); ++kind) {
        of_call[k][kind] += counts[kind] - before[kind];
      }
      ++made;
    }
  }
  for (std::size_t k = 0; k < counts.size(); ++k) {
    std::printf("%-8s %8lld\n", flbc::fuzz::kArgumentNames[k], static_cast<long long>(counts[k]));
  }
  std::printf("calls    %8lld\n", static_cast<long long>(made));
  return findings > 0 ? 1 : 0;
}
