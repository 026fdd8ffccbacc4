// SPDX-License-Identifier: BSD-3-Clause
// flbc check as its users and their scripts see it.
#include "flbc/io/mesh_io.h"
#include "support/command_line.h"
#include "support/processor_time.h"

namespace flbc::testing {
namespace {

using Json = nlohmann::json;
using Pieces = std::vector<std::string>;

class CheckCommand : public CommandLineTest {
 protected:
  // Status and pieces of the text for people, and of that on errors.
  Ended expect_check(const std::string& arguments, int status, const Pieces& output,
                     const Pieces& errors = {}) const {
    SCOPED_TRACE(arguments);
    auto result = run("check " + arguments);
    EXPECT_EQ(result.status, status) << result.errors;
    for (const auto& piece : output) expect_piece(result.output, piece);
    for (const auto& piece : errors) expect_piece(result.errors, piece);
    EXPECT_EQ(result.errors.empty(), status == 0) << result.errors;
    return result;
  }
};

TEST_F(CheckCommand, SoundCagesWithTheirFacts) {
  expect_check(
      "2d/ring_cage.obj", 0,
      {"a sound 2D cage", "control points              22\n", "parts                       1\n",
       "holes                       1\n", "measure                     23.26"});
  expect_check("3d/torus_cage.obj", 0,
               {"a sound 3D cage", "facets                      96\n",
                "holes                       0\n", "measure                     40."});
}

TEST_F(CheckCommand, EveryDefectIsListedAndTheFirstIsTheMessage) {
  const auto cage = file("bad.obj",
                         "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 5 5 0\nv 6 6 0\n"
                         "l 1 2 3 4\n");
  expect_check(cage + " --json r.json", 2,
               {"not a cage, 4 defects", "control point 5 at (6, 6) belongs to no edge",
                "open at control point 0 at (0, 0)"},
               {"bad.obj: control point 4 at (5, 5) belongs to no edge"});
  const auto json = json_in("r.json");
  EXPECT_EQ(json["fine"], false);
  EXPECT_EQ(json["cage"]["sound"], false);
  EXPECT_EQ(json["cage"]["defects"].size(), 4);
  EXPECT_EQ(json["cage"]["defects"][1]["control_points"], Json::array({5}));

  const auto crossed = file("crossed.obj", "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nl 1 2 3 4 1\n");
  expect_check(crossed, 2, {"(0.5, 0.5)"}, {"crossed.obj: "});
  expect_check(crossed + " --model absent.obj", 2, {"were skipped"});
}

TEST_F(CheckCommand, DefectsOfPolygonsNameTheFacesOfTheFile) {
  // A cube of quadrilaterals, the last of which is turned over.
  const auto cube = file("cube.obj",
                         "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\n"
                         "v 1 1 1\nf 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\n"
                         "f 2 6 8 4\n");
  expect("check " + cube, 2, "and 5 of the file)");
  expect("mesh " + cube + " -o m.mesh", 2, "and 5 of the file)");
}

// What is sound can be solved, also far from the origin, and the box keeps its digits there.
// Farther away, cages are refused before anything is written.
TEST_F(CheckCommand, CagesFarAwayAreSolvedOrRefused) {
  const auto away = [](const std::string& name, int dim, double distance) {
    const Vector<3> shift(distance, -distance, dim == 3 ? distance : 0);
    return moved(name, std::to_string(dim) + ".obj", [&](const auto& p) { return p + shift; });
  };
  for (const int dim : {2, 3}) {
    SCOPED_TRACE(dim);
    const std::string name = dim == 2 ? "2d/letter_cage.obj" : "3d/star_cage.obj";
    const std::string domain = dim == 2 ? "d.obj" : "d.mesh";
    const auto farther = away(name, dim, 5e9);
    expect("run " + farther + " -o out", 2, "too far from the origin");
    EXPECT_FALSE(std::filesystem::exists("out"));
    const auto cage = away(name, dim, 1e8);
    const auto checked = expect("check " + cage);
    expect_piece(checked.output, "sound");
    expect_no_piece(checked.output, "e+08");
    expect_no_piece(expect("info " + cage).output, "e+08");
    expect("solve " + cage + " --vertices 500 -q --save-domain " + domain + " -o w.npy");
    expect("check " + cage + " --domain " + domain + " --weights w.npy");
  }
}

// A cube with another corner so near the last that no mesher can separate them.
TEST_F(CheckCommand, CagesTooThinAreRefusedBeforeTheyAreMeshed) {
  const auto cage = file("thin.obj",
                         "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n"
                         "v 1 0.999999999 1\nf 1 3 4\nf 1 4 2\nf 5 9 8\nf 5 6 9\nf 5 8 7\n"
                         "f 1 2 6\nf 1 6 5\nf 3 7 8\nf 3 8 4\nf 1 5 7\nf 1 7 3\nf 2 4 8\n"
                         "f 2 8 9\nf 2 9 6\n");
  expect_check(cage, 0, {"note too thin to mesh"});
  const double start = processor_seconds();
  const auto refused = expect("solve " + cage + " -o w.npy", 2,
                              "control point 8 at (1, 1, 1) is too close to triangle");
  expect_no_piece(refused.errors, "Netgen");
  EXPECT_LT(processor_seconds() - start, 20);  // meshers take minutes
}

TEST_F(CheckCommand, ModelsOutsideAreCountedAndNamed) {
  const auto cage = file("cage.obj", "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nl 1 2 3 4 1\n");
  const auto model = file("model.obj", "v 1 1 0\nv 5 1 0\nv 2 -1 0\nv 0 2 0\n");
  expect_check(cage + " --model " + model + " --json r.json", 0,
               {"2 of 4 vertices are outside the cage", "point 1, place (5, 1), distance 1\n",
                "least reach maximum  0.5590169944, point 0, place (1, 1)"});
  const auto json = json_in("r.json")["model"];
  EXPECT_EQ(json["outside"], 2);
  EXPECT_EQ(json["first_outside"]["point"], 1);
  EXPECT_EQ(json["farthest_outside"]["distance"], 1);
  const auto& farthest = json["least_reach"]["maximum"];
  EXPECT_NEAR(farthest["value"], std::sqrt(10.0 / 32), 1e-12);  // without the opposite corner
  EXPECT_EQ(farthest["point"], 0);
  expect_check("3d/limb_cage.obj --model 3d/limb_model.obj", 0, {"none outside the cage"});
}

// What the program delivers by default passes its own check, and beats harmonic coordinates in what
// it minimizes.
TEST_F(CheckCommand, DefaultResultsAreFine) {
  expect("mesh 2d/figure_cage.obj --vertices 2500 -q -o d.obj");
  for (const std::string options : {"", "--smoothness 0 "}) {
    expect(
        "solve 2d/figure_cage.obj --domain d.obj --distances exact -q -o w.npy --report r.json " +
        options);
    expect_check("2d/figure_cage.obj --domain d.obj --weights w.npy --json c.json", 0,
                 {"mesh weighted variation"});
    const auto mesh = json_in("c.json")["weights"]["mesh"];
    const double weighted = mesh["weighted_variation"];
    const double objective = json_in("r.json")["objective"];
    // Smoothness adds a term.
    EXPECT_EQ(std::abs(weighted - objective) < 1e-6 * objective, !options.empty());
    EXPECT_LE(weighted, objective * (1 + 1e-6));
    EXPECT_LT(weighted, 0.9 * mesh["harmonic_weighted_variation"].get<double>());
  }
}

TEST_F(CheckCommand, WeightsThatAreNoCoordinatesAreStatus2) {
  ASSERT_NO_FATAL_FAILURE(solve("2d/ring", "d.obj"));
  const std::string on_mesh = "2d/ring_cage.obj --domain d.obj --weights x.npy";
  const auto sound = io::read_weights("v.npy").dense();

  auto weights = sound;
  const auto last = static_cast<Index>(weights.cols() - 1);  // inside
  weights(3, last) += 1e-3;
  io::write_weights("x.npy", weights);
  const auto point = "point " + std::to_string(last);
  expect_check(on_mesh, 2, {"worst partition", "0.001, " + point},
               {"x.npy: the weights of " + point, "do not reproduce it"});

  weights = sound;
  weights(7, 7) = 0.75;  // the first vertices are the control points
  io::write_weights("x.npy", weights);
  expect_check(on_mesh, 2, {"worst lagrange", "0.25, point 7, "}, {"at point 7 at ("});

  // At another model point than its own, a row reproduces another point.
  weights = io::read_weights("w.npy").dense();
  weights.col(0).swap(weights.col(1));
  io::write_weights("x.npy", weights);
  expect_check("2d/ring_cage.obj --model 2d/ring_model.obj --weights x.npy", 2,
               {"worst reproduction"}, {"do not reproduce it"});
}

TEST_F(CheckCommand, FilesThatDoNotBelongAndWrongUsage) {
  ASSERT_NO_FATAL_FAILURE(solve("2d/ring", "d.obj"));
  const std::string cage = "2d/ring_cage.obj";
  const auto refused = [&](const std::string& arguments, int status, const std::string& words) {
    EXPECT_EQ(expect_check(arguments, status, {}, {words}).output, "");
  };
  refused(cage + " --weights w.npy", 1, "--model or --domain");
  refused(cage + " --domain d.obj", 1, "--weights");
  refused("", 1, "CAGE");
  refused(cage + " --json r.txt", 1, ".json");
  refused(cage + " --model ''", 1, "the value is empty");
  refused("missing.obj", 4, "missing.obj");
  refused(cage + " --weights w.npy --domain d.obj", 2, "d.obj has ");
  refused(cage + " --weights w.npy --model 2d/letter_model.obj", 2, "letter_model.obj has 1148");
  refused("2d/letter_cage.obj --weights v.npy --domain d.obj", 2, "for 22 control points, but");
  // A mesh of the cage at another place.
  auto domain = io::read_domain<2>("d.obj");
  domain.points.array() += 0.5;
  io::write_domain("moved.obj", domain);
  refused(cage + " --weights v.npy --domain moved.obj", 2, "moved.obj: boundary vertex");
  expect_piece(run("check --help").output, "--weights");
}

}  // namespace
}  // namespace flbc::testing
