// SPDX-License-Identifier: BSD-3-Clause
#include "report/check_report.h"

#include "flbc/cage_facts.h"
#include "flbc/check.h"
#include "flbc/meshing.h"

namespace flbc::app {

template <int Dim>
CheckReport<Dim> check_cage(const Cage<Dim>& cage, const std::string& file) {
  CheckReport<Dim> report{file, "", "", "", cage, find_defects(cage)};
#ifdef FLBC_WITH_CGAL
  if (report.defects.empty()) {
    report.defects = find_self_intersections(cage, kMostDefects);
    report.intersections_checked = true;
  }
#endif
  if (report.defects.empty()) {
    report.facts = measure_cage(cage);
    report.thinnest = thinnest_place(cage);
  }
  return report;
}

template <int Dim>
void check_weights_of(CheckReport<Dim>& report, const DomainMesh<Dim>& domain,
                      const SparseWeights& weights) {
  report.weights = check_weights(report.cage, domain, weights);
  report.violations = find_violations(*report.weights);
}

template <int Dim>
void check_weights_of(CheckReport<Dim>& report, const PointList<Dim>& points,
                      const SparseWeights& weights) {
  report.weights = check_weights(report.cage, points, weights);
  report.violations = find_violations(*report.weights);
}

#define FLBC_INSTANTIATE(Dim)                                                                      \
  template CheckReport<Dim> check_cage(const Cage<Dim>&, const std::string&);                      \
  template void check_weights_of(CheckReport<Dim>&, const DomainMesh<Dim>&, const SparseWeights&); \
  template void check_weights_of(CheckReport<Dim>&, const PointList<Dim>&, const SparseWeights&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::app
