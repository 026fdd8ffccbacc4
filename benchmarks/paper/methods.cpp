// SPDX-License-Identifier: BSD-3-Clause
#include "paper/methods.h"

namespace flbc::bench {

const std::vector<NamedMethod>& methods() {
  static const std::vector<NamedMethod> kMethods = {
      {"lbc2014", Method::kLbc2014, 10}, {"lbc2014-tuned", Method::kLbc2014, 0},
      {"paper", Method::kPaper, 0},      {"gradient", Method::kGradient, 0},
      {"value", Method::kValue, 0},
  };
  return kMethods;
}

}  // namespace flbc::bench
