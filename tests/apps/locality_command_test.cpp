// SPDX-License-Identifier: BSD-3-Clause
// --locality, --symmetric, and flbc compose as their users see them.
#include "flbc/io/mesh_io.h"
#include "flbc/quality.h"
#include "support/command_line.h"
#include "support/new_glb.h"

namespace flbc::testing {
namespace {

using LocalityCommand = CommandLineTest;

TEST_F(LocalityCommand, ConflictsAreRelaxed) {
  file("masks.json", R"({"masks": [{"control_points": {"box": [[-99, -99, -99], [99, 99, 99]]},
                                    "region": [0, 5, 9]}], "conflicts": "relax"})");
  const std::string of_model = "3d/limb_cage.obj --model 3d/limb_model.obj --locality masks.json";
  expect("solve " + of_model + " --vertices 1500 -o w.npy --report report.json", 0,
         "masks.json: removed control points ");
  const auto freed = json_in("report.json")["locality"]["freed"].get<std::set<Index>>();
  const auto weights = io::read_weights("w.npy").dense();
  EXPECT_GE(freed.size(), 4U);  // each vertex needs four at most
  EXPECT_LE(freed.size(), 12U);
  for (const Index p : {0, 5, 9}) {
    for (Index i = 0; i < weights.rows(); ++i) {
      EXPECT_TRUE(freed.count(i) > 0 || weights(i, p) == 0) << p << ' ' << i;
    }
  }
}

TEST_F(LocalityCommand, ReachIsAFactorOfPhi) {
  const std::string path = "2d/figure_cage.obj";
  expect("solve " + path + " --vertices 1500 --save-domain domain.obj -q -o w.npy");
  const auto solve = "solve " + path + " --domain domain.obj --distances exact --certify -q -o ";
  expect(solve + "free.npy");
  const auto domain = io::read_domain<2>("domain.obj");
  const auto cage = std::get<Cage<2>>(io::to_cage(io::read_polygons(path), path));
  auto problem = make_problem(cage, domain, DistanceScheme::kSquare, 0.003);
  const Eigen::MatrixXd phi = problem.phi.dense();
  const auto free = io::read_weights("free.npy");
  double before = 0;  // the mean weight for a smaller reach
  for (const double factor : {0.25, 1.0, 4.0}) {
    file("reach.json",
         R"({"reach": [{"control_points": [3, 7], "factor": )" + std::to_string(factor) + "}]}");
    expect(solve + "w.npy --locality reach.json --report report.json");
    const auto weights = io::read_weights("w.npy");
    const double mean = (weights.dense().row(3) + weights.dense().row(7)).mean();
    EXPECT_GT(mean, 1.02 * before) << factor;
    before = mean;
    EXPECT_EQ(slurp("w.npy") == slurp("free.npy"), factor == 1) << factor;
    // Each is optimal for its own phi, which a proof confirms.
    Eigen::MatrixXd scaled = phi;
    for (const Index i : {3, 7}) scaled.row(i) /= factor;
    problem.phi = WeightFunctions(scaled);
    const double own = objective(problem, weights), other = objective(problem, free);
    EXPECT_LE(own, other) << factor;
    const auto report = json_in("report.json");
    EXPECT_NEAR(report["certified_objective"].get<double>() * problem.scale, own, 1e-6 * own);
    EXPECT_LE(report["lower_bound"].get<double>() * problem.scale, own);
    EXPECT_LT(report["relative_gap"], 0.1);
  }
}

