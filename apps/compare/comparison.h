// SPDX-License-Identifier: BSD-3-Clause
// What flbc compare compares: kinds of coordinates of one cage.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "draw/view.h"
#include "flbc/meshing.h"
#include "front/poses.h"
#include "run/folder.h"
#include "run/inputs.h"
#include "solve/solve_settings.h"

namespace flbc::app {

constexpr const char* kComparisonReport = "table.json";

struct CompareArguments {
  std::string cage, model, pose, output;
  std::vector<std::string> methods;
  Index vertices = 0;
  Index control_point = -1;
  MesherSettings meshing{};
  std::string pictures = "png";
  UpAxis up = UpAxis::kAuto;
  bool force = false;
  bool quiet = false;
};

//! A kind of coordinates with its results.
template <int Dim>
struct Column {
  std::string name;          //!< also in names of files
  std::string title;         //!< in pictures
  SolveSettings settings{};  //!< coordinates, or options of local ones
  std::string failure{};     //!< if there are no results
  SparseWeights of_mesh{};   //!< of the vertices of the mesh
  SparseWeights rows{};      //!< the same of the shape's points
  Motion<Dim> moved{};       //!< how they move
  nlohmann::ordered_json facts{};

  std::string weights_file() const { return "weights_" + name + ".npy"; }
  //! Green coordinates have further weights, which files have no room for.
  bool has_normals() const { return settings.coordinates == Coordinates::kGreen; }
};

//! What is compared, and where it goes.
template <int Dim>
struct Comparison {
  const CompareArguments& arguments;
  const Cage<Dim>& cage;
  RunFolder& folder;
  Shape<Dim> shape{};     //!< a model, or the mesh
  PointList<Dim> pose{};  //!< of the control points; empty without one
  DomainMesh<Dim> domain{};
  Placement<Dim> placement{};  //!< of the model's points; empty without one
  std::vector<Column<Dim>> columns{};
  Index control_point = 0;  //!< that is drawn

  //! The shape's points. Points of a model beside the cage are where their weights put them.
  const PointList<Dim>& points() const {
    return arguments.model.empty() ? domain.points : placement.points;
  }
  std::vector<const Column<Dim>*> succeeded() const {
    std::vector<const Column<Dim>*> some;
    for (const auto& column : columns) {
      if (column.failure.empty()) some.push_back(&column);
    }
    return some;
  }
};

std::vector<std::string> comparable_methods();

//! A column for each method. \param methods  empty for all
template <int Dim>
std::vector<Column<Dim>> columns_of(const std::vector<std::string>& methods);

//! Makes the mesh, finds the model in it, and computes all columns. A column that fails keeps the
//! reason. \throws InputError if all fail, or if there is no mesh
template <int Dim>
void solve_columns(Comparison<Dim>& all);

//! Draws one function by all methods, and the pose by all methods.
//! \return the files of the pictures that could be drawn
template <int Dim>
std::vector<std::string> draw_grids(Comparison<Dim>& all);

//! The page that shows the table and the pictures.
//! \param pictures  names of files
template <int Dim>
std::string comparison_page(const Comparison<Dim>& all, const std::vector<std::string>& pictures);

//! The table as text, with the reasons of failures.
template <int Dim>
std::string comparison_text(const Comparison<Dim>& all);

std::vector<std::string> names_of_grids(const CompareArguments& arguments);

}  // namespace flbc::app
