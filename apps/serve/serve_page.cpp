// SPDX-License-Identifier: BSD-3-Clause
#include "serve/serve_page.h"

#include <omp.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <iostream>

#include "files/load.h"
#include "flbc/io/mesh_io.h"
#include "serve/local_server.h"
#include "serve/reshaping.h"
#include "solve/make_domain.h"
#include "solve/progress_bar.h"
#include "view/model_page.h"

namespace flbc::app {
namespace {

volatile std::sig_atomic_t interrupted = 0;

// Ctrl-C ends the server rather than the program, which then ends as it should. A second one does
// not wait for the answer that is being made.
class InterruptsNoticed {
 public:
  InterruptsNoticed() {
    struct sigaction action {};
    action.sa_handler = [](int signal) {
      if (interrupted != 0) {
        std::signal(signal, SIG_DFL);
        std::raise(signal);
      }
      interrupted = 1;
    };
    sigaction(SIGINT, &action, &old_interrupt_);
    sigaction(SIGTERM, &action, &old_terminate_);
  }
  ~InterruptsNoticed() {
    sigaction(SIGINT, &old_interrupt_, nullptr);
    sigaction(SIGTERM, &old_terminate_, nullptr);
  }
  InterruptsNoticed(const InterruptsNoticed&) = delete;
  InterruptsNoticed& operator=(const InterruptsNoticed&) = delete;

 private:
  struct sigaction old_interrupt_ {};
  struct sigaction old_terminate_ {};
};

template <int Dim>
MadeDomain<Dim> mesh_interior(const Cage<Dim>& cage, const ServeArguments& arguments) {
  const ProgressBar bar(arguments.quiet, meshing_stage(MesherSettings().timeout));
  constexpr Index kQuick = 2000;  // vertices that are solved again within a moment
  const Index vertices = arguments.vertices > 0 ? arguments.vertices : kQuick;
  return make_domain<Dim>({cage, arguments.cage, vertices});
}

template <int Dim>
view::ShownModel<Dim> shown_model(const DomainMesh<Dim>& mesh, const ServeArguments& arguments) {
  if (!arguments.model.empty()) return load_shown_model<Dim>(arguments.model);
  return {mesh.points, gltf::surface_of_model<Dim>({io::to_polygons(mesh)})};
}

template <int Dim>
void serve_cage(const Cage<Dim>& cage, const ServeArguments& arguments) {
  // One core is left to the browser, which draws meanwhile: threads that wait for one it has taken
  // cost more than they save.
  omp_set_num_threads(std::max(1, omp_get_max_threads() - 1));
  const auto domain = mesh_interior(cage, arguments);
  const auto& mesh = domain.mesh;
  auto model = shown_model(mesh, arguments);
  LocalServer server(arguments.port);
  auto reshaping = [&] {
    const ProgressBar bar(arguments.quiet, "solving");
    const bool has_model = !arguments.model.empty();
    return naming(has_model ? arguments.model : arguments.cage, [&] {
      Reshaping<Dim> first(cage, mesh, has_model ? model.points : PointList<Dim>(), {},
                           coarse_mesher<Dim>(domain.mesher));
      first.weights();  // refuses a model that reaches out of its cage
      return first;
    });
  }();
  const auto& named = arguments.model.empty() ? arguments.cage : arguments.model;
  view::PageContent<Dim> content;
  content.title = std::filesystem::path(named).stem().string();
  content.model_file = named;
  content.weights_file = "weights.npy";
  content.cage_file = arguments.cage;
  content.cage = load_shown_cage<Dim>(arguments.cage);
  content.up = up_axis(arguments.up, model.points);
  content.surface = std::move(model.surface);
  content.is_served = true;
  content.moves_along = arguments.model.empty();
  server.set_page([&] {
    content.cage.points = reshaping.cage().points;
    content.points = reshaping.points();
    content.weights = reshaping.weights();
    return view::make_page(content);
  });
  server.set_answer("reshape",
                    [&](const std::string& request) { return reshaping.answer(request); });
  const InterruptsNoticed noticed;
  std::cout << server.address() << std::endl;
  if (!arguments.quiet) {
    std::cerr << "Open this address in a browser on this machine; press Ctrl-C, or "
                 "close the page, to stop.\n";
  }
  server.serve([] { return interrupted != 0; });
}

}  // namespace

void serve_page(const ServeArguments& arguments) {
  std::visit([&](const auto& cage) { serve_cage(cage, arguments); }, load_cage(arguments.cage));
}

}  // namespace flbc::app