// A solid region of the model moves by one affine map through all commands.
TEST_F(LocalityCommand, SolidRegionsStaySolidInTheFile) {
  file("solid.json", R"({"solid": [{"region": {"vertices": [0, 1, 2, 3, 4, 5, 6, 7]}}]})");
  expect(
      "solve 3d/limb_cage.obj --model 3d/limb_model.obj --locality solid.json --vertices 1500 "
      "-o b.npz",
      0, "solid.json: 8 vertices are solid (regions: 1), so a certificate does not hold");
  for (const std::string k : {"8", "4"}) {
    expect("sparsify b.npz -k " + k + " -o few.npz -q");
    const auto weights = io::read_weights("few.npz").dense().leftCols(8).eval();
    const auto points = io::to_points<3>(io::read_polygons("3d/limb_model.obj"), "model");
    Eigen::MatrixXd places(8, 4);
    places << points.leftCols(8).transpose(), Eigen::VectorXd::Ones(8);
    const Eigen::MatrixXd rows = weights.transpose();
    EXPECT_LT((rows - places * least_squares(places, rows)).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_GE(weights.minCoeff(), 0);
  }
  expect("export 3d/limb_model.obj --weights b.npz --rigid -o rigid.glb", 0,
         "rigid regions instead of affine ones");
  EXPECT_NE(slurp("rigid.glb").find("\"solid_0\""), std::string::npos);
  expect("solve 3d/limb_cage.obj --model 3d/limb_model.obj --vertices 1500 -q -o free.npz");
  expect("export 3d/limb_model.obj --weights free.npz --rigid -o rigid.glb", 2,
         "3d/limb_model.obj: no region is solid, so none can be rigid");
  const auto refused = [&](const std::string& content, const std::string& words) {
    expect("solve 3d/limb_cage.obj --model 3d/limb_model.obj -o w.npy --locality " +
               file("bad.json", content),
           2, words);
  };
  refused(R"({"solid": [{"region": [0]}, {"regoin": [1]}]})", "unknown key \"regoin\"");
  refused(R"({"solid": [{}]})", "bad.json: solid region 0: give a region");
  refused(R"({"solid": {"region": [0]}})", "bad.json: solid is not a list");
  refused(R"({"solid": [{"region": {"box": [[9, 9, 9], [9, 9, 9]]}}]})", "no vertices are chosen");
  refused(R"({"solid": [{"region": {"box": [[-9, -9, -9], [9, 9, 9]]}}]})",
          "bad.json: solid region 0 of ");
}

TEST_F(LocalityCommand, DefectiveFilesAreRefused) {
  const auto refused = [&](const std::string& content, const std::string& words) {
    expect("solve 3d/limb_cage.obj --model 3d/limb_model.obj -o w.npy --locality " +
               file("bad.json", content),
           2, words);
  };
  refused(R"([{"control_points": [0]}])", "bad.json: mask 0: not a list of masks");
  refused(R"([{"control_points": [0], "region": [-1]}])", "mask 0: -1 is not an index");
  refused(R"([{"control_points": [0], "region": {"vertices": [22.9]}}])", "22.9 is not an index");
  refused(R"([{"control_points": [4294967298], "region": [0]}])", "4294967298 is not an index");
  refused(R"([{"control_points": [0], "region": [99999]}])", "mask 0 names vertex 99999");
  refused(R"([{"control_points": [0], "region": {"group": "arm"}}])",
          "group \"arm\" is not in 3d/limb_model.obj; it has no groups");
  refused(R"([{"control_points": [0], "region": {"box": [[0], [1]]}}])",
          "a box needs corners of 3");
  refused(R"([{"control_points": [], "region": [0]}])", "no control points or no vertices");
  refused(R"([{"control_points": [0], "region": [0]}, {"control_points": [0], "regoin": [0]}])",
          "mask 1: unknown key \"regoin\"");
  refused(R"([{"control_points": [0], "region": {"verts": [0]}}])",
          "unknown key \"verts\"; choose from attribute");
  refused(R"([{"control_points": [0], "region": {"vertices": [0], "group": "arm"}}])",
          "give one choice");
  refused(R"([{"control_points": [0], "region": {"vertices": {"a": 1}}}])",
          "not a list of indices such as [0, 1]");
  refused(R"({"masks": 3})", "masks is not a list such as [{\"control_points\": [3]");
  refused(R"({"masks": [], "conflicts": "no"})", "invalid value \"no\"; choose from fail");
  refused(R"({"mask": []})", "unknown key \"mask\"; choose from conflicts");
  refused(R"({"masks": [], "falloff": "wide"})", "falloff is not a number");
  refused(R"({"masks": [], "falloff": -0.1})", "falloff must be in [0, 1], as a part of cage size");
  refused(R"({"reach": [{"control_points": [0], "factor": 17}]})",
          "control point 0 must be in [1/16, 16]");
  refused(R"({"reach": [{"control_points": [99], "factor": 2}]})", "no control point 99");
  refused(R"({"reach": [{"control_points": [0], "factor": 2, "region": [0]}]})",
          "unknown key \"region\"");
  refused(R"({"reach": [{"control_points": [0], "factor": "2"}]})", "reach 0: give control_points");
  refused(R"({"reach": {"a": 1}})",
          "reach is not a list such as [{\"control_points\": [3], \"factor\": 2}]");
  refused(R"({"reach": [{"control_points": {"box": [[8, 8, 8], [9, 9, 9]]}, "factor": 2}]})",
          "reach 0: no control");
}

TEST_F(LocalityCommand, GroupsOfAnObjModelAreRegions) {
  const auto cage = points_in<2>("2d/figure_cage.obj");
  const double x = cage.row(0).mean(), y = cage.row(1).mean();
  const auto at = [](double px, double py) {
    return "v " + std::to_string(px) + ' ' + std::to_string(py) + " 0\n";
  };
  const double step = 0.01 * (cage.row(0).maxCoeff() - cage.row(0).minCoeff());
  file("model.obj", at(x, y) + at(x + step, y) + at(x, y + step) + "g body\nf 1 2 3\n" +
                        at(x + step, y + step) + "g belt other # 1\nf -1 \\\n-3 -2 # not 1\n");
  file("masks.json", R"([{"control_points": [0], "region": {"group": "belt"}}])");
  expect(
      "solve 2d/figure_cage.obj --model model.obj -o w.npy --vertices 500 -q "
      "--locality masks.json");
  const auto weights = io::read_weights("w.npy").dense();
  for (const Index p : {1, 2, 3}) EXPECT_EQ(weights(0, p), 0);
  file("masks.json", R"([{"control_points": [0], "region": {"group": "blet"}}])");
  expect("solve 2d/figure_cage.obj --model model.obj -o w.npy --locality masks.json", 2,
         "masks.json: mask 0: group \"blet\" is not in model.obj; it has belt, body, other");
}

TEST_F(LocalityCommand, AttributesOfPlyAndGltfModelsAreRegions) {
  const auto mask = [](const std::string& attribute) {
    file("masks.json",
         R"([{"control_points": [0], "region": {"attribute": ")" + attribute + "\"}}]");
  };
  const auto expect_zeros = [&](const std::string& model, const std::vector<Index>& region) {
    expect("solve cage.obj --model " + model +
           " --vertices 800 -o weights.npy -q --locality masks.json");
    const auto weights = io::read_weights("weights.npy").dense();
    for (Index p = 0; p < weights.cols(); ++p) {
      const bool is_in = std::count(region.begin(), region.end(), p) > 0;
      EXPECT_EQ(weights(0, p) == 0, is_in) << model << ' ' << p;
    }
  };
  // All vertices are near the first control point, and inside the hull of the others.
  file("cage.obj",
       "v 0 0 -1.1\nv -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\n"
       "v -1 1 1\nf 1 3 2\nf 1 4 3\nf 1 5 4\nf 1 2 5\nf 6 7 8\nf 6 8 9\nf 2 3 7\nf 2 7 6\nf 3 4 8\n"
       "f 3 8 7\nf 4 5 9\nf 4 9 8\nf 5 2 6\nf 5 6 9\n");
  file("model.ply",
       "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
       "property float z\nproperty uchar belt\nelement face 1\n"
       "property list uchar int vertex_indices\nend_header\n"
       "-0.5 0 -0.95 1\n0.5 0 -0.95 0\n0 -0.5 -0.95 1\n0 0.5 -0.95 0\n4 0 2 1 3\n");
  mask("belt");
  expect_zeros("model.ply", {0, 2});

  // Vertices 2 and 3 of the file are at one place.
  NewGlb gltf(R"({"meshes":[{"primitives":[{"mode":6}]}],"nodes":[{"mesh":0}]})");
  gltf.primitive(0)["attributes"] = {
      {"POSITION",
       gltf.add<float>(Eigen::MatrixXd{
           {-0.5, 0.5, 0, 0, 0}, {0, 0, -0.5, -0.5, 0.5}, {-0.95, -0.95, -0.95, -0.95, -0.95}})},
      {"_BELT", gltf.add<float>(Eigen::RowVectorXd{{0, 0, 1, 0, 0}})}};
  file("model.glb", gltf.glb());
  mask("_BELT");
  expect_zeros("model.glb", {2});
  mask("_HEAD");
  expect("solve cage.obj --model model.glb -o w.npy --locality masks.json", 2,
         "model.glb: the vertices have no attribute \"_HEAD\"");
  expect("solve cage.obj --model cage.obj -o w.npy --locality masks.json", 2,
         "only .ply, .glb, and .gltf models have attributes");
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
