// SPDX-License-Identifier: BSD-3-Clause
// Cages of several parts in one file: every command takes them, and each part is as if alone.
#include "support/command_line.h"
#include "support/png_image.h"

namespace flbc::testing {
namespace {

template <int Dim>
std::string text_of(const Cage<Dim>& cage) {
  std::ostringstream text;
  text.precision(17);
  for (const auto& point : cage.points.colwise()) {
    text << "v " << point.transpose() << (Dim == 2 ? " 0\n" : "\n");
  }
  for (const auto& facet : cage.facets.colwise()) {
    text << (Dim == 2 ? "l " : "f ") << (facet.array() + 1).transpose() << '\n';
  }
  return text.str();
}

template <class Dimension>
class PartsCommand : public CommandLineTest {
 protected:
  static constexpr int kDim = Dimension::value;

  const std::string vertices_ = kDim == 2 ? " --vertices 500 " : " --vertices 900 ";

  static Cage<kDim> small() { return box_cage<kDim>(0.5); }
  static Cage<kDim> large() { return box_cage<kDim>(2, 4); }
  std::string both() const { return file("both.obj", text_of(join(small(), large()))); }
  // Two small boxes, one in each part, moved by so much along the first axis.
  std::string model(double shift = 0) const {
    auto low = box_cage<kDim>(0.3), high = large();
    high.points = (0.5 * high.points.array() + 1.5).matrix();
    auto boxes = join(low, high);
    boxes.points.row(0).array() += shift;
    std::string text = text_of(boxes);
    if (kDim == 2) text += "f 1 2 4 3\nf 5 6 8 7\n";
    return file("model.obj", text);
  }
};

TYPED_TEST_SUITE(PartsCommand, Dimensions);

TYPED_TEST(PartsCommand, RunDoesAllOfIt) {
  const auto cage = this->both(), of = this->model();
  auto moved = join(this->small(), this->large());
  moved.points.row(0).rightCols(this->large().size()).array() += 1;
  const auto pose = this->file("pose.obj", text_of(moved));
  const std::string out = "out";
  this->expect(
      "run " + cage + ' ' + of + this->vertices_ + "--certify --pose " + pose + " -o " + out, 0,
      ", 2 parts");
  const auto report = json_in("out/report.json");
  EXPECT_TRUE(report["check"]["fine"]);
  EXPECT_EQ(report["solve"]["parts"].size(), 2u);
  // The small part stays where it is, the large one moves by 1.
  const auto weights = out + "/weights.npy";
  this->expect("deform " + of + " --weights " + weights + " --pose " + pose + " --rest " + cage +
               " -o moved.obj");
  constexpr int n = 1 << TypeParam::value;
  auto expected = points_in<TypeParam::value>(of);
  ASSERT_EQ(expected.cols(), 2 * n);
  expected.row(0).rightCols(n).array() += 1;
  EXPECT_LT((points_in<TypeParam::value>("moved.obj") - expected).cwiseAbs().maxCoeff(), 1e-12);
  for (const std::string& command :
       {"sparsify " + weights + " --cage " + cage + " --points " + of + " -k 4 -o few.npy",
        "export " + of + " --weights " + weights + " --cage " + cage + " -o skin.glb",
        "view " + of + " --weights " + weights + " --cage " + cage + " -o page.html",
        "draw " + out + (TypeParam::value == 2 ? "/domain.obj" : "/domain.mesh") + " --weights " +
            out + "/domain_weights.npy --cage " + cage + " --control-point 1 -o picture.png",
        "check " + cage + " --model " + of + " --weights " + weights}) {
    this->expect(command, 0);
  }
}

// The vertices of the small box leave its part on one side; they follow that part, not the other.
TYPED_TEST(PartsCommand, OutsideOfAllParts) {
  const auto cage = this->both(), of = this->model(0.4);
  constexpr int n = 1 << TypeParam::value;
  const auto solve = [&](const std::string& policy) {
    return "solve " + cage + this->vertices_ + "--model " + of + " --outside " + policy +
           " -o w.npy";
  };
  this->expect(
      solve("fail"), 2,
      std::to_string(n / 2) + " of " + std::to_string(2 * n) + " vertices are outside the cage");
  for (const std::string policy : {"nearest", "extend"}) {
    this->expect(solve(policy), 0, "vertices are outside the cage");
    const auto weights = io::read_weights("w.npy").dense();
    EXPECT_EQ(weights.bottomLeftCorner(n, n).cwiseAbs().maxCoeff(), 0);
    EXPECT_LT((weights.colwise().sum().array() - 1).abs().maxCoeff(), 1e-12);
  }
}

using PartsOfPicture = CommandLineTest;

// Two discs, one of them a ring with a third disc in it.
TEST_F(PartsOfPicture, SilhouetteInPiecesRuns) {
  constexpr int kWidth = 160, kHeight = 90;
  const auto within = [](int x, int y, int cx, double low, double high) {
    const double radius = std::hypot(x - cx, y - 45);
    return radius >= low && radius <= high;
  };
  const auto picture = draw::write_png("rings.png", kWidth, kHeight, [&](int x, int y) {
    const bool is_seen =
        within(x, y, 125, 0, 25) || within(x, y, 45, 28, 40) || within(x, y, 45, 0, 8);
    return is_seen ? 255 : 0;
  });

  const auto cage = expect("cage " + picture + " --offset 2 -o cage.obj");
  const auto check = nlohmann::json::parse(run("check cage.obj --json -").output);
  EXPECT_GE(check["cage"]["parts"], 2);
  expect("solve cage.obj --vertices 800 -o w.npy");
  expect("run " + picture + " --auto-cage --vertices 800 -o out");
  const auto report = json_in("out/report.json");
  EXPECT_EQ(report["solve"]["parts"].size(), report["check"]["cage"]["parts"]);
  EXPECT_TRUE(report["check"]["fine"]);
  EXPECT_EQ(report["inputs"], nlohmann::json::array({picture}));
  for (const std::string option : {"--embed", "--outside nearest"}) {
    expect("run " + picture + " --auto-cage " + option + " -o none", 1);
  }
}

}  // namespace
}  // namespace flbc::testing
