// SPDX-License-Identifier: BSD-3-Clause
#include "cage_deformer.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "Pstream.H"
#include "Time.H"
#include "clockTime.H"
#include "polyMeshGeometry.H"
#include "primitiveMeshTools.H"
#include "syncTools.H"
#include "unitConversion.H"

#include "flbc/border.h"
#include "flbc/bounding_box.h"
#include "flbc/deform.h"
#include "flbc/errors.h"
#include "flbc/evaluator.h"
#include "flbc/io/binding_file.h"
#include "flbc/io/cage_io.h"

namespace flbc::foam {
namespace {

// Control points that move by less, relative to the cage size, count as fixed: files round.
constexpr double kFixed = 1e-9;

std::string in_case(const Foam::polyMesh& mesh, Foam::fileName file) {
  file.expand();
  return file.isAbsolute() ? file : mesh.time().globalPath() / file;
}

// In 2D, z is not read and does not move.
template <int Dim>
Vector<Dim> to_vector(const Foam::point& point) {
  return Eigen::Map<const Vector<Dim>>(point.v_);
}

// \param file  for messages
template <int Dim>
void require_domain(const Binding<Dim>& binding, const std::string& file) {
  const auto& domain = binding.domain;
  if (domain.num_cells() == 0) {
    throw InputError(file +
                     ": has no domain mesh, by which points of other meshes are moved; "
                     "write it by flbc solve");
  }
  const auto reproduced = deform<Dim>(binding.domain_weights, binding.cage.points);
  const double size = bounding_box_diagonal(binding.cage.points);
  Eigen::Index worst = 0;
  if (displacements<Dim>(domain.points, reproduced).maxCoeff(&worst) <= kBoundaryTolerance * size) {
    return;
  }
  throw InputError(file + ": the weights do not put vertex " + std::to_string(worst) +
                   " of the domain mesh where it is; write the file again by flbc solve");
}

Foam::scalar of_slowest_rank(const Foam::clockTime& watch) {
  return Foam::returnReduce(watch.elapsedTime(), Foam::maxOp<Foam::scalar>());
}

// Points of the patches, also where another rank has the face.
Foam::boolList points_of_patches(const Foam::polyMesh& mesh, const Foam::dictionary& dict) {
  Foam::boolList found(mesh.nPoints(), false);
  const auto names = dict.lookupOrDefault<Foam::wordRes>("fixedPatches", Foam::wordRes());
  for (const auto& name : names) {
    const auto patches = mesh.boundaryMesh().findIndices(Foam::keyType(name), true);
    if (patches.empty()) {
      FatalIOErrorInFunction(dict)
          << "fixedPatches: the mesh has no patch " << name << "; choose from "
          << mesh.boundaryMesh().names() << Foam::exit(Foam::FatalIOError);
    }
    for (const Foam::label patch : patches) {
      for (const Foam::label p : mesh.boundaryMesh()[patch].meshPoints()) found[p] = true;
    }
  }
  Foam::syncTools::syncPointList(mesh, found, Foam::orEqOp<bool>(), false);
  return found;
}

// The displacements of points.
template <int Dim>
class Motion {
 public:
  Motion(const Foam::polyMesh& mesh, const Foam::pointField& points, Binding<Dim> binding,
         const std::vector<TimedPose>& poses, const std::optional<Joint>& joint)
      : evaluator_(std::move(binding.cage), std::move(binding.domain),
                   std::move(binding.domain_weights), OutsidePoints::kKeep,
                   Foam::Pstream::parRun() ? 1 : 0) {
    const auto rest = io::control_polygons<Dim>(io::cage_polygons(evaluator_.cage()));
    for (const auto& pose : poses) {
      const auto file = in_case(mesh, pose.file);
      displacements_.push_back(io::read_pose<Dim>(file, rest, "the cage of the binding") -
                               evaluator_.cage().points);
    }
    place(points);
    const auto is_cut = fix_cuts(mesh, points, poses);
    if (joint) slow_down(*joint, is_cut);
  }

  // \param part  in [0, 1], between the poses `pose` and `pose` + 1
  void add_to(Foam::pointField& points, std::size_t pose, double part) const {
    PointList<Dim> shifts = displacements_[pose];
    if (part > 0) shifts += part * (displacements_[pose + 1] - displacements_[pose]);
    const auto moved = evaluator_.displace(placement_, evaluator_.pose(shifts));
    for (std::size_t k = 0; k < near_.size(); ++k) {
      const double factor = factors_.empty() ? 1 : factors_[k];
      Eigen::Map<Vector<Dim>>(points[near_[k]].v_) +=
          factor * moved.col(static_cast<Eigen::Index>(k));
    }
  }

