// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Block coordinate descent on sparse weights of points that are connected by edges.
#pragma once

#include <vector>

#include "flbc/sparsify.h"
#include "flbc/types.h"
#include "sparsify/poisson/edge_graph.h"
#include "sparsify/poisson/poisson_energy.h"
#include "sparsify/support_selection.h"

namespace flbc {

//! Moves the sparse weights of one point at a time to where the energy is less. Points that are one
//! in the graph are taken for one.
template <int Dim>
class PoissonDescent {
 public:
  //! All kept by reference, but the options.
  //! \param control_points  Dim x n
  //! \param points  Dim x P
  //! \param given  n x P, the weights to stay near to
  //! \param plain  n x P, some feasible weights that are as sparse as the options say
  PoissonDescent(const PoissonEnergy& energy, const EdgeGraph& graph,
                 const PointList<Dim>& control_points, const PointList<Dim>& points,
                 const WeightMatrix& given, const WeightMatrix& plain,
                 const SparsifyOptions& options);

  //! Starts from these feasible weights, n x P, which may have more influences than the options
  //! allow: what is too much is removed when the descent first comes to a point.
  void start(const WeightMatrix& weights);

  //! Goes over the points until no point gains more than `least_gain` any more, but at most
  //! `sweeps` times.
  void run(int sweeps, double least_gain);

  //! The weights of a representative of the graph, n, up to about 1e-8.
  Eigen::VectorXd weights_of(Index point) const;

 private:
  struct Workspace {
    Workspace(const Eigen::MatrixXd& metric, const PointList<Dim>& control_points)
        : selection(Metric(metric), control_points) {}
    SupportSelection<Dim> selection;
    PointWeights best;
    std::vector<bool> may_enter;
    std::vector<const std::vector<Index>*> supports;
  };

  bool sweep(double least_gain);
  bool improve(Index point, double least_gain, Workspace& work);
  void aim(Index point, Workspace& work) const;
  void find_allowed(Index point, std::vector<bool>& may_enter) const;
  void find_supports_around(Index point, Workspace& work) const;
  void update(Index point, const PointWeights& weights);

  const PoissonEnergy& energy_;
  const EdgeGraph& graph_;
  const PointList<Dim>& control_points_;
  const PointList<Dim>& points_;
  const WeightMatrix& given_;
  const WeightMatrix& plain_;
  SparsifyOptions options_;
  std::vector<double> stiffness_;  // per point: the sum of k_ab and pin m_a
  std::vector<bool> fixed_;
  std::vector<PointWeights> weights_;
  Eigen::MatrixXd potential_;        // n x P: H (w - given)
  std::vector<unsigned char> open_;  // per point: may it have something to gain?
};

}  // namespace flbc
