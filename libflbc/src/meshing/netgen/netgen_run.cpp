// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/netgen/netgen_run.h"

#include <dlfcn.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <string>
#include <vector>

namespace nglib {
#include <nglib.h>
}

#include "base/messages.h"
#include "flbc/errors.h"
#include "meshing/isolated_process.h"

namespace flbc {

namespace {

enum class NetgenEnd : std::int64_t { kDone, kNoLibrary, kGaveUp };

// Precedes the arrays, or the loader's message, in the child's output.
struct Header {
  NetgenEnd end;
  std::int64_t num_points;  // or characters of the message
  std::int64_t num_cells;
};

// The functions of nglib that are used, by the names they are compiled to.
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
    find("_ZN5nglib20Ng_AddSurfaceElementEPPvNS_23Ng_Surface_Element_TypeEPi",
         add_surface_element);
    find("_ZN5nglib21Ng_GenerateVolumeMeshEPPvPNS_21Ng_Meshing_ParametersE",
         generate_volume_mesh);
    find("_ZN5nglib8Ng_GetNPEPPv", num_points);
    find("_ZN5nglib8Ng_GetNEEPPv", num_elements);
    find("_ZN5nglib11Ng_GetPointEPPviPd", get_point);
    find("_ZN5nglib19Ng_GetVolumeElementEPPviPi", get_volume_element);
    find("_ZN5nglib21Ng_Meshing_ParametersC1Ev", construct_parameters);
  }

  //! Why it cannot be used; empty if it can.
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

  void* library_;  // stays loaded: the process ends soon
  std::string complaint_;
};

void send_complaint(const std::string& complaint, const ByteSink& send) {
  const Header header{NetgenEnd::kNoLibrary, static_cast<std::int64_t>(complaint.size()), 0};
  send(&header, sizeof header);
  send(complaint.data(), complaint.size());
}

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

// Runs in the child: Netgen ends the process on some surfaces.
void mesh_and_send(const Cage<3>& surface, double longest, const ByteSink& send) {
  const Netgen netgen;
  if (!netgen.complaint().empty()) return send_complaint(netgen.complaint(), send);
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
  // These tests take walls that are thin for the triangles on them for defects.
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

void refuse_failure(const ProcessOutcome& outcome, double time_limit) {
  switch (outcome.end) {
    case ProcessEnd::kFinished:
      return;
    case ProcessEnd::kThrew:
      fail("gave up");
    case ProcessEnd::kCrashed:
      fail("crashed with " + describe_signal(outcome.signal));
    case ProcessEnd::kTimedOut:
      fail("was stopped at the time limit of " + format_number(time_limit) +
           " s (--mesh-timeout)");
  }
}

}  // namespace

DomainMesh<3> run_netgen(const Cage<3>& surface, double longest, double seconds,
                         double time_limit) {
  const ProcessOutcome outcome = run_isolated(
      [&](const ByteSink& send) { mesh_and_send(surface, longest, send); }, seconds);
  refuse_failure(outcome, time_limit);

  ByteSource source(outcome.output, [] { fail("sent an incomplete result"); });
  Header header{};
  source.take(&header, 1);
  if (header.end == NetgenEnd::kGaveUp) fail("gave up");
  if (header.end == NetgenEnd::kNoLibrary) {
    std::string complaint(std::size_t(header.num_points), ' ');
    source.take(complaint.data(), complaint.size());
    throw InputError("Netgen's library cannot be loaded (Debian's package libnglib-6.2): " +
                     complaint);
  }
  DomainMesh<3> mesh;
  mesh.points.resize(3, header.num_points);
  mesh.cells.resize(4, header.num_cells);
  source.take(mesh.points.data(), 3 * std::size_t(header.num_points));
  source.take(mesh.cells.data(), 4 * std::size_t(header.num_cells));
  return mesh;
}

}  // namespace flbc