 private:
  void place(const Foam::pointField& points) {
    const Foam::clockTime watch;
    const auto& cage = evaluator_.cage().points;
    const double margin = kBoundaryTolerance * bounding_box_diagonal(cage);
    const Vector<Dim> low = cage.rowwise().minCoeff().array() - margin;
    const Vector<Dim> high = cage.rowwise().maxCoeff().array() + margin;
    forAll(points, p) {
      const auto point = to_vector<Dim>(points[p]);
      if (point == point.cwiseMax(low).cwiseMin(high)) near_.push_back(p);
    }
    PointList<Dim> candidates(Dim, static_cast<Eigen::Index>(near_.size()));
    for (std::size_t k = 0; k < near_.size(); ++k) {
      candidates.col(static_cast<Eigen::Index>(k)) = to_vector<Dim>(points[near_[k]]);
    }
    placement_ = evaluator_.place(candidates);
    const auto count = static_cast<Foam::label>(near_.size() - placement_.outside.size());
    const auto seconds = of_slowest_rank(watch);
    Foam::Info << "cage: " << Foam::returnReduce(count, Foam::sumOp<Foam::label>())
               << " points are inside, placed in " << seconds << " s" << Foam::endl;
  }

  // Where facets cut through the mesh, their control points must not move, because the points
  // outside do not. \return whether each control point is one of these
  Foam::labelList fix_cuts(const Foam::polyMesh& mesh, const Foam::pointField& points,
                           const std::vector<TimedPose>& poses) {
    const auto& cage = evaluator_.cage();
    std::vector<bool> is_still(static_cast<std::size_t>(points.size()), true);
    for (const auto p : near_) is_still[static_cast<std::size_t>(p)] = false;
    for (const auto& point : placement_.outside) {
      is_still[static_cast<std::size_t>(near_[point.point])] = true;
    }
    EdgeList edges;
    for (const auto& edge : mesh.edges()) {
      const auto from = static_cast<Index>(edge.start()), to = static_cast<Index>(edge.end());
      if (is_still[from] != is_still[to]) edges.ends.push_back({from, to});
    }
    PointList<Dim> places(Dim, points.size());
    forAll(points, p) places.col(p) = to_vector<Dim>(points[p]);
    Foam::labelList is_cut(cage.size(), 0);
    for (const Index i : control_points_at(cage, find_crossings(cage, places, is_still, edges))) {
      is_cut[i] = 1;
    }
    Foam::Pstream::listCombineGather(is_cut, Foam::maxEqOp<Foam::label>());
    Foam::Pstream::listCombineScatter(is_cut);
    const double size = bounding_box_diagonal(cage.points);
    for (std::size_t k = 0; k < poses.size(); ++k) {
      for (Index i = 0; i < cage.size(); ++i) {
        if (is_cut[i] == 0) continue;
        const double length = displacements_[k].col(i).norm();
        if (length > kFixed * size) {
          throw InputError(
              poses[k].file + ": control point " + std::to_string(i) + " moves by " +
              std::to_string(length) +
              ", but its facets cut through the mesh; keep it where it is in the cage, "
              "or enlarge the cage so that these facets are outside the mesh");
        }
        displacements_[k].col(i).setZero();
      }
    }
    return is_cut;
  }

  // The displacement ends smoothly at these facets (Binding::joined()).
  void slow_down(const Joint& joint, const Foam::labelList& is_cut) {
    PointList<Dim> may_move = PointList<Dim>::Zero(Dim, evaluator_.cage().size());
    for (Index i = 0; i < evaluator_.cage().size(); ++i) may_move(0, i) = is_cut[i] == 0 ? 1 : 0;
    const auto masses = evaluator_.displace(placement_, evaluator_.pose(may_move));
    for (Eigen::Index k = 0; k < masses.cols(); ++k) {
      factors_.push_back(joint.factor(std::max(0.0, masses(0, k))));
    }
  }

