// SPDX-License-Identifier: BSD-3-Clause
#include "solve/make_cage.h"

#include <iostream>
#include <iterator>

#include "flbc/cage_facts.h"
#include "flbc/errors.h"
#include "front/facts.h"
#include "front/load.h"
#include "help/options.h"
#include "solve/progress_bar.h"

namespace flbc::app {

CLI::Option* add_symmetric_option(CLI::App& command, CageSymmetry& symmetry,
                                  const std::string& more) {
  return add_choice(
      command, "--symmetric", {std::begin(kSymmetryNames), std::end(kSymmetryNames)},
      [&symmetry](const std::string& word) { symmetry = symmetry_named(word); },
      "make the cage symmetric across this axis (default: auto, if the model is symmetric)" + more);
}

std::string note_many_vertices(const std::string& file, std::size_t vertices) {
  constexpr std::size_t kMost = 2000;
  return vertices <= kMost ? ""
                           : file + ": has " + std::to_string(vertices) +
                                 " vertices, more than cages usually have";
}

template <int Dim>
ModelCage<Dim> make_cage([[maybe_unused]] const std::string& file,
                         [[maybe_unused]] const ModelFacets<Dim>& model,
                         [[maybe_unused]] CagingOptions options, [[maybe_unused]] bool quiet) {
#ifdef FLBC_LINKS_CGAL
  ModelCage<Dim> made;
  {
    ProgressBar bar(quiet, "making a cage");
    options.stage = [&bar](CagingStage stage, double done) { bar.show(name_of(stage), done); };
    made = naming(file, [&] { return cage_from_model<Dim>(model.points, model.facets, options); });
  }
  if (!quiet && !model.unused.empty()) {
    std::cerr << file << ": the cage leaves out " << model.unused.size()
              << (model.unused.size() == 1 ? " vertex of no face\n" : " vertices of no face\n");
  }
  const Index parts = measure_cage(made.cage).parts;
  if (!quiet && model.facets.cols() == 0 && parts > 1) {
    std::cerr << file << ": the cage has " << parts
              << " separate parts, because there are wide gaps between points\n";
  }
  const auto bridged = describe_bridged_gaps(made);
  if (!quiet && !bridged.empty()) std::cerr << file << ": " << bridged << '\n';
  return made;
#else
  throw OptionError("this flbc was built without CGAL and cannot make cages");
#endif
}

template <int Dim>
RepairedCage<Dim> repair_defects([[maybe_unused]] const std::string& file,
                                 [[maybe_unused]] const Cage<Dim>& cage) {
#ifdef FLBC_LINKS_CGAL
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
  if (made.volume_ratio > 0)
    facts << ", volume " << made.volume_ratio << " times that of the model";
  if (Dim == 3) facts << ", at most " << made.max_valence << " edges at a control point";
  if (made.symmetry_axis >= 0) {
    facts << ", symmetric across "
          << "xyz"[made.symmetry_axis] << " = " << made.symmetry_place;
  }
  return facts.text();
}

template <int Dim>
std::string describe(const RepairedCage<Dim>& repaired, Index control_points) {
  Facts facts;
  facts << (Dim == 2 ? "area " : "volume ") << measure_cage(repaired.cage).measure;
  if (repaired.measure_before > 0) facts << " (before: " << repaired.measure_before << ")";
  facts << ", at most " << repaired.max_distance << " from the old "
        << (Dim == 2 ? "outline, " : "surface, ") << repaired.kept << " of " << control_points
        << " control points kept";
  return facts.text();
}

#define FLBC_INSTANTIATE(Dim)                                                                   \
  template ModelCage<Dim> make_cage(const std::string&, const ModelFacets<Dim>&, CagingOptions, \
                                    bool);                                                      \
  template RepairedCage<Dim> repair_defects(const std::string&, const Cage<Dim>&);              \
  template std::string describe(const ModelCage<Dim>&);                                         \
  template std::string describe(const RepairedCage<Dim>&, Index);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::app
