// SPDX-License-Identifier: BSD-3-Clause
// flbc sparsify and flbc transfer as their users and their scripts see them.
#include "support/command_line.h"

namespace flbc::testing {
namespace {

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

TEST_F(SparsifyCommand, RefusesWhatCannotBe) {
  const auto arguments = square();
  expect_refusal(arguments, 1, "or --threshold is missing");
  expect_refusal(arguments + " -k 2", 1, "must be at least 3 in 2D");
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

class TransferCommand : public CommandLineTest {
 protected:
  void expect_transfer(const std::string& arguments, int status, const std::string& words) const {
    expect("transfer " + arguments, status, words);
  }
  // The model with a vertex in the middle of every face, which has three corners.
  std::string finer(const std::string& model) const {
    const auto soup = io::read_polygons(model);
    std::string text = slurp(model);
    text = text.substr(0, text.find("\nf ") + 1);
    for (const auto& face : soup.polygons) {
      Vector<3> middle = Vector<3>::Zero();
      for (const Index v : face) middle += soup.points[v] / static_cast<double>(face.size());
      text += "v " + std::to_string(middle.x()) + ' ' + std::to_string(middle.y()) + ' ' +
              std::to_string(middle.z()) + '\n';
    }
    return file("finer.obj", text + "f 1 2 3\n");
  }
};

TEST_F(TransferCommand, OtherVersionsGetWeightsFromMeshOrModel) {
  for (const std::string name : {"2d/figure", "3d/limb"}) {
    SCOPED_TRACE(name);
    const auto cage = name + "_cage.obj", model = name + "_model.obj";
    const std::string domain = name[0] == '2' ? "domain.obj" : "domain.mesh";
    const std::string solve = "solve " + cage + " --method harmonic --non-negative project -q";
    expect(solve + " --vertices 1500 -o d.npy --save-domain " + domain);
    expect(solve + " --domain " + domain + " --model " + model + " -o w.npy");
    const auto rest = " --cage " + cage + " -o t.npy --to ";
    expect_transfer("d.npy --domain " + domain + rest + model, 0, "minimum weight");
    EXPECT_EQ(slurp("t.npy"), slurp("w.npy"));
    expect_transfer("w.npy --from " + model + rest + model, 0, "away from");
    EXPECT_LT((io::read_weights("t.npy").dense() - io::read_weights("w.npy").dense())
                  .cwiseAbs()
                  .maxCoeff(),
              1e-9);
    const auto more = finer(model);
    for (const auto& from : {"w.npy --from " + model, "d.npy --domain " + domain}) {
      expect_transfer(from + rest + more, 0, "t.npy");
      expect("check " + cage + " --model " + more + " --weights t.npy");
      EXPECT_GE(io::read_weights("t.npy").dense().minCoeff(), 0);
    }
  }
}

TEST_F(TransferCommand, RefusesWithReason) {
  const auto cage = file("cage.obj", "v 0 0\nv 1 0\nv 1 1\nv 0 1\nl 1 2 3 4 1\n");
  const auto model = file("model.obj", "v 0.25 0.25 0\nv 0.5 0.25 0\nv 0.25 0.5 0\nf 1 2 3\n");
  const auto far = file("far.obj", "v 0.25 0.25 0\nv 0.5 0.4 0\nv 0.25 0.5 0\nf 1 2 3\n");
  expect("solve " + cage + " --method harmonic --vertices 200 -q --model " + model + " -o w.npy");
  const auto weights = "w.npy --cage " + cage + " -o t.npy";
  expect_transfer(weights + " --to " + far + " --from " + model, 2,
                  "far.obj: 1 of 3 vertices (1) are farther than");
  expect_transfer(weights + " --to " + far + " --from " + model + " --limit 1", 0, "away from");
  expect_transfer(weights + " --to " + far + " --from " + model + " --limit 2", 1, "--limit");
  expect_transfer(weights + " --to " + far, 1, "--from");
  expect_transfer(weights + " --to " + far + " --from " + model + " --outside nearest", 1,
                  "--outside");
  expect_transfer(weights + " --to " + far + " --from " + cage, 2, "has weights of 3 points");
}

TEST_F(TransferCommand, VerticesOutsideFollowTheNearestPointOfTheCage) {
  const auto cage = file("cage.obj", "v 0 0\nv 1 0\nv 1 1\nv 0 1\nl 1 2 3 4 1\n");
  const auto model = file("model.obj", "v 0.1 0.1 0\nv 0.9 0.1 0\nv 0.1 0.9 0\nf 1 2 3\n");
  const auto wide = file("wide.obj", "v 0.1 0.1 0\nv 1.1 0.1 0\nv 0.1 0.9 0\nf 1 2 3\n");
  expect("solve " + cage + " --method harmonic --vertices 200 -q --model " + model + " -o w.npy");
  expect_transfer(
      "w.npy --cage " + cage + " -o t.npy --to " + wide + " --from " + model + " --limit 0.5", 0,
      "they follow its nearest point at a constant offset");
}

}  // namespace
}  // namespace flbc::testing