  Evaluator<Dim> evaluator_;
  std::vector<PointList<Dim>> displacements_;  // of the control points in each pose
  std::vector<Foam::label> near_;              // points in the bounding box of the cage
  Placement<Dim> placement_;                   // of these; those outside do not move
  std::vector<double> factors_;                // of their displacements; empty: 1
};

}  // namespace

CageDeformer::CageDeformer(const Foam::polyMesh& mesh, const Foam::pointField& points,
                           const Foam::dictionary& dict, std::vector<TimedPose> poses)
    : mesh_(mesh),
      rest_(points),
      poses_(std::move(poses)),
      is_fixed_(points_of_patches(mesh, dict)) {
  try {
    if (poses_.empty()) throw InputError("there are no poses");
    for (std::size_t k = 1; k < poses_.size(); ++k) {
      if (poses_[k].time > poses_[k - 1].time) continue;
      throw InputError("the times of poses must ascend");
    }
    const auto file = in_case(mesh, dict.get<Foam::fileName>("binding"));
    auto binding = io::read_binding(file);
    std::optional<Joint> joint;
    if (dict.found("joint")) {
      joint = parse_joint(dict.get<Foam::word>("joint"));
      joint->mass = dict.lookupOrDefault<Foam::scalar>("jointMass", joint->mass);
      if (!(joint->mass > 0 && joint->mass <= 1)) {
        throw InputError("jointMass must be above 0 and at most 1");
      }
    }
    std::visit(
        [&](auto& of_dimension) {
          require_domain(of_dimension, file);
          validate(of_dimension.cage);
          constexpr int kDim = std::decay_t<decltype(of_dimension.points)>::RowsAtCompileTime;
          add_to_ = [motion = std::make_shared<const Motion<kDim>>(
                         mesh, points, std::move(of_dimension), poses_, joint)](
                        Foam::pointField& moved, std::size_t pose, double part) {
            motion->add_to(moved, pose, part);
          };
        },
        binding);
  } catch (const std::exception& error) {
    FatalIOErrorInFunction(dict) << error.what() << Foam::exit(Foam::FatalIOError);
  }
}

Foam::tmp<Foam::pointField> CageDeformer::positions(Foam::scalar time) const {
  std::size_t pose = 0;
  while (pose + 1 < poses_.size() && poses_[pose + 1].time <= time) ++pose;
  double part = 0;
  if (pose + 1 < poses_.size() && time > poses_[pose].time) {
    part = (time - poses_[pose].time) / (poses_[pose + 1].time - poses_[pose].time);
  }
  const Foam::clockTime watch;
  auto result = Foam::tmp<Foam::pointField>::New(rest_);
  auto& points = result.ref();
  add_to_(points, pose, part);
  forAll(points, p) {
    if (is_fixed_[p]) points[p] = rest_[p];
  }
  const auto seconds = of_slowest_rank(watch);
  Foam::Info << "cage: points moved in " << seconds << " s" << Foam::endl;
  check_quality(points, time);
  return result;
}

void CageDeformer::check_quality(const Foam::pointField& points, Foam::scalar time) const {
  using namespace Foam;
  polyMeshGeometry geometry(mesh_);
  geometry.correct(points, identity(mesh_.nFaces()));
  // Pyramids over the faces detect inverted cells of any shape.
  scalarField owner_pyramids, neighbour_pyramids;
  primitiveMeshTools::facePyramidVolume(mesh_, points, geometry.cellCentres(), owner_pyramids,
                                        neighbour_pyramids);
  label inverted = -1;
  const auto note = [&](label cell) {
    if (inverted < 0 || cell < inverted) inverted = cell;
  };
  forAll(owner_pyramids, f) {
    if (owner_pyramids[f] <= 0) note(mesh_.faceOwner()[f]);
    if (f < mesh_.nInternalFaces() && neighbour_pyramids[f] <= 0) note(mesh_.faceNeighbour()[f]);
  }
  const auto least_volume = gMin(geometry.cellVolumes());
  const auto cosine = gMin(
      primitiveMeshTools::faceOrthogonality(mesh_, geometry.faceAreas(), geometry.cellCentres())());
  const auto skewness = gMax(primitiveMeshTools::faceSkewness(
      mesh_, points, geometry.faceCentres(), geometry.faceAreas(), geometry.cellCentres())());
  Info << "cage: time " << time << ", largest displacement " << gMax(mag(points - rest_)())
       << ", smallest cell volume " << least_volume << ", largest non-orthogonality "
       << radToDeg(std::acos(std::max(-1.0, std::min(1.0, cosine))))
       << " degrees, largest skewness " << skewness << endl;
  const label rank = inverted < 0 ? Pstream::nProcs() : Pstream::myProcNo();
  const label first_rank = returnReduce(rank, minOp<label>());
  if (first_rank == Pstream::nProcs()) return;
  if (rank == first_rank) {
    std::size_t pose = 0;
    while (pose + 1 < poses_.size() && poses_[pose].time < time) ++pose;
    FatalErrorInFunction << "the morph inverts cells; the first is cell " << inverted << " at "
                         << geometry.cellCentres()[inverted] << " of processor " << first_rank
                         << ", at time " << time << ", on the way to pose " << poses_[pose].file
                         << "; the mesh was not moved" << exit(FatalError);
  }
  label wait = 0;
  reduce(wait, sumOp<label>());  // until the first rank ends the run
}

}  // namespace flbc::foam
