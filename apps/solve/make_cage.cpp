// SPDX-License-Identifier: BSD-3-Clause
#include "solve/make_cage.h"

#include "files/load.h"
#include "flbc/errors.h"
#include "report/facts.h"

namespace flbc::app {

template <int Dim>
ModelCage<Dim> make_cage([[maybe_unused]] const std::string& file,
                         [[maybe_unused]] const ModelFacets<Dim>& model,
                         [[maybe_unused]] const CagingOptions& options) {
#ifdef FLBC_WITH_CGAL
  return naming(file, [&] { return cage_from_model<Dim>(model.points, model.facets, options); });
#else
  throw OptionError("this flbc was built without CGAL and cannot make cages");
#endif
}

template <int Dim>
RepairedCage<Dim> repair_defects([[maybe_unused]] const std::string& file,
                                 [[maybe_unused]] const Cage<Dim>& cage) {
#ifdef FLBC_WITH_CGAL
  return naming(file, [&] { return repair_cage<Dim>(cage); });
#else
  throw OptionError("this flbc was built without CGAL and cannot repair cages");
#endif
}

template <int Dim>
std::string describe(const ModelCage<Dim>& made) {
  const double size = bounding_box_diagonal<Dim>(made.cage.points);
  Facts facts;
  facts << made.cage.size() << " control points, " << made.cage.facets.cols()
        << (Dim == 2 ? " edges" : " triangles") << ", mean distance from the model "
        << 100 * made.mean_distance / size << "% of the cage size";
  if (made.symmetry_axis >= 0) {
    facts << ", symmetric across "
          << "xyz"[made.symmetry_axis] << " = " << made.symmetry_place;
  }
  return facts.text();
}

#define FLBC_INSTANTIATE(Dim)                                                      \
  template ModelCage<Dim> make_cage(const std::string&, const ModelFacets<Dim>&,   \
                                    const CagingOptions&);                         \
  template RepairedCage<Dim> repair_defects(const std::string&, const Cage<Dim>&); \
  template std::string describe(const ModelCage<Dim>&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::app
