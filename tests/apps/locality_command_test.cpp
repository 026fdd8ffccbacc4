// SPDX-License-Identifier: BSD-3-Clause
// --locality, --symmetric, and flbc compose as their users see them.
#include "support/command_line.h"

namespace flbc::testing {
namespace {

class LocalityCommand : public CommandLineTest {
 protected:
  // Control points at one end of the limb must not move the other end.
  std::string locality(double from, double to) const {
    return file("locality.json", "[{\"control_points\": {\"box\": [[" + std::to_string(from) +
                                     ", -99, -99], [99, 99, 99]]}, \"region\": {\"box\": [[-99, "
                                     "-99, -99], [" +
                                     std::to_string(to) + ", 99, 99]]}}]");
  }
  // \return the number of pairs
  static int expect_obeyed(const std::string& weights_file, double from, double to) {
    const auto cage = points_in<3>("3d/limb_cage.obj"), model = points_in<3>("3d/limb_model.obj");
    const auto weights = io::read_weights(weights_file).dense();
    int pairs = 0;
    for (Index p = 0; p < model.cols(); ++p) {
      for (Index i = 0; i < cage.cols(); ++i) {
        if (model(0, p) > to || cage(0, i) < from) continue;
        EXPECT_EQ(weights(i, p), 0) << p << ' ' << i;
        ++pairs;
      }
    }
    return pairs;
  }
};

TEST_F(LocalityCommand, EveryStepKeepsExactZeros) {
  const auto cage = points_in<3>("3d/limb_cage.obj");
  const double low = cage.row(0).minCoeff(), size = cage.row(0).maxCoeff() - low;
  const double from = low + 0.6 * size, to = low + 0.4 * size;
  const auto masks = " --locality " + locality(from, to);
  expect("run 3d/limb_cage.obj 3d/limb_model.obj -o out --vertices 3000 -q" + masks);
  EXPECT_GT(expect_obeyed("out/weights.npy", from, to), 100);
  expect_obeyed("out/sparse_weights.mtx", from, to);
  const auto report = json_in("out/report.json");
  EXPECT_GT(report["solve"]["locality"]["masked_vertices"], 10);
  const std::string of_cage = " --cage 3d/limb_cage.obj";
  expect("sparsify out/weights.npy" + of_cage + " --points 3d/limb_model.obj -k 4 -o four.npy -q" +
         masks);
  expect_obeyed("four.npy", from, to);
  expect("transfer out/weights.npy" + of_cage +
         " --from 3d/limb_model.obj --to 3d/limb_model.obj -o again.npy -q" + masks);
  expect_obeyed("again.npy", from, to);
  expect("transfer out/domain_weights.npy --domain out/domain.mesh" + of_cage +
         " --to 3d/limb_model.obj -o placed.npy -q" + masks);
  expect_obeyed("placed.npy", from, to);
  expect("export 3d/limb_model.obj --weights out/weights.npy -k 4 -o limb.glb" + of_cage + masks);
}

TEST_F(LocalityCommand, ConflictsAreNamedAndTheAdviceWorks) {
  const auto cage = points_in<3>("3d/limb_cage.obj");
  std::string all;
  for (Index i = 0; i < cage.cols(); ++i) all += (i > 0 ? ", " : "") + std::to_string(i);
  const auto solve = [&](const std::string& control_points) {
    file("masks.json",
         "[{\"control_points\": [" + control_points + "], \"region\": {\"vertices\": [0, 5, 9]}}]");
    return run(
        "solve 3d/limb_cage.obj --model 3d/limb_model.obj --vertices 1500 -o w.npy -q "
        "--locality masks.json");
  };
  const auto refused = solve(all);
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.errors.find("all are masked"), std::string::npos) << refused.errors;
  const std::string before = "remove control points ";
  const auto at = refused.errors.find(before);
  ASSERT_NE(at, std::string::npos) << refused.errors;
  std::istringstream advice(refused.errors.substr(at + before.size()));
  std::set<Index> freed;
  for (Index i; advice >> i; advice.ignore(1)) freed.insert(i);
  std::string rest;
  for (Index i = 0; i < cage.cols(); ++i) {
    if (freed.count(i) == 0) rest += (rest.empty() ? "" : ", ") + std::to_string(i);
  }
  EXPECT_EQ(solve(rest).status, 0);
}

TEST_F(LocalityCommand, DefectiveFilesAreRefused) {
  const auto refused = [&](const std::string& content, const std::string& words) {
    file("bad.json", content);
    expect("solve 3d/limb_cage.obj --model 3d/limb_model.obj -o w.npy --locality bad.json", 2,
           words);
  };
  refused("[{\"control_points\": [0]}]", "bad.json: entry 0: not a list of masks");
  refused("[{\"control_points\": [0], \"region\": [-1]}]", "mask 0 names vertex -1");
  refused("[{\"control_points\": [0], \"region\": {\"group\": \"arm\"}}]",
          "group \"arm\" is not in");
  refused("[{\"control_points\": [0], \"region\": {\"box\": [[0], [1]]}}]",
          "a box needs corners of 3");
  refused("[{\"control_points\": [], \"region\": [0]}]", "no control points or no vertices");
  refused(
      "[{\"control_points\": [0], \"region\": [0]}, {\"control_points\": [0], \"regoin\": [0]}]",
      "entry 1: unknown key \"regoin\"; choose from control_points, region");
  refused("[{\"control_points\": [0], \"region\": {\"vertexes\": [0]}}]",
          "unknown key \"vertexes\"; choose from box, group, vertices");
  refused("[{\"control_points\": [0], \"region\": {\"vertices\": [0], \"group\": \"arm\"}}]",
          "give one choice");
  expect("solve 3d/limb_cage.obj -o w.npy --method gradient --locality bad.json", 1,
         "--locality: the method gradient does not use it");
}

TEST_F(LocalityCommand, GroupsOfAnObjModelAreRegions) {
  const auto cage = points_in<2>("2d/figure_cage.obj");
  const double x = cage.row(0).mean(), y = cage.row(1).mean();
  const auto at = [](double px, double py) {
    return "v " + std::to_string(px) + ' ' + std::to_string(py) + " 0\n";
  };
  const double step = 0.01 * (cage.row(0).maxCoeff() - cage.row(0).minCoeff());
  file("model.obj", at(x, y) + at(x + step, y) + at(x, y + step) + "g body\nf 1 2 3\n" +
                        at(x + step, y + step) + "g belt other\nf -1 -3 -2\n");
  file("masks.json", "[{\"control_points\": [0], \"region\": {\"group\": \"belt\"}}]");
  expect(
      "solve 2d/figure_cage.obj --model model.obj -o w.npy --vertices 500 -q "
      "--locality masks.json");
  const auto weights = io::read_weights("w.npy").dense();
  for (const Index p : {1, 2, 3}) EXPECT_EQ(weights(0, p), 0);
}

TEST_F(LocalityCommand, MirroredVerticesAreAlike) {
  expect("cage 3d/star_model.obj --control-points 60 --symmetric x -o cage.obj");
  const auto soup = io::read_polygons("cage.obj");
  std::string text;  // a model with both sides: the cage, smaller
  const auto points = points_in<3>("cage.obj");
  const Vector<3> center = (points.rowwise().minCoeff() + points.rowwise().maxCoeff()) / 2;
  for (Index p = 0; p < points.cols(); ++p) {
    const Vector<3> x = center + 0.4 * (points.col(p) - center);
    char line[100];
    std::snprintf(line, sizeof line, "v %.17g %.17g %.17g\n", x[0], x[1], x[2]);
    text += line;
  }
  for (const auto& face : soup.polygons) {
    text += "f";
    for (const Index v : face) text += ' ' + std::to_string(v + 1);
    text += '\n';
  }
  file("small.obj", text);
  const std::string command = "run cage.obj small.obj --vertices 2000 -q -o ";
  expect(command + "mirrored --symmetric x");
  expect(command + "free");
  const auto mirrored = points_in<3>("small.obj");
  std::vector<Index> image;
  for (Index p = 0; p < mirrored.cols(); ++p) {
    Vector<3> x = mirrored.col(p);
    x[0] = 2 * center[0] - x[0];
    Eigen::Index nearest;
    (mirrored.colwise() - x).colwise().norm().minCoeff(&nearest);
    image.push_back(static_cast<Index>(nearest));
  }
  for (const std::string name : {"weights.npy", "sparse_weights.mtx"}) {
    const auto weights = io::read_weights("mirrored/" + name).dense();
    for (Index p = 0; p < weights.cols(); ++p) {
      for (Index i = 0; i < weights.rows(); ++i) {
        ASSERT_EQ(weights(i, p), weights(image[i], image[p])) << name << ' ' << p << ' ' << i;
      }
    }
  }
  EXPECT_NE(slurp("mirrored/weights.npy"), slurp("free/weights.npy"));
  expect("run cage.obj -q -o out --symmetric x", 1, "--symmetric: no model is given");
}

TEST_F(LocalityCommand, ComposeMultipliesWeights) {
  file("w.csv", "0.5,0.5\n1,0\n");
  file("map.csv", "0.25,0.75,0\n0,0,1\n");
  expect("compose w.csv map.csv -o out.npy", 0, "2 vertices, 3 control points");
  const auto composed = io::read_weights("out.npy").dense();
  EXPECT_EQ(composed.col(0), Vector<3>(0.125, 0.375, 0.5));
  file("map.csv", "0.25,0.25,0\n0,0,1\n");
  expect("compose w.csv map.csv -o out.npy", 2, "map.csv: the weights of control point 0");
}

}  // namespace
}  // namespace flbc::testing
