// SPDX-License-Identifier: BSD-3-Clause
// flbc adjoint: derivatives by points become derivatives by control points.
#include <algorithm>
#include <array>
#include <iostream>
#include <memory>
#include <sstream>

#include "commands/commands.h"
#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "flbc/io/weights_io.h"
#include "front/bound_model.h"
#include "front/load.h"
#include "poses/outside.h"

namespace flbc::app {
namespace {

struct AdjointArguments {
  BindingFiles files;
  std::string gradients, joint, output;
  bool quiet = false;
};

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream text(line);
  for (std::string cell; std::getline(text, cell, ',');) {
    cell.erase(std::remove_if(cell.begin(), cell.end(),
                              [](char c) { return c == '"' || c == ' ' || c == '\r'; }),
               cell.end());
    cells.push_back(cell);
  }
  return cells;
}

// The rows of SU2's surface_adjoint.csv, which names its columns. Points that it does not have,
// such as those of a mesh inside, have no gradient.
template <int Dim>
PointList<Dim> read_su2(const std::string& path, const std::string& content, Index count) {
  std::istringstream lines(content);
  std::string line;
  std::getline(lines, line);
  const auto names = cells_of(line);
  std::array<std::size_t, Dim + 1> columns{};
  for (int d = 0; d <= Dim; ++d) {
    const auto name = d == Dim ? std::string("PointID") : std::string("Sensitivity_") + "xyz"[d];
    columns[d] = std::find(names.begin(), names.end(), name) - names.begin();
    if (d < Dim && columns[d] == names.size()) {
      throw InputError(path + ": no column is named " + name);
    }
  }
  PointList<Dim> gradients = PointList<Dim>::Zero(Dim, count);
  const bool has_ids = columns[Dim] < names.size();
  Index row = 0;
  for (; std::getline(lines, line); ++row) {
    const auto cells = cells_of(line);
    const auto fail = [&](const std::string& what) {
      throw InputError(path + ":" + std::to_string(row + 2) + ": " + what);
    };
    const auto number = [&](std::size_t column) {
      char* end = nullptr;
      const double value = column < cells.size() ? std::strtod(cells[column].c_str(), &end) : 0;
      if (end == nullptr || *end != 0 || cells[column].empty()) {
        fail("expected a number in the column " + names[column]);
      }
      return value;
    };
    const double point = has_ids ? number(columns[Dim]) : row;
    if (!(point >= 0 && point < count)) {
      fail("there is no point " + std::to_string(static_cast<std::int64_t>(point)) +
           "; the binding is of " + std::to_string(count));
    }
    for (int d = 0; d < Dim; ++d) gradients(d, static_cast<Index>(point)) = number(columns[d]);
  }
  if (!has_ids && row != count) {
    throw InputError(path + ": has gradients of " + std::to_string(row) +
                     " points, but the binding is of " + std::to_string(count));
  }
  return gradients;
}

template <int Dim>
void adjoint(const AdjointArguments& arguments) {
  auto binding = load_binding<Dim>(arguments.files);
  join(binding, arguments.joint, arguments.files.weights);
  const auto& path = arguments.gradients;
  std::string content;
  if (io::extension_of(path) == "csv") content = io::read_file(path);
  const bool is_su2 =
      content.substr(0, content.find('\n')).find("Sensitivity_") != std::string::npos;
  const auto gradients =
      is_su2 ? read_su2<Dim>(path, content, binding.weights.num_points()) : load_points<Dim>(path);
  const auto result = naming(path, [&] { return binding.adjoint(gradients); });
  io::write_weights(arguments.output, WeightMatrix(result));
  if (arguments.quiet) return;
  Eigen::Index largest = 0;
  const double length = result.colwise().norm().maxCoeff(&largest);
  std::cerr << arguments.output << ": gradients of " << result.cols()
            << " control points; the longest, " << length << ", is that of control point "
            << largest << '\n';
}

}  // namespace

void add_adjoint_command(CLI::App& app, int&) {
  auto arguments = std::make_shared<AdjointArguments>();
  auto& a = *arguments;
  auto* command =
      app.add_subcommand("adjoint", "turn gradients by vertices into gradients by control points");
  command->footer(
      "GRADIENTS has a row for each vertex of the model: the derivatives of an objective by its\n"
      "coordinates. The result has a row for each control point. It is the exact transpose of "
      "flbc\n"
      "deform, with vertices outside the cage and the joint. surface_adjoint.csv of SU2 is read "
      "by\n"
      "the names of its columns, and by PointID where only some vertices have gradients.");
  command->add_option("GRADIENTS", a.gradients, "gradients: .csv, .npy, or surface_adjoint.csv")
      ->required();
  command->add_option("--weights", a.files.weights, "binding of the model (.npz)")->required();
  add_joint_option(*command, a.joint);
  command->add_option("-o,--output", a.output, "gradients by control points: .csv, .npy")
      ->required();
  command->add_flag("-q,--quiet", a.quiet, "print only errors");
  command->callback([arguments] {
    if (!arguments->files.is_one()) {
      throw OptionError(arguments->files.weights + ": adjoint needs a binding (.npz)");
    }
    require_writable(arguments->output, std::vector<std::string>{"csv", "npy"});
    require_distinct({arguments->gradients, arguments->files.weights}, {arguments->output});
    dimension_of(arguments->files) == 2 ? adjoint<2>(*arguments) : adjoint<3>(*arguments);
  });
}

}  // namespace flbc::app
