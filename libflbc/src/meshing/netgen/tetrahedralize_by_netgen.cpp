// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/meshing.h"

#include <dlfcn.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <string>
#include <utility>
#include <vector>

namespace nglib {
#include <nglib.h>
}

#include "base/messages.h"
#include "base/stopwatch.h"
#include "cage/facet_geometry.h"
#include "cage/oriented_cage.h"
#include "flbc/bounding_box.h"
#include "flbc/cage.h"
#include "flbc/domain_mesh.h"
#include "flbc/errors.h"
#include "meshing/isolated_process.h"
#include "meshing/meshing_common.h"
#include "meshing/surface_subdivision.h"
#include "meshing/vertex_count_search.h"

namespace flbc {

namespace {

enum class NetgenEnd : std::int64_t { kDone, kNoLibrary, kGaveUp };

// Header of the child output, before the arrays or the message of the loader.
struct Header {
  NetgenEnd end;
  std::int64_t num_points;  // or number of characters of the message
  std::int64_t num_cells;
};

// The nglib functions in use, by their mangled names.
class Netgen {
 public:
  decltype(&nglib::Ng_Init) init = nullptr;
  decltype(&nglib::Ng_NewMesh) new_mesh = nullptr;
  decltype(&nglib::Ng_AddPoint) add_point = nullptr;
  decltype(&nglib::Ng_AddSurfaceElement) add_surface_element = nullptr;
  decltype(&nglib::Ng_GenerateVolumeMesh) generate_volume_mesh = nullptr;
  decltype(&nglib::Ng_GetNP) num_points = nullptr;
  decltype(&nglib::Ng_GetNE) num_elements = nullptr;
  decltype(&nglib::Ng_GetPoint) get_point = nullptr;
  decltype(&nglib::Ng_GetVolumeElement) get_volume_element = nullptr;
  void (*construct_parameters)(void*) = nullptr;

  Netgen() : library_(dlopen(FLBC_NGLIB_FILE, RTLD_NOW)) {
    if (library_ == nullptr) complain();
    find("_ZN5nglib7Ng_InitEv", init);
    find("_ZN5nglib10Ng_NewMeshEv", new_mesh);
    find("_ZN5nglib11Ng_AddPointEPPvPd", add_point);
    find("_ZN5nglib20Ng_AddSurfaceElementEPPvNS_23Ng_Surface_Element_TypeEPi", add_surface_element);
    find("_ZN5nglib21Ng_GenerateVolumeMeshEPPvPNS_21Ng_Meshing_ParametersE", generate_volume_mesh);
    find("_ZN5nglib8Ng_GetNPEPPv", num_points);
    find("_ZN5nglib8Ng_GetNEEPPv", num_elements);
    find("_ZN5nglib11Ng_GetPointEPPviPd", get_point);
    find("_ZN5nglib19Ng_GetVolumeElementEPPviPi", get_volume_element);
    find("_ZN5nglib21Ng_Meshing_ParametersC1Ev", construct_parameters);
  }

  // The reason why it cannot be used; empty if it can.
  const std::string& complaint() const { return complaint_; }

 private:
  template <class Function>
  void find(const char* name, Function& function) {
    void* address = library_ == nullptr ? nullptr : dlsym(library_, name);
    if (library_ != nullptr && address == nullptr) complain();
    std::memcpy(&function, &address, sizeof function);
  }

  void complain() {
    const char* reason = dlerror();
    if (complaint_.empty()) complaint_ = reason == nullptr ? "unknown reason" : reason;
  }

