// SPDX-License-Identifier: BSD-3-Clause
// Whatever happens to a mesher in WebAssembly, the caller is intact. Prints what failed.
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "meshing/isolated_process.h"

namespace {

using flbc::ByteSink;
using flbc::ProcessEnd;

volatile int depth = 0;
int recurse(int n) {
  volatile char room[1000];
  room[n % 1000] = static_cast<char>(n);
  depth = depth + 1;
  return recurse(n + 1) + room[0];
}

int failures = 0;
void expect(bool holds, const char* what) {
  if (holds) return;
  ++failures;
  std::printf("failed: %s\n", what);
}

ProcessEnd end_of(const std::function<void(const ByteSink&)>& work) {
  return flbc::run_isolated(work, 60).end;
}

}  // namespace

int main() {
  std::vector<int> own(1000, 7);
  const std::string text = "sent";
  for (int round = 0; round < 2; ++round) {
    const auto sent = flbc::run_isolated(
        [&](const ByteSink& send) {
          own.assign(5000, 8);
          std::vector<char> large(100 << 20, 'x');  // more than the parent has
          send(text.data(), text.size());
          send(large.data(), 3);
        },
        60);
    expect(sent.end == ProcessEnd::kFinished, "finished");
    expect(std::string(sent.output.begin(), sent.output.end()) == "sentxxx", "output");
    expect(own == std::vector<int>(1000, 7), "memory of the parent");
    expect(end_of([](const ByteSink&) { throw std::runtime_error("x"); }) == ProcessEnd::kThrew,
           "throw");
    expect(end_of([](const ByteSink&) { throw 3; }) == ProcessEnd::kThrew, "throw of a number");
    expect(end_of([](const ByteSink&) { std::abort(); }) == ProcessEnd::kCrashed, "abort");
    expect(end_of([](const ByteSink&) { __builtin_trap(); }) == ProcessEnd::kCrashed, "trap");
    expect(end_of([](const ByteSink&) { recurse(0); }) == ProcessEnd::kCrashed, "recursion");
    bool ran_out = false;
    try {
      end_of([](const ByteSink&) {
        std::vector<std::vector<char>> all;
        for (;;) all.emplace_back(256 << 20, 'x');
      });
    } catch (const std::bad_alloc&) {
      ran_out = true;
    }
    expect(ran_out, "exhausted memory");
    expect(depth == 0, "static memory of the parent");
  }
  std::printf(failures == 0 ? "isolation holds\n" : "isolation fails\n");
}
