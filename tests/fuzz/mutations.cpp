// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/mutations.h"

#include "flbc/errors.h"

namespace flbc::fuzz {

std::vector<Call> all_calls() {
  auto all = core_calls();
  for (auto& call : openmesh_calls()) all.push_back(std::move(call));
  return all;
}

bool accepts(const Call& call, std::uint32_t seed, Counts& counts) {
  Mutator mutator(seed);
  bool accepted = true;
  try {
    call.make(mutator);
  } catch (const Error&) {
    accepted = false;
  }
  for (std::size_t k = 0; k < counts.size(); ++k) counts[k] += mutator.counts()[k];
  return accepted;
}

}  // namespace flbc::fuzz
