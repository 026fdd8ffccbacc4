// SPDX-License-Identifier: BSD-3-Clause
#include "front/make_domain.h"

#include <algorithm>

#include "flbc/errors.h"
#include "flbc/make_domain.h"
#include "front/load.h"
#include "front/wording.h"

namespace flbc::app {
namespace {

template <int Dim>
Meshers<Dim> meshers_for(const std::string& asked_for) {
  const bool is_any = asked_for == "auto";
  if (!is_any && (asked_for == "cgal") != (Dim == 2)) {
    throw OptionError("--mesher " + asked_for + ": this mesher does not support " +
                      std::to_string(Dim) + "D");
  }
  auto meshers = linked_meshers<Dim>();
  auto& all = meshers.in_order;
  all.erase(std::remove_if(all.begin(), all.end(),
                           [&](const auto& one) { return !is_any && one.name != asked_for; }),
            all.end());
  if (!all.empty()) return meshers;
  const std::string wanted = !is_any ? asked_for : Dim == 2 ? "CGAL" : "TetGen or Netgen";
  if (!linked_meshers<Dim>().in_order.empty()) {
    throw OptionError("--mesher " + asked_for +
                      ": this flbc was built without it; leave out this option");
  }
  throw OptionError("this flbc was built without " + wanted + " and cannot mesh " +
                    std::to_string(Dim) + "D cages; give a mesh with --domain");
}

}  // namespace

template <int Dim>
MadeDomain<Dim> make_domain(const DomainRequest<Dim>& request) {
  const auto& asked_for = request.meshing.mesher;
  const auto meshers = meshers_for<Dim>(asked_for);
  MeshingOptions<Dim> options;
  if (!request.embedded_file.empty()) options.embedded_points = request.embedded;
  options.vertices = request.vertices > 0 ? request.vertices : kDefaultVertices;
  options.time_limit = request.meshing.timeout;
  const auto name = request.embedded_file.empty()
                        ? request.cage_file
                        : request.cage_file + " with " + request.embedded_file;
  auto made = naming(name, [&] {
    try {
      return flbc::make_domain(request.cage, options, meshers);
    } catch (const InputError& error) {
      if (asked_for != "tetgen" || linked_meshers<Dim>().in_order.size() < 2) throw;
      throw InputError(error.what() + std::string("; or try --mesher netgen"));
    }
  });
  made.note = in_words_of_program(made.note);
  return made;
}

template MadeDomain<2> make_domain(const DomainRequest<2>&);
template MadeDomain<3> make_domain(const DomainRequest<3>&);

}  // namespace flbc::app
