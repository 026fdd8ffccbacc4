// SPDX-License-Identifier: BSD-3-Clause
// The motion solver cageMotion, which dynamicMeshDict loads: moves a mesh with a cage.
#include <memory>

#include "Tuple2.H"
#include "addToRunTimeSelectionTable.H"
#include "cage_deformer.h"
#include "points0MotionSolver.H"

namespace Foam {

class cageMotionSolver : public points0MotionSolver {
 public:
  TypeName("cageMotion");

  cageMotionSolver(const polyMesh& mesh, const IOdictionary& dict)
      : points0MotionSolver(mesh, dict, typeName) {
    make_deformer();
  }

  tmp<pointField> curPoints() const override { return deformer_->positions(mesh().time().value()); }

  void solve() override {}

  void updateMesh(const mapPolyMesh& map) override {
    points0MotionSolver::updateMesh(map);
    make_deformer();
  }

 private:
  void make_deformer() {
    std::vector<flbc::foam::TimedPose> poses;
    for (const auto& pose : coeffDict().get<List<Tuple2<scalar, fileName>>>("poses")) {
      poses.push_back({pose.first(), pose.second()});
    }
    deformer_ = std::make_unique<flbc::foam::CageDeformer>(mesh(), points0(), coeffDict(), poses);
  }

  std::unique_ptr<const flbc::foam::CageDeformer> deformer_;
};

defineTypeNameAndDebug(cageMotionSolver, 0);
addToRunTimeSelectionTable(motionSolver, cageMotionSolver, dictionary);

}  // namespace Foam
