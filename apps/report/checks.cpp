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

template CheckReport<2> check_cage(const Cage<2>&, const std::string&);
template CheckReport<3> check_cage(const Cage<3>&, const std::string&);

}  // namespace flbc::app
