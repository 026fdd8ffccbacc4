// SPDX-License-Identifier: BSD-3-Clause
// Figures 1, 2 and 4 are pictures of coordinate functions. Here the weights are computed; the table
// lists what `flbc draw` has to be told about each picture.
#include <filesystem>

#include "flbc/io/weights_io.h"
#include "flbc/solver.h"
#include "paper/experiments.h"
#include "paper/result_table.h"
#include "paper/run_columns.h"

namespace flbc::bench {
namespace {

struct Picture {
  const char* model;
  Index vertices;
  int slices;           // 0 in 2D
  const char* variant;  // part of the picture's name and title; may be empty
  NonNegative non_negative;
};

template <int Dim>
Row compute(const Context& context, const std::string& figure, const Setting<Dim>& setting,
            const Picture& picture) {
  SolverOptions options;
  options.tolerance = 1e-8;  // below what a picture shows
  options.non_negative = picture.non_negative;
  options.threads = context.threads;
  const auto solution = solve(setting.problem, options);

  const auto& model = setting.model;
  const std::string variant = picture.variant;
  const auto stem = figure + "-" + model.name + "-" + std::to_string(setting.wanted_vertices) +
                    (variant.empty() ? "" : "-" + variant);
  std::filesystem::create_directories(context.out + "/weights");
  io::write_weights(context.out + "/weights/" + stem + ".npy", solution.weights);
  auto row = mesh_row(setting);
  row["variant"] = variant;
  row["picture"] = "pictures/" + stem + ".png";
  row["domain"] =
      std::filesystem::relative(domain_path(context, model, setting.wanted_vertices), context.out);
  row["weights"] = "weights/" + stem + ".npy";
  row["cage"] = model.cage;
  row["control_point"] = std::to_string(model.control_point);
  row["slices"] = std::to_string(picture.slices);
  return row;
}

bool run(const Context& context, const char* figure, const std::vector<Picture>& pictures,
         const std::string& about) {
  ResultTable table(
      context, figure,
      joined({mesh_columns(),
              {"variant", "picture", "domain", "weights", "cage", "control_point", "slices"}}));
  for (const auto& picture : pictures) {
    table.add(in_setting(context, figure, model(picture.model), picture.vertices,
                         [&](const auto& setting) {
                           return table.line(compute(context, figure, setting, picture));
                         }));
  }
  return table.write(about +
                     "; domain, weights and picture are in this folder, cage in the models'");
}

}  // namespace

bool run_figure2(const Context& context) {
  std::vector<Picture> pictures;
  const std::vector<Index> woody =
      context.quick ? std::vector<Index>{1000, 4000} : std::vector<Index>{2000, 10000, 50000};
  const std::vector<Index> horse =
      context.quick ? std::vector<Index>{2000, 4000} : std::vector<Index>{2000, 10000, 40000};
  for (const Index v : woody) pictures.push_back({"woody", v, 0, "", NonNegative::kAuto});
  for (const Index v : horse) pictures.push_back({"horse", v, 1, "", NonNegative::kAuto});
  return run(context, "figure2", pictures, "figure 2: one function at growing resolution");
}

bool run_figure4(const Context& context) {
  std::vector<Picture> pictures;
  for (const char* name : {"horse", "armadillo"}) {
    const Index vertices = context.size(3, model(name).paper_size);
    pictures.push_back({name, vertices, 3, "", NonNegative::kAuto});
  }
  return run(context, "figure4", pictures, "figure 4: one function on three slices");
}

}  // namespace flbc::bench
