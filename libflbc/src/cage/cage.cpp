// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/cage.h"

#include "cage/cage_defects.h"
#include "flbc/errors.h"

namespace flbc {

template <int Dim>
std::vector<Defect> find_defects(const Cage<Dim>& cage, std::size_t limit) {
  DefectList found(limit);
  check_numbers(cage, found);
  if (!found.empty()) return found.take();  // the checks below rely on sound numbers
  check_points(cage, found);
  check_facets(cage, found);
  check_connections(cage, found);
  return found.take();
}

template <int Dim>
void validate(const Cage<Dim>& cage) {
  const std::vector<Defect> defects = find_defects(cage, 1);
  if (!defects.empty()) throw InputError(defects.front().message);
}

template struct Cage<2>;
template struct Cage<3>;
template std::vector<Defect> find_defects<2>(const Cage<2>&, std::size_t);
template std::vector<Defect> find_defects<3>(const Cage<3>&, std::size_t);
template void validate<2>(const Cage<2>&);
template void validate<3>(const Cage<3>&);

}  // namespace flbc