  void* library_;  // not unloaded, because the process ends soon
  std::string complaint_;
};

void send_mesh(const Netgen& netgen, nglib::Ng_Mesh* mesh, const ByteSink& send) {
  const Header header{NetgenEnd::kDone, netgen.num_points(mesh), netgen.num_elements(mesh)};
  send(&header, sizeof header);
  for (int i = 1; i <= header.num_points; ++i) {
    double point[3];
    netgen.get_point(mesh, i, point);
    send(point, sizeof point);
  }
  for (int i = 1; i <= header.num_cells; ++i) {
    int corners[NG_VOLUME_ELEMENT_MAXPOINTS];
    netgen.get_volume_element(mesh, i, corners);
    std::array<std::int32_t, 4> cell;
    for (int k = 0; k < 4; ++k) cell[k] = corners[k] - 1;
    send(cell.data(), sizeof cell);
  }
}

// Runs in the child, because Netgen ends the process on some surfaces.
void mesh_and_send(const Cage<3>& surface, double longest, const ByteSink& send) {
  const Netgen netgen;
  const std::string& complaint = netgen.complaint();
  if (!complaint.empty()) {
    const Header header{NetgenEnd::kNoLibrary, static_cast<std::int64_t>(complaint.size()), 0};
    send(&header, sizeof header);
    return send(complaint.data(), complaint.size());
  }
  netgen.init();
  nglib::Ng_Mesh* mesh = netgen.new_mesh();
  for (Index i = 0; i < surface.size(); ++i) {
    Vector<3> point = surface.points.col(i);
    netgen.add_point(mesh, point.data());
  }
  for (Index t = 0; t < surface.facets.cols(); ++t) {
    int corners[3];
    for (int k = 0; k < 3; ++k) corners[k] = surface.facets(k, t) + 1;
    netgen.add_surface_element(mesh, nglib::NG_TRIG, corners);
  }
  alignas(nglib::Ng_Meshing_Parameters) std::byte storage[sizeof(nglib::Ng_Meshing_Parameters)];
  netgen.construct_parameters(storage);
  auto* parameters = std::launder(reinterpret_cast<nglib::Ng_Meshing_Parameters*>(storage));
  parameters->maxh = longest;
  parameters->optsteps_3d = 2;
  // These tests reject walls that are thin relative to their triangles.
  parameters->check_overlap = 0;
  parameters->check_overlapping_boundary = 0;
  if (netgen.generate_volume_mesh(mesh, parameters) == nglib::NG_OK) {
    return send_mesh(netgen, mesh, send);
  }
  const Header header{NetgenEnd::kGaveUp, 0, 0};
  send(&header, sizeof header);
}

[[noreturn]] void fail(const std::string& what) {
  throw InputError("Netgen " + what + " while filling the cage");
}

// Fills a surface with tetrahedra in a separate process.
// \param surface     outer shells with outward normals, cavities with inward normals
// \param longest     approximate maximum edge length, in the units of the surface
// \param seconds     time limit \param patience  its time limit is shown in messages
// \return a mesh that starts with the points of the surface and contains all its triangles
// \throws InputError if Netgen fails, crashes, takes longer or cannot be loaded
DomainMesh<3> run_netgen(const Cage<3>& surface, double longest, double seconds,
                         const Patience& patience) {
  const ProcessOutcome outcome =
      run_isolated([&](const ByteSink& send) { mesh_and_send(surface, longest, send); },
                   {seconds, patience.poll});
  const auto failure = describe_failure(outcome, patience.seconds);
  if (!failure.empty()) fail(failure);

  ByteSource source(outcome.output, [] { fail("sent an incomplete result"); });
  Header header{};
  source.take(&header, 1);
  if (header.end == NetgenEnd::kGaveUp) fail("gave up");
  if (header.end == NetgenEnd::kNoLibrary) {
    std::string complaint(std::size_t(header.num_points), ' ');
    source.take(complaint.data(), complaint.size());
    throw InputError("cannot load the Netgen library (Debian package libnglib-dev): " + complaint);
  }
  DomainMesh<3> mesh;
  mesh.points.resize(3, header.num_points);
  mesh.cells.resize(4, header.num_cells);
  source.take(mesh.points.data(), 3 * std::size_t(header.num_points));
  source.take(mesh.cells.data(), 4 * std::size_t(header.num_cells));
  return mesh;
}

constexpr double kCountTolerance = 0.10;  // documented in MeshingOptions

// Exponent of vertex count over longest edge: 2 on the surface, 3 inside.
constexpr double kCountExponent = 2.4;

// Cage facets are preserved, so the volumes of mesh and cage agree up to rounding.
constexpr double kVolumeTolerance = 1e-9;
// Netgen would take minutes for more; a mesh of 5,000,000 vertices has a quarter of this number.
constexpr std::size_t kMaxSurfacePoints = 1'000'000;

// The cage to fill.
struct Task {
  OrientedCage<3> oriented;
  double size;  // of the cage
  Patience patience;
};

// The longest edge for the expected number of vertices: 3.2 per squared edge of surface plus 1.3
// per cubed edge of volume, measured on cages of animals.
double guess_longest_edge(const Task& task, Index vertices) {
  const auto& cage = task.oriented.cage;
  const double area = area_of(cage.points, cage.facets), volume = task.oriented.measure;
  double finest = 0, coarsest = task.size;
  for (int step = 0; step < 60; ++step) {
    const double edge = (finest + coarsest) / 2;
    const double count = 3.2 * area / (edge * edge) + 1.3 * volume / (edge * edge * edge);
    (count > vertices ? finest : coarsest) = edge;
  }
  return coarsest;
}

void check_surface_is_kept(const Task& task, const Cage<3>& surface, const DomainMesh<3>& mesh) {
  const bool has_points = mesh.num_vertices() >= surface.size() &&
                          mesh.points.leftCols(surface.size()) == surface.points;
  double volume = 0;
  for (Index cell = 0; cell < mesh.num_cells(); ++cell) {
    volume += std::abs(signed_measure(mesh, cell));
  }
  if (has_points && std::abs(volume / task.oriented.measure - 1) <= kVolumeTolerance) return;
  throw InputError("Netgen did not fill the cage: its volume is " +
                   format_number(task.oriented.measure) + ", that of the cells " +
                   format_number(volume));
}

// Netgen fails on some triangulations of a shape, most often with coarse triangles on thin walls.
// \param longest  edge lengths to try in order, within one time limit
DomainMesh<3> fill_by_first(const Task& task, const std::vector<double>& longest) {
  Stopwatch watch;
  double left = task.patience.seconds;
  for (std::size_t k = 0;; ++k) {
    // If this has too many points, shorter edges would have even more.
    const auto surface = subdivide_surface(task.oriented.cage, longest[k], kMaxSurfacePoints);
    try {
      auto mesh = run_netgen(surface, longest[k], left, task.patience);
      check_surface_is_kept(task, surface, mesh);
      return mesh;
    } catch (const InputError&) {
      left -= watch.lap();
      if (k + 1 == longest.size() || left <= 0) throw;
    }
  }
}

DomainMesh<3> fill(const Task& task, double longest) {
  return fill_by_first(task, {longest, 0.9 * longest, 0.75 * longest});
}

DomainMesh<3> fill_coarsely(const Task& task) {
  std::vector<double> longest{task.size};
  for (int halving = 0; halving < 5; ++halving) longest.push_back(longest.back() / 2);
  return fill_by_first(task, longest);
}

DomainMesh<3> fill_to_count(const Task& task, const VertexCountGoal<3>& goal) {
  constexpr int kRuns = 4;
  const double first = guess_longest_edge(task, goal.before_refining());
  DomainMesh<3> mesh = fill(task, first);
  const double ratio = goal.count(mesh) / goal.vertices;
  return search_vertex_count<3>(
      goal, std::move(mesh), first * std::pow(ratio, 1 / kCountExponent), kCountExponent,
      [&](double longest) { return fill(task, longest); }, kRuns);
}

DomainMesh<3> fill_with(const Task& task, Index vertices) {
  const auto finished = [&](DomainMesh<3> mesh) {
    finish_mesh(mesh, task.oriented.cage.size());
    return mesh;
  };
  if (vertices == 0) return finished(fill_coarsely(task));
  const double most = (1 + kCountTolerance) * vertices;
  const VertexCountGoal<3> nested{vertices, kCountTolerance, true};
  DomainMesh<3> mesh = fill_to_count(task, nested);
  if (nested.count(mesh) <= most) return nested.result(finished(std::move(mesh)));
  mesh = fill_to_count(task, {vertices, kCountTolerance});
  // Regular surfaces are subdivided at a single length, so the count jumps; this is not an error.
  if (mesh.num_vertices() > most) {
    check_vertex_count(vertices, fill_coarsely(task).num_vertices(), kCountTolerance);
  }
  return finished(std::move(mesh));
}

}  // namespace

DomainMesh<3> tetrahedralize_by_netgen(const Cage<3>& cage, const MeshingOptions<3>& options) {
  validate(cage);
  collect_input_points(cage, options);  // checks the options
  if (options.embedded_points.cols() > 0) {
    throw OptionError(
        "Netgen cannot make given points vertices of its mesh; choose another mesher");
  }
  const Task task{
      orient(cage), bounding_box_diagonal(cage.points), {options.time_limit, options.poll}};
  try {
    return fill_with(task, options.vertices);
  } catch (const InputError& error) {
    throw InputError(error.what() + describe_thinnest(cage));
  }
}

}  // namespace flbc
