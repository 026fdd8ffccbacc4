// SPDX-License-Identifier: BSD-3-Clause
// flbc sparsify as its users and their scripts see it.
#include "flbc/io/mesh_io.h"
#include "flbc/sparsify.h"
#include "flbc/sparsify_error.h"
#include "support/command_line.h"
#include "support/model_cages.h"

namespace flbc::testing {
namespace {

using Json = nlohmann::json;

class SparsifyCommand : public CommandLineTest {
 protected:
  void expect_refusal(const std::string& arguments, int status, const std::string& errors) const {
    expect_refused("sparsify " + arguments + " -o out.mtx", status, errors);
  }

  // A square with a model in it and weights that reproduce it.
  std::string square() const {
    file("cage.obj", "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nl 1 2 3 4 1\n");
    file("model.obj", "v 2 2 0\nv 1 2 0\n");
    file("w.csv", "0.25,0.25,0.25,0.25\n0.375,0.125,0.125,0.375\n");
    return "w.csv --cage cage.obj --points model.obj";
  }
};

template <int Dim>
void expect_sparse(const std::string& cage_file, const PointList<Dim>& points,
                   const std::string& before_file, const std::string& after_file, int most,
                   const Json& report) {
  const auto before = io::read_weights(before_file).dense();
  const auto after = io::read_weights(after_file).dense();
  const auto quality = measure_quality<Dim>(points_in<Dim>(cage_file), points, after);
  EXPECT_GE(quality.min_weight, 0);
  EXPECT_LE(quality.max_partition_error, 1e-13);
  EXPECT_LE(quality.max_reproduction_error, 1e-13);
  EXPECT_EQ((after.array() != 0).colwise().count().maxCoeff(), most);
  EXPECT_EQ(report["dim"], Dim);
  EXPECT_EQ(report["points"], points.cols());
  EXPECT_EQ(report["options"]["max_influences"], most);
  EXPECT_EQ(report["after"]["max_nonzeros"], most);
  // Influences are counted as flbc check and flbc solve count them.
  EXPECT_NEAR(report["before"]["mean_influences"].get<double>(),
              measure_quality<Dim>(points_in<Dim>(cage_file), points, before).mean_influences,
              1e-12);
  EXPECT_EQ(report["before"]["bytes"], std::filesystem::file_size(before_file));
  EXPECT_EQ(report["after"]["bytes"], std::filesystem::file_size(after_file));
  EXPECT_LT(report["after"]["bytes"], report["before"]["bytes"]);
  EXPECT_NEAR(report["error"]["weight"]["max"].get<double>(),
              (after - before).cwiseAbs().maxCoeff(), 1e-15);
  const auto& deformation = report["error"]["deformation"];
  EXPECT_GT(deformation["independent"]["rms"], 0);
  EXPECT_LT(deformation["smooth"]["rms"], 0.01);
  // In its rest pose nothing moves, since both reproduce.
  EXPECT_LT(deformation["poses"][0]["max"], 1e-12);
  EXPECT_EQ(deformation["poses"][0]["file"], cage_file);
}

TEST_F(SparsifyCommand, ModelsIn2DAnd3D) {
  const auto sparsify = [&](const std::string& name, const std::string& domain_file, int most) {
    SCOPED_TRACE(name);
    solve(name, domain_file);
    const auto cage = name + "_cage.obj", model = name + "_model.obj";
    const auto result =
        expect("sparsify w.npy --cage " + cage + " --points " + model + " -k " +
                   std::to_string(most) + " -o s.mtx --report s.json --pose " + cage,
               0, "at most " + std::to_string(most));
    EXPECT_EQ(result.output, "");
    // And on the mesh of the interior.
    EXPECT_EQ(run("sparsify v.npy --cage " + cage + " --points " + domain_file + " -k " +
                  std::to_string(most) + " -q -o d.npy")
                  .errors,
              "");
    expect("check " + cage + " --weights d.npy --domain " + domain_file);
  };
  sparsify("2d/ring", "ring.off", 5);
  expect_sparse<2>("2d/ring_cage.obj", points_in<2>("2d/ring_model.obj"), "w.npy", "s.mtx", 5,
                   json_in("s.json"));
  sparsify("3d/limb", "limb.mesh", 6);
  expect_sparse<3>("3d/limb_cage.obj", points_in<3>("3d/limb_model.obj"), "w.npy", "s.mtx", 6,
                   json_in("s.json"));
}

// With a pose the weights are chosen for it.
TEST_F(SparsifyCommand, PoissonMakesTheErrorSmallInThePosesGiven) {
  solve("2d/ring", "ring.off");
  auto pose = io::read_polygons("2d/ring_cage.obj");
  for (std::size_t i = 0; i < pose.points.size(); i += 3) pose.points[i] *= 1.3;
  io::write_model("pose.obj", {pose});
  const std::string arguments =
      "sparsify v.npy --cage 2d/ring_cage.obj --points ring.off -k 3 -q --reduction poisson "
      "-o ";
  expect(arguments + "without.npy");
  expect(arguments + "with.npy --pose pose.obj --report r.json");
  const auto before = io::read_weights("v.npy").dense();
  const auto points = io::to_points<2>(pose, "pose.obj");
  const auto domain = io::read_domain<2>("ring.off");
  const auto error = [&](const std::string& name) {
    return edge_error<2>(domain.points, edges_of_cells(domain), {points}, before,
                         io::read_weights(name).dense());
  };
  EXPECT_LT(error("with.npy").rms, 0.9 * error("without.npy").rms);
  const auto poses = json_in("r.json")["error"]["edge"]["poses"];
  ASSERT_EQ(poses.size(), 1);
  EXPECT_EQ(poses[0]["file"], "pose.obj");
  EXPECT_NEAR(poses[0]["rms"].get<double>(), error("with.npy").rms, 1e-12);
  EXPECT_NEAR(poses[0]["max"].get<double>(), error("with.npy").max, 1e-12);
}

TEST_F(SparsifyCommand, PoissonNeedsNeighbours) {
  const auto arguments = square();
  expect_refusal(arguments + " -k 3 --reduction poisson", 2,
                 "model.obj: has no faces and no lines");
  expect_refusal(arguments + " -k 3 --reduction cubic", 1, "choose from auto|poisson|quadratic");
  // Without neighbors there are no edges to measure.
  expect("sparsify " + arguments + " -k 3 -q -o s.npy --report r.json");
  const auto report = json_in("r.json");
  EXPECT_EQ(report["method"], "quadratic");
  EXPECT_FALSE(report["error"].contains("edge"));
  // A line is enough.
  file("model.obj", "v 2 2 0\nv 1 2 0\nl 1 2\n");
  EXPECT_EQ(run("sparsify " + arguments + " -k 3 -q --reduction poisson -o s.npy").errors, "");
}

TEST_F(SparsifyCommand, Thresholds) {
  const auto arguments = square();
  expect("sparsify " + arguments + " -k 3 -q -o s.mtx");
  const auto sparse = io::read_weights("s.mtx").dense();
  EXPECT_LE((sparse.array() != 0).colwise().count().maxCoeff(), 3);
  const PointList<2> points = points_in<2>("cage.obj") * sparse;
  EXPECT_LE((points - points_in<2>("model.obj")).norm(), 1e-13);
  // Nothing is below the threshold: the weights stay.
  expect("sparsify " + arguments + " --threshold 0.1 -q -o t.npy");
  const auto same = io::read_weights("t.npy").dense();
  EXPECT_EQ(same(3, 1), 0.375);
  EXPECT_EQ((same.array() != 0).count(), 8);
}

TEST_F(SparsifyCommand, RefusesWhatCannotBe) {
  const auto arguments = square();
  expect_refusal(arguments, 1, "give -k");
  expect_refusal(arguments + " -k 2", 1, "at least 3 are needed");
  expect_refusal(arguments + " -k 3 --threshold 2", 1, "threshold");
  expect_refusal(arguments + " -k 3 --pose " + file("p.obj", "v 0 0 0\n"), 2,
                 "p.obj: has 1 vertices, but");
  expect_refusal("absent.npy --cage cage.obj --points model.obj -k 3", 4, "absent.npy");
  // Rows or columns that are not there.
  expect("sparsify " + arguments + " -k 3 -q -o s.npy");
  expect_refusal("s.npy --cage cage.obj --points cage.obj -k 3", 2,
                 "s.npy: has weights of 2 points, but");
  expect_refusal("s.npy --cage 2d/ring_cage.obj --points model.obj -k 3", 2,
                 "s.npy: has weights for 4 control points, but");
  file("model.obj", "v 2 2 0\nv 5 2 0\n");
  expect_refusal(arguments + " -k 3", 2, "model.obj: point 1 at (5, 2) lies outside");
  // No result may replace what is read.
  expect("sparsify s.npy --cage cage.obj --points model.obj -k 3 -o s.npy", 1);
}

}  // namespace
}  // namespace flbc::testing
