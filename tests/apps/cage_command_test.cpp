// SPDX-License-Identifier: BSD-3-Clause
// flbc cage as its users see it.
#include "support/command_line.h"
#include "support/png_image.h"

namespace flbc::testing {
namespace {

class CageCommand : public CommandLineTest {
 protected:
  nlohmann::json check(const std::string& cage, const std::string& model) const {
    return nlohmann::json::parse(run("check " + cage + " --model " + model + " --json -").output);
  }
};

TEST_F(CageCommand, CurvesKeepTheirHeight) {
  const auto curve = file("curve.obj", "v 0 0 3\nv 1 2 3\nv 3 1 3\nl 1 2 3\n");
  expect("cage " + curve + " -q -o cage.obj");
  expect_piece(slurp("cage.obj"), " 3\n");
  EXPECT_TRUE(check("cage.obj", curve)["fine"]);
}

// A disc that is to be seen, one pixel apart from it, and nothing round them.
TEST_F(CageCommand, SilhouettesOfPictures) {
  constexpr int kSize = 60;
  const auto is_seen = [](int x, int y) {
    return (x - 25) * (x - 25) + (y - 35) * (y - 35) < 300 || (x == 55 && y == 3);
  };
  draw::write_png("disc.png", kSize, kSize,
                  [&](int x, int y) { return is_seen(x, kSize - 1 - y) ? 1 : 0; });
  expect("cage disc.png -q -o cage.obj");
  std::string corners;
  for (int x = 0; x < kSize; ++x) {
    for (int y = 0; y < kSize; ++y) {
      if (!is_seen(x, y)) continue;
      for (const int k : {0, 1, 2, 3}) {
        corners += "v " + std::to_string(x + k % 2) + ' ' + std::to_string(y + k / 2) + " 0\n";
      }
    }
  }
  const auto report = check("cage.obj", file("corners.obj", corners));
  EXPECT_TRUE(report["fine"]);
  EXPECT_EQ(report["model"]["outside"], 0);
  EXPECT_LT(report["cage"]["measure"], 0.7 * kSize * kSize);
  const auto cage = slurp("cage.obj");
  // A haze that nobody sees.
  draw::write_png("hazy.png", kSize, kSize,
                  [&](int x, int y) { return is_seen(x, kSize - 1 - y) ? 255 : 1 + (x + y) % 5; });
  expect("cage hazy.png -q -o cage.obj");
  EXPECT_EQ(slurp("cage.obj"), cage);
  draw::write_png("full.png", kSize, kSize, [](int x, int) { return 200 + x % 50; });
  expect("cage full.png -o none.obj", 2,
         "full.png: no pixel is transparent; the lowest alpha is 200 of 255");
  expect("cage " + file("no.png", "text") + " -o none.obj", 2, "no.png: ");
  draw::write_png("noise.png", 1500, 1500, [](int x, int y) { return (x + y) % 2 == 0 ? 255 : 0; });
  expect("cage noise.png -o none.obj", 2, "noise.png: the silhouette has more than 4,000,000");
}

// A ring, in a cage around it, and as a cage itself.
TEST_F(CageCommand, DrawingsAreOutlines) {
  const auto drawing = file(
      "ring.svg",
      R"svg(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100"><g transform="scale(2)">)svg"
      R"svg(<circle cx="25" cy="25" r="15" fill="none" stroke="red" stroke-width="10"/></g></svg>)svg");
  if (run("info " + drawing).errors.find("needs librsvg") != std::string::npos) {
    GTEST_SKIP() << "librsvg is missing";
  }
  expect("convert " + drawing + " -q -o outline.obj");
  const auto own = check(drawing, drawing);
  const double area = std::acos(-1.0) * (40 * 40 - 20 * 20);
  EXPECT_NEAR(own["cage"]["measure"], area, 0.01 * area);
  expect("cage " + drawing + " -q -o cage.obj");
  EXPECT_TRUE(check("cage.obj", "outline.obj")["fine"]);
  expect("run " + drawing + " --vertices 300 -q -o own");
  expect("run " + drawing + " --auto-cage --vertices 300 -q -o around");
  expect("run cage.obj " + drawing + " --vertices 300 -q -o within");
  EXPECT_TRUE(std::filesystem::exists("within/model.html"));
}

// Two pillars on a plate, 0.05 apart.
TEST_F(CageCommand, BridgedGapsAreReported) {
  std::string vertices, faces;
  int count = 0;
  for (const auto& [low, high] : {std::pair(Vector<3>(-1, -1, -0.5), Vector<3>(1, 1, 0.1)),
                                  std::pair(Vector<3>(-0.75, -0.3, 0), Vector<3>(-0.15, 0.3, 2)),
                                  std::pair(Vector<3>(0.15, -0.3, 0), Vector<3>(0.75, 0.3, 2))}) {
    const auto box = box_cage<3>(low, high);
    for (const auto& p : box.points.colwise()) {
      vertices += 'v';
      for (const double x : p) vertices += ' ' + std::to_string(x);
      vertices += '\n';
    }
    for (const auto& facet : box.facets.colwise()) {
      faces += 'f';
      for (const Index v : facet) faces += ' ' + std::to_string(count + v + 1);
      faces += '\n';
    }
    count += 8;
  }
  const auto model = file("pillars.obj", vertices + faces);
  const auto result = expect("cage " + model + " --control-points 16 -o cage.obj");
  expect_piece(result.errors, "pillars.obj: the cage bridges 1 narrow gap of the model at (");
  const std::string tied = "(0.3 wide), so parts on both sides move together";
  expect_piece(result.errors, tied);
  // A cage that has been made before is checked in the same way.
  expect_piece(expect("check cage.obj --model " + model).output, tied);
  const auto open = expect("cage " + model + " --control-points 60 -o open.obj");
  EXPECT_EQ(open.errors.find("bridges"), std::string::npos);
  EXPECT_EQ(expect("check open.obj --model " + model).output.find("bridges"), std::string::npos);
}

// A strip whose first vertex belongs to no edge, and whose upper half is to get more control
// points.
TEST_F(CageCommand, MoreControlPointsWhereTheirDensityIsHigher) {
  std::string model = "v 9 9\n", line = "l", density = "1\n";
  for (int k = 0; k < 40; ++k) {
    model += "v 0 " + std::to_string(k - 19.5) + '\n';
    line += ' ' + std::to_string(k + 2);
    density += k < 20 ? "1\n" : "6\n";
  }
  const auto strip = file("strip.obj", model + line + '\n');
  expect("cage " + strip + " --density " + file("d.csv", density) + " -q -o dense.obj");
  std::istringstream cage(slurp("dense.obj"));
  int above = 0, below = 0;
  double x = 0, y = 0;
  for (std::string word; cage >> word;) {
    if (word == "v" && cage >> x >> y) ++(y > 0 ? above : below);
  }
  EXPECT_GE(above, 2 * below);
  EXPECT_TRUE(check("dense.obj", strip)["fine"]);
  const auto refuse = [&](const std::string& rows, const std::string& reason) {
    expect("cage " + strip + " --density " + file("bad.csv", rows) + " -o none.obj", 2, reason);
  };
  refuse(density + "1\n",
         "bad.csv: holds 42 rows of 1 numbers; a density is a number for each of 41");
  refuse("0\n" + density.substr(2),
         "bad.csv: the density of vertex 0 is 0; give numbers from 0.01");
  refuse("1\nfew\n", "bad.csv:2: ");
}

TEST_F(CageCommand, RefusesWithReason) {
  const std::string out = " -o out.obj";
  expect("cage" + out, 1, "MODEL to enclose is missing");
  expect("cage " + square() + out + " --control-points 2", 1, "at least 3");
  expect("cage " + square() + out + " --offset -1", 1, "offset");
  expect("cage " + square() + out + " --symmetric z", 1, "symmetric across z");
  expect("cage " + square() + out + " --symmetric w", 1, "--symmetric");
  expect("cage " + square() + " -o out.ply", 1, ".obj");
  expect("cage 3d/limb_model.obj -o out.stl", 1, "must end in .obj, .off or .ply");
  expect("cage " + file("dot.obj", "v 1 1 1\n") + out, 2, "dot.obj: the model size of 0 is out");
  expect("cage none.obj" + out, 4, "none.obj");
  EXPECT_EQ(slurp("out.obj"), "");
}

TEST_F(CageCommand, RepairTellsWhatWasDoneAndNumbersThatChanged) {
  const auto defective = file("open.obj", "v 5 5\nv 0 0\nv 1 0\nv 1 1\nv 0 1\nl 2 3 4 5\n");
  expect("mesh " + defective + " -o mesh.obj", 2, "flbc cage --repair");
  const auto result = expect("cage --repair " + defective + " -o repaired.obj", 0,
                             "a new edge joins the open ends at control points 1 and 4");
  expect_piece(result.errors, "control point 0 at (5, 5) belongs to no facet");
  expect_piece(result.errors, "repaired.numbers.txt");
  EXPECT_EQ(slurp("repaired.numbers.txt"), "0 -1\n1 0\n2 1\n3 2\n4 3\n");
  expect("mesh repaired.obj -o mesh.obj -q");
}

TEST_F(CageCommand, RepairDropsPolylinesBesideASurface) {
  const auto mixed = file("mixed.obj",
                          "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                          "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\nl 1 2\n");
  const std::string solve = " --vertices 100 -o w.npy";
  const auto refused = expect("solve " + mixed + solve, 2, "has both polygons and polylines");
  expect_piece(refused.errors, "flbc cage --repair");
  expect("cage --repair " + mixed + " -o repaired.obj", 0, "1 polylines next to");
  expect("solve repaired.obj" + solve);
}

// Two squares, the second of which begins in the middle of the first.
TEST_F(CageCommand, RepairSaysHowMuchItChanged) {
  const auto crossing = file("crossing.obj",
                             "v 0 0\nv 2 0\nv 2 2\nv 0 2\nv 1 1\nv 3 1\nv 3 3\nv 1 3\n"
                             "l 1 2 3 4 1\nl 5 6 7 8 5\n");
  const auto told = expect("cage --repair " + crossing + " -o united.obj", 0,
                           "area 7 (before: 7), at most 0 from the old outline, 6 of 8 control "
                           "points kept");
  expect_piece(told.errors, "edges 1, 2, 4 and 7 cross or touch others");
  EXPECT_EQ(slurp("united.numbers.txt"), "0 0\n1 1\n2 -1\n3 2\n4 -1\n5 3\n6 4\n7 5\n");
  EXPECT_EQ(check("united.obj", square())["cage"]["measure"], 7);
}

TEST_F(CageCommand, VerticesOfNoFaceDoNotCount) {
  const auto model = tetrahedron("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n", "model.obj");
  expect("cage " + model + " -q -o cage.obj");
  const auto far = file("far.obj",
                        "v 50 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 2 4 3\n"
                        "f 2 3 5\nf 3 4 5\nf 4 2 5\n");
  expect("cage " + far + " -o far_cage.obj", 0, "far.obj: the cage leaves out 1 vertex of no face");
  EXPECT_EQ(slurp("far_cage.obj"), slurp("cage.obj"));
}

TEST_F(CageCommand, PartsOfPointsAreCounted) {
  expect("cage " + file("points.obj", "v 0 0 0\nv 5 0 0\nv 0 9 0\nv 1 1 7\n") + " -o cage.obj", 0,
         "separate parts, because there are wide gaps");
}

TEST_F(CageCommand, RepairOfASoundCageChangesNothing) {
  expect("cage --repair " + square() + " -o same.obj", 0, "no defects found");
  EXPECT_EQ(slurp("same.numbers.txt"), "");
  EXPECT_TRUE(check("same.obj", square())["fine"]);
}

TEST_F(CageCommand, RunFromTheModelAlone) {
  for (const std::string name : {"2d/figure", "3d/limb"}) {
    const auto model = name + "_model.obj";
    // Options may precede the model.
    expect("run --auto-cage --control-points 30 " + model + " --vertices 600 -o out", 0,
           "cage.obj");
    const auto report = json_in("out/report.json");
    double sum = 0;  // of the steps that follow each other
    for (const auto& [step, seconds] : report["seconds"].items()) {
      EXPECT_GT(seconds.get<double>(), step == "cage" ? 1e-3 : 0);
      const bool is_beside = step == "check" || step == "pictures" || step == "page";
      if (step != "total" && !is_beside) sum += seconds.get<double>();
    }
    EXPECT_GE(report["seconds"]["total"].get<double>(), sum);
    EXPECT_TRUE(report["check"]["fine"]);
    expect("cage " + model + " -q --control-points 30 -o cage.obj");
    EXPECT_EQ(slurp("out/cage.obj"), slurp("cage.obj"));
  }
  const std::string model = "2d/figure_model.obj";
  const auto symmetric = model + " -q --symmetric x -o ";
  expect("run --auto-cage --vertices 600 --force " + symmetric + "out");
  expect("cage " + symmetric + "cage.obj");
  EXPECT_EQ(slurp("out/cage.obj"), slurp("cage.obj"));
  expect("run " + model + " --auto-cage --vertices 600 -q -o plain");
  for (const auto& [options, words] :
       {std::pair<std::string, std::string>{"--auto-cage --control-points two", "--control-points"},
        {"--control-points 30", "requires --auto-cage"},
        {"--symmetric x", "there is no model"},
        {model + " --auto-cage", "--auto-cage"},
        {"--auto-cage 30", "by --control-points"}}) {
    expect("run " + model + ' ' + options + " -q -o none", 1, words);
  }
}

}  // namespace
}  // namespace flbc::testing
