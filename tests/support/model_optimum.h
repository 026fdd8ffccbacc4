// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Optima of models of real size that were found by other means
//! (tests/data/references/README.md, "Models").
#pragma once

#include <fstream>

#include "support/test.h"

namespace flbc::testing {

//! Of one of the two problems, without and with w >= 0.
struct ModelOptimum {
  double objective = 0, gap = 0;
  std::vector<Eigen::VectorXd> weights;  //!< n, per sample
};

//! A mesh, by its sizes and some of its vertices, and the optima on it.
template <int Dim>
struct ModelReference {
  Index control_points, vertices, cells;
  std::vector<Index> samples;  //!< vertices
  std::vector<Vector<Dim>> positions;
  std::map<std::string, ModelOptimum> optima;  //!< unconstrained, and if it differs non_negative

  const ModelOptimum& without() const { return optima.at("unconstrained"); }
  const ModelOptimum& with() const {
    const auto found = optima.find("non_negative");
    return found == optima.end() ? without() : found->second;
  }

  //! Whether it is this mesh.
  bool belongs_to(const DomainMesh<Dim>& mesh) const {
    if (mesh.num_vertices() != vertices || mesh.num_cells() != cells) return false;
    for (std::size_t k = 0; k < samples.size(); ++k) {
      if ((mesh.points.col(samples[k]) - positions[k]).norm() >= 1e-6) return false;
    }
    return true;
  }

  //! The samples' columns of n x V weights.
  std::vector<Eigen::VectorXd> sampled(const WeightMatrix& weights) const {
    std::vector<Eigen::VectorXd> columns;
    for (const Index v : samples) columns.emplace_back(weights.col(v));
    return columns;
  }
};

inline double mean_squared_difference(const std::vector<Eigen::VectorXd>& a,
                                      const std::vector<Eigen::VectorXd>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]).squaredNorm();
  return sum / static_cast<double>(a.size() * static_cast<std::size_t>(a[0].size()));
}

template <int Dim>
ModelOptimum read_optimum(std::ifstream& file, const ModelReference<Dim>& reference) {
  ModelOptimum optimum;
  std::string key;
  file >> optimum.objective >> key >> optimum.gap;
  for (const Index sample : reference.samples) {
    int entries = 0;
    Index vertex = 0, control_point = 0;
    file >> vertex >> entries;
    if (vertex != sample) throw std::runtime_error("samples in another order");
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(reference.control_points);
    for (int k = 0; k < entries; ++k) {
      file >> control_point;
      file >> weights[control_point];
    }
    optimum.weights.push_back(weights);
  }
  if (!file) throw std::runtime_error("an optimum breaks off");
  return optimum;
}

//! \param data  the folder tests/data \throws std::runtime_error if the file is absent or damaged
template <int Dim>
ModelReference<Dim> read_model_reference(const std::string& data, const std::string& name) {
  std::ifstream file(data + "/references/models/" + name + ".txt");
  file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  std::string key, model;
  int dimension = 0, count = 0;
  ModelReference<Dim> reference;
  file >> key >> model >> key >> dimension >> key >> reference.control_points >> key >>
      reference.vertices >> key >> reference.cells >> key >> count;
  reference.samples.resize(count);
  reference.positions.resize(count);
  for (int k = 0; k < count; ++k) {
    file >> reference.samples[k];
    for (int axis = 0; axis < Dim; ++axis) file >> reference.positions[k][axis];
  }
  if (!file || dimension != Dim || model != name) throw std::runtime_error(name + " is damaged");
  while (file >> key) {
    const auto variant = key.substr(0, key.rfind('_'));  // key: VARIANT_objective
    reference.optima[variant] = read_optimum(file, reference);
  }
  return reference;
}

//! The phi of the references, of Euclidean distances: n x cells.
template <int Dim>
Eigen::MatrixXd euclidean_phi(const PointList<Dim>& control_points, const DomainMesh<Dim>& mesh) {
  Eigen::MatrixXd distances(control_points.cols(), mesh.num_vertices());
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    distances.col(v) = (control_points.colwise() - mesh.points.col(v)).colwise().norm();
  }
  Eigen::MatrixXd phi = Eigen::MatrixXd::Zero(distances.rows(), mesh.num_cells());
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    for (int k = 0; k <= Dim; ++k) phi.col(s) += distances.col(mesh.cells(k, s)) / (Dim + 1);
  }
  return (phi / distances.maxCoeff()).array().square();
}

}  // namespace flbc::testing
