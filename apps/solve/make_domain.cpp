// SPDX-License-Identifier: BSD-3-Clause
#include "solve/make_domain.h"

#include <utility>
#include <vector>

#include "files/load.h"
#include "flbc/errors.h"
#include "flbc/meshing.h"
#include "help/wording.h"

namespace flbc::app {
namespace {

bool is_built_in(Mesher mesher) {
#ifdef FLBC_WITH_CGAL
  if (mesher == Mesher::kCgal) return true;
#endif
#ifdef FLBC_WITH_TETGEN
  if (mesher == Mesher::kTetgen) return true;
#endif
#ifdef FLBC_WITH_NETGEN
  if (mesher == Mesher::kNetgen) return true;
#endif
  return false;
}

// In the order in which they are tried.
template <int Dim>
std::vector<Mesher> meshers_for(Mesher asked_for) {
  std::vector<Mesher> meshers;
  for (const Mesher mesher : Dim == 2 ? std::vector<Mesher>{Mesher::kCgal}
                                      : std::vector<Mesher>{Mesher::kTetgen, Mesher::kNetgen}) {
    const bool is_meant =
        asked_for == Mesher::kAuto || asked_for == Mesher::kGiven || asked_for == mesher;
    if (is_meant && is_built_in(mesher)) meshers.push_back(mesher);
  }
  return meshers;
}

template <int Dim>
void require_mesher(Mesher asked_for) {
  const bool is_one_for_3d = asked_for == Mesher::kTetgen || asked_for == Mesher::kNetgen;
  if (asked_for != Mesher::kAuto && is_one_for_3d != (Dim == 3)) {
    throw OptionError(std::string("--mesher ") + name_of(asked_for) +
                      ": this mesher does not support " + std::to_string(Dim) + "D");
  }
  if (!meshers_for<Dim>(asked_for).empty()) return;
  const std::string wanted = asked_for != Mesher::kAuto ? name_of(asked_for)
                             : Dim == 2                 ? "CGAL"
                                                        : "TetGen or Netgen";
  throw OptionError("this flbc was built without " + wanted + " and cannot mesh " +
                    std::to_string(Dim) + "D cages; give a mesh with --domain");
}

DomainMesh<2> fill(Mesher, [[maybe_unused]] const Cage<2>& cage,
                   [[maybe_unused]] const MeshingOptions<2>& options) {
#ifdef FLBC_WITH_CGAL
  return triangulate(cage, options);
#else
  return {};
#endif
}

DomainMesh<3> fill([[maybe_unused]] Mesher mesher, [[maybe_unused]] const Cage<3>& cage,
                   [[maybe_unused]] const MeshingOptions<3>& options) {
#ifdef FLBC_WITH_NETGEN
  if (mesher == Mesher::kNetgen) return tetrahedralize_by_netgen(cage, options);
#endif
#ifdef FLBC_WITH_TETGEN
  return tetrahedralize(cage, options);
#else
  return {};
#endif
}

// As few vertices as the cage takes where fewer were asked for.
template <int Dim>
DomainMesh<Dim> fill_or_exceed(Mesher mesher, const Cage<Dim>& cage, MeshingOptions<Dim> options) {
  try {
    return fill(mesher, cage, options);
  } catch (const TooFewVertices&) {
    options.vertices = 0;
    return fill(mesher, cage, options);
  }
}

std::string note_on_count(Index asked, Index count) {
  constexpr double kTolerance = 1.1;  // promised by MeshingOptions
  if (asked == 0 || count <= kTolerance * asked) return "";
  return "the mesh has " + std::to_string(count) + " vertices instead of " + std::to_string(asked) +
         " (--vertices), the minimum that element quality allows in this cage";
}

// Notes for the user from meshing the parts.
struct Making {
  Mesher mesher = Mesher::kAuto;  // the last one that had to be tried
  std::string failures{};         // of those before
};

void add_sentence(std::string& text, const std::string& sentence) {
  text += (text.empty() ? "" : "; ") + sentence;
}

// The first mesher that can; what those before it said is added to the failures.
template <int Dim>
DomainMesh<Dim> fill_by_any(const Cage<Dim>& cage, Mesher asked_for,
                            const MeshingOptions<Dim>& options, Making& making) {
  const auto meshers = meshers_for<Dim>(asked_for);
  std::string failures;
  for (const Mesher mesher : meshers) {
    const bool is_last = mesher == meshers.back();
    try {
      auto mesh = fill_or_exceed(mesher, cage, options);
      if (!failures.empty()) {
        add_sentence(making.failures, failures + "; the mesh was made by " + name_of(mesher));
      }
      if (making.mesher == Mesher::kAuto || !failures.empty()) making.mesher = mesher;
      return mesh;
    } catch (const InputError& error) {
      if (asked_for == Mesher::kTetgen && is_built_in(Mesher::kNetgen)) {
        throw InputError(error.what() + std::string("; or try --mesher netgen"));
      }
      if (is_last && (failures.empty() || failures == error.what())) throw;
      add_sentence(failures, error.what());
      if (is_last) throw InputError(failures);
    } catch (const OptionError&) {
      if (failures.empty()) throw;  // else this mesher cannot do what the one before could not
      throw InputError(failures);
    }
  }
  return {};
}

template <int Dim>
MadeDomain<Dim> fill_parts(const DomainRequest<Dim>& request, const MeshingOptions<Dim>& options) {
  Making making;
  auto mesh = mesh_in_parts<Dim>(
      request.cage, options, [&](const Cage<Dim>& cage, const MeshingOptions<Dim>& of_part) {
        return fill_by_any(cage, request.meshing.mesher, of_part, making);
      });
  auto note = in_words_of_program(making.failures);
  const auto on_count = note_on_count(request.vertices, mesh.num_vertices());
  if (!on_count.empty()) add_sentence(note, on_count);
  return {std::move(mesh), making.mesher, std::move(note)};
}

}  // namespace

template <int Dim>
MadeDomain<Dim> make_domain(const DomainRequest<Dim>& request) {
  require_mesher<Dim>(request.meshing.mesher);
  MeshingOptions<Dim> options;
  if (!request.embedded_file.empty()) options.embedded_points = request.embedded;
  options.vertices = request.vertices > 0 ? request.vertices : kDefaultVertices;
  options.time_limit = request.meshing.timeout;
  const auto name = request.embedded_file.empty()
                        ? request.cage_file
                        : request.cage_file + " with " + request.embedded_file;
  return naming(name, [&] { return fill_parts(request, options); });
}

template MadeDomain<2> make_domain(const DomainRequest<2>&);
template MadeDomain<3> make_domain(const DomainRequest<3>&);

}  // namespace flbc::app
