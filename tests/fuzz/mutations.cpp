// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/mutations.h"

#include "flbc/errors.h"

namespace flbc::fuzz {

std::vector<Call> all_calls() {
  auto all = core_calls();
  for (auto& call : openmesh_calls()) all.push_back(std::move(call));
  return all;
}

bool accepts(const Call& call, std::uint32_t seed) {
  Mutator mutator(seed);
  try {
    call.make(mutator);
  } catch (const Error&) {
    return false;
  }
  return true;
}

}  // namespace flbc::fuzz
