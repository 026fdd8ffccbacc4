// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/make_domain.h"

#include "base/instantiate.h"
#include "base/messages.h"
#include "flbc/errors.h"

namespace flbc {
namespace {

// As few vertices as the cage takes where fewer were asked for.
template <int Dim>
DomainMesh<Dim> fill_or_exceed(const PartMesher<Dim>& mesher, const Cage<Dim>& cage,
                               MeshingOptions<Dim> options) {
  try {
    return mesher(cage, options);
  } catch (const TooFewVertices&) {
    options.vertices = 0;
    return mesher(cage, options);
  }
}

// \param made  receives the mesher and what those before it said
template <int Dim>
DomainMesh<Dim> fill_by_first(const Cage<Dim>& cage, const MeshingOptions<Dim>& options,
                              const Meshers<Dim>& meshers, MadeDomain<Dim>& made) {
  std::string failures;
  for (const auto& [name, mesher] : meshers.in_order) {
    if (options.poll) options.poll();
    try {
      auto mesh = fill_or_exceed(mesher, cage, options);
      if (!failures.empty()) add_note(made.note, failures + "; the mesh was made by " + name);
      if (made.mesher.empty() || !failures.empty()) made.mesher = name;
      return mesh;
    } catch (const InputError& error) {
      if (failures != error.what()) add_note(failures, error.what());
    } catch (const OptionError&) {
      if (failures.empty()) throw;  // else this mesher cannot do what the one before could not
    }
  }
  throw InputError(failures);
}

std::string note_on_count(Index wanted, Index count) {
  constexpr double kTolerance = 1.1;  // promised by MeshingOptions
  if (wanted == 0 || count <= kTolerance * wanted) return "";
  return "the mesh has " + std::to_string(count) + " vertices instead of " +
         std::to_string(wanted) +
         " (vertices), the minimum that element quality allows in this cage";
}

}  // namespace

template <int Dim>
MadeDomain<Dim> make_domain(const Cage<Dim>& cage, const MeshingOptions<Dim>& options,
                            const Meshers<Dim>& meshers) {
  if (meshers.in_order.empty()) {
    throw OptionError(std::string("there is no mesher for ") + (Dim == 2 ? "2D" : "3D") +
                      " cages: link the component " +
                      (Dim == 2 ? "flbc::cgal" : "flbc::tetgen or flbc::netgen") +
                      ", or give a domain mesh");
  }
  if (meshers.check) meshers.check(cage);
  MadeDomain<Dim> made;
  made.mesh = mesh_in_parts<Dim>(cage, options,
                                 [&](const Cage<Dim>& part, const MeshingOptions<Dim>& of_part) {
                                   return fill_by_first(part, of_part, meshers, made);
                                 });
  add_note(made.note, note_on_count(options.vertices, made.mesh.num_vertices()));
  return made;
}

FLBC_INSTANTIATE_FUNCTION(make_domain)

}  // namespace flbc
