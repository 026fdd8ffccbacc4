// SPDX-License-Identifier: BSD-3-Clause
#include "files/convert_mesh.h"

#include <iostream>

#include "files/held_signals.h"
#include "files/load.h"
#include "files/movable_model.h"

namespace flbc::app {
Index count_vertices(const std::string& path) {
  if (io::holds(path, {io::Content::kModel})) {
    return static_cast<Index>(io::read_polygons(path).points.size());
  }
  require_mesh_readable(path);
  return std::visit([](const auto& any) { return static_cast<Index>(any.points().cols()); },
                    load_any_model({path, path}));
}

void convert_mesh(const std::string& input, const std::string& output, bool quiet) {
  const auto convert = [&](const auto& any) {
    {
      const HeldSignals held;
      naming(input, [&] { any.write(output, any.points(), {}, 0); });
    }
    if (quiet) return;
    std::cerr << output << ": " << any.points().cols() << " vertices\n";
    any.print_losses();
  };
  constexpr bool kShowsDisplacement = false, kIsAnew = true;
  std::visit(convert, load_any_model({input, output, kShowsDisplacement, kIsAnew}));
}

}  // namespace flbc::app
