// SPDX-License-Identifier: BSD-3-Clause
// Messages with suggestions: a command triggers each message, and following the suggestion works.
#include <regex>
#include <vector>

#include "support/command_line.h"

namespace flbc::testing {
namespace {

// Shell commands run in a separate directory; $F is the program, $M the samples, $V few vertices.
struct Row {
  std::string advice;              // a piece of the message
  std::string command;             // provokes it
  int status;                      // with which it ends
  std::vector<std::string> cures;  // what was advised, each in one command that works
};

// For readers of failures.
void PrintTo(const Row& row, std::ostream* out) {
  *out << row.command;
}

const std::vector<Row> kUsage{
    {"did you mean ", "$F slove", 1, {"$F solve --help"}},
    {"see flbc --help", "$F quux", 1, {"$F --help"}},
    {"; see ", "$F solve", 1, {"$F solve --help"}},
    {"'; see flbc --help", "$F man slove", 1, {"$F --help"}},
    {"give either a MODEL to enclose, or a cage with --repair",
     "$F cage -o c.obj",
     1,
     {"$F cage model.obj -o c.obj", "$F cage --repair slit.obj -o c.obj"}},
    {"; try flbc cage --repair",
     "$F solve slit.obj $V -o x.npy",
     2,
     {"$F cage --repair slit.obj -o c.obj && $F solve c.obj $V -o x.npy"}},
    {"; remove it or connect it",
     "$F solve loose.obj $V -o x.npy",
     2,
     {"$F cage --repair loose.obj -o c.obj && $F solve c.obj $V -o x.npy",
      "grep -v 'v -1' loose.obj >c.obj && $F solve c.obj $V -o x.npy",
      "sed 's/l 1 2 3 4 1/l 1 2 3 4 5 1/' loose.obj >c.obj && $F solve c.obj $V -o x.npy"}},
    {"merge them into one",
     "$F solve slit.obj $V -o x.npy",
     2,
     {"$F solve square.obj $V -o x.npy"}},
    {"; use another unit of length",
     "$F solve tiny.obj $V -o x.npy",
     2,
     {"sed s/e-200//g tiny.obj >c.obj && $F solve c.obj $V -o x.npy"}},
    {"; move it to the origin",
     "$F solve far.obj $V -o x.npy",
     2,
     {"sed s/100000000000000//g far.obj >c.obj && $F solve c.obj $V -o x.npy"}},
    {"; are CAGE and MODEL swapped?",
     "$F solve model.obj --model square.obj -o x.npy",
     2,
     {"$F solve square.obj --model model.obj $V -o x.npy"}},
    {"; move them apart or merge them",
     "$F mesh thin.obj -o x.mesh",
     2,
     {"sed s/1e-9/0.1/ thin.obj >c.obj && $F mesh c.obj $V -o x.mesh"}},
#ifndef __SANITIZE_ADDRESS__  // which takes terabytes of addresses
    {"out of memory; try fewer --vertices",
     "(ulimit -v 250000; OMP_NUM_THREADS=1 $F mesh $M/3d/limb_cage.obj --vertices 150000 --mesher "
     "tetgen -o x.mesh)",
     5,
     {"(ulimit -v 250000; OMP_NUM_THREADS=1 $F mesh $M/3d/limb_cage.obj --vertices 400 --mesher "
      "tetgen -o x.mesh)"}},
#endif
    {"raise the limit, ask for fewer vertices",
     "$F mesh $M/3d/limb_cage.obj --vertices 300000 --mesh-timeout 1 --mesher tetgen -o x.mesh",
     2,
     {"$F mesh $M/3d/limb_cage.obj --vertices 300 --mesh-timeout 1 --mesher tetgen -o x.mesh",
      "$F mesh $M/3d/limb_cage.obj --vertices 3000 --mesh-timeout 100 --mesher tetgen -o x.mesh"}}};

const std::vector<Row> kOutside{
    {"use flbc solve --outside, or make a cage around it with flbc cage",
     "$F check square.obj --model outside.obj",
     0,
     {"$F solve square.obj --model outside.obj $V --outside nearest -o x.npy",
      "$F cage outside.obj -o c.obj && $F check c.obj --model outside.obj"}},
    {"choose --outside nearest or --outside extend, or make a cage around the model with "
     "flbc cage",
     "$F solve square.obj --model outside.obj $V -o x.npy",
     2,
     {"$F solve square.obj --model outside.obj $V --outside nearest -o x.npy",
      "$F solve square.obj --model outside.obj $V --outside extend -o x.npy",
      "$F cage outside.obj -o c.obj && $F solve c.obj --model outside.obj $V -o x.npy"}},
    {"leave out --embed or --outside",
     "$F solve square.obj --model model.obj $V --embed --outside nearest -o x.npy",
     1,
     {"$F solve square.obj --model model.obj $V --outside nearest -o x.npy",
      "$F solve square.obj --model model.obj $V --embed -o x.npy"}},
    {"use nearest, or flbc solve and flbc deform",
     "$F run square.obj outside.obj $V --outside extend -o out",
     1,
     {"$F run square.obj outside.obj $V --outside nearest -o out",
      "$F solve square.obj --model outside.obj $V --outside extend -o x.npy && "
      "$F deform outside.obj --weights x.npy --pose square.obj -o y.obj"}}};

const std::vector<Row> kRuns{
    {"give MODEL only",
     "$F run square.obj model.obj --auto-cage $V -o out",
     1,
     {"$F run model.obj --auto-cage $V -o out"}},
    {"did you mean --auto-cage?",
     "$F run $M/3d/limb_model.obj $V -o out",
     1,
     {"$F run $M/3d/limb_model.obj --auto-cage $V -o out"}},
    {"save a pose there, and apply it with flbc deform",
     "$F run square.obj model.obj $V -o out",
     0,
     {"$F deform model.obj --weights out/weights.npy --pose pose.obj -o y.obj"}},
    {"wait for it, or use another folder",
     "mkdir out && flock out $F run square.obj $V -o out",
     4,
     {"$F run square.obj $V -o another", "$F run square.obj $V -o out"}},
    {"use another folder, or --force to replace it",
     "mkdir full && cp w.npy full/weights.npy && $F run square.obj $V -o full",
     1,
     {"$F run square.obj $V -o another", "$F run square.obj $V -o full --force"}},
    {"write the report with flbc solve --history or flbc run --history",
     "$F solve square.obj $V -o x.npy --report r.json; $F plot r.json -o p.svg",
     2,
     {"$F solve square.obj $V -o x.npy --report r.json --history && $F plot r.json -o p.svg",
      "$F run square.obj $V -o out --history && $F plot out/report.json -o p.svg"}},
    {"solve one part alone, or leave out --history",
     "$F solve two.obj $V -o x.npy --report r.json --history",
     1,
     {"$F solve square.obj $V -o x.npy --report r.json --history",
      "$F solve two.obj $V -o x.npy --report r.json"}},
    {"Increase --max-iterations, --tolerance, or --gap",
     "$F solve square.obj $V --max-iterations 3 -o x.npy",
     3,
     {"$F solve square.obj $V --max-iterations 3000 -o x.npy",
      "$F solve square.obj $V --max-iterations 30 --tolerance 0.1 -o x.npy",
      "$F solve square.obj $V --max-iterations 500 --gap 0.5 -o x.npy"}}};

const std::vector<Row> kFiles{
    {"give --from (a model that has these weights) or --domain (a mesh)",
     "$F transfer w.npy --to model.obj --cage square.obj -o x.npy",
     1,
     {"$F transfer w.npy --to model.obj --cage square.obj --from model.obj -o x.npy",
      "$F transfer dw.npy --to model.obj --cage square.obj --domain d.obj -o x.npy"}},
    {"give either DOMAIN or --model",
     "$F draw --weights w.npy --cage square.obj -o p.png",
     1,
     {"$F draw --weights w.npy --cage square.obj --model model.obj --control-point 0 -o p.png",
      "$F draw d.obj --weights dw.npy --cage square.obj --control-point 0 -o p.png"}},
    {"--color displacement needs --pose",
     "$F solve $M/3d/limb_cage.obj --model $M/3d/limb_model.obj --method harmonic $V -o v.npy; $F "
     "draw --weights v.npy --cage $M/3d/limb_cage.obj --model $M/3d/limb_model.obj --color "
     "displacement -o p.png",
     1,
     {"$F draw --weights v.npy --cage $M/3d/limb_cage.obj --model $M/3d/limb_model.obj --color "
      "displacement --pose $M/3d/limb_cage_pose.obj -o p.png"}},
    {"--weights needs --model or --domain",
     "$F check square.obj --weights w.npy",
     1,
     {"$F check square.obj --weights w.npy --model model.obj",
      "$F check square.obj --weights dw.npy --domain d.obj"}},
    {"add --pose or --keyframes",
     "$F deform model.obj --weights w.npy -o y.obj",
     1,
     {"$F deform model.obj --weights w.npy --pose pose.obj -o y.obj",
      "$F deform model.obj --weights w.npy --keyframes keys.txt --rest square.obj -o y_%d.obj"}},
    {"--keyframes needs --rest",
     "$F deform model.obj --weights w.npy --keyframes keys.txt -o y_%d.obj",
     1,
     {"$F deform model.obj --weights w.npy --keyframes keys.txt --rest square.obj -o y_%d.obj"}},
    {"add %d to this name, as in out_%03d.obj",
     "$F deform model.obj --weights w.npy --keyframes keys.txt --rest square.obj -o y.obj",
     1,
     {"$F deform model.obj --weights w.npy --keyframes keys.txt --rest square.obj -o "
      "out_%03d.obj"}},
    {"--displacement needs --rest",
     "$F deform model.obj --weights w.npy --pose pose.obj --displacement x.npy -o y.obj",
     1,
     {"$F deform model.obj --weights w.npy --pose pose.obj --rest square.obj --displacement x.npy "
      "-o "
      "y.obj"}},
    {"--show-displacement needs --rest",
     "$F deform model.obj --weights w.npy --pose pose.obj --show-displacement -o y.ply",
     1,
     {"$F deform model.obj --weights w.npy --pose pose.obj --rest square.obj --show-displacement "
      "-o "
      "y.ply"}},
    {"give -k (maximum influences per vertex), --threshold, or both",
     "$F sparsify w.npy --cage square.obj --points model.obj -o x.npy",
     1,
     {"$F sparsify w.npy --cage square.obj --points model.obj -k 3 -o x.npy",
      "$F sparsify w.npy --cage square.obj --points model.obj --threshold 0.1 -o x.npy",
      "$F sparsify w.npy --cage square.obj --points model.obj -k 3 --threshold 0.1 -o x.npy"}},
    {"use --reduction quadratic",
     "$F sparsify w.npy --cage square.obj --points points.obj -k 3 --reduction poisson -o x.npy",
     2,
     {"$F sparsify w.npy --cage square.obj --points model.obj -k 3 --reduction poisson -o x.npy",
      "$F sparsify w.npy --cage square.obj --points points.obj -k 3 --reduction quadratic -o "
      "x.npy"}},
    {": has control points as rows; give --transpose",
     "$F convert w.npy --transpose -o x.npy; $F convert x.npy --cage square.obj --points model.obj "
     "-o y.npy",
     2,
     {"$F convert x.npy --cage square.obj --points model.obj --transpose -o y.npy"}},
    {": has points as rows; leave out --transpose",
     "$F convert w.npy --cage square.obj --points model.obj --transpose -o x.npy",
     2,
     {"$F convert w.npy --cage square.obj --points model.obj -o x.npy"}},
    {"Check them with --cage and --points",
     "$F convert w.npy -o x.txt && $F convert x.txt -o y.npy",
     0,
     {"$F convert x.txt --cage square.obj --points model.obj -o y.npy"}},
    {"save the array with astype('<f8')",
     "sed 's/<f8/>f8/' w.npy >x.npy; $F info x.npy",
     2,
     {"$F info w.npy"}},
    {"save the mesh as text",
     "printf '$MeshFormat\\n4.1 1 8\\n' >x.msh; $F info x.msh",
     2,
     {"$F mesh $M/3d/limb_cage.obj $V -o x.msh && $F info x.msh"}},
    {"save the file in ASCII mode",
     "$F mesh square.obj $V -o x.vtu && sed s/ascii/binary/ x.vtu >y.vtu; $F info y.vtu",
     2,
     {"$F info x.vtu"}},
    {" is required without --serve",
     "$F view",
     1,
     {"$F view model.obj --weights w.npy --cage square.obj -o p.html",
      "timeout 5 $F view --serve square.obj model.obj $V; [ $? = 124 ]"}},
    {"for a smaller page, reduce influences per vertex, for example -k 4",
     "grid >grid.obj && $F cage grid.obj --control-points 12 -o c.obj && $F solve c.obj --model "
     "grid.obj --method harmonic $V -o x.npy && $F view grid.obj --weights x.npy --cage c.obj -k "
     "12 "
     "-o p.html",
     0,
     {"$F view grid.obj --weights x.npy --cage c.obj -k 4 -o p.html"}},
    {"move the cage and the model closer to the origin",
     "away square.obj >x.obj; away model.obj >y.obj; $F solve x.obj --model y.obj $V -o x.npy && "
     "$F export y.obj --weights x.npy --cage x.obj -o y.usda",
     0,
     {"$F export model.obj --weights w.npy --cage square.obj -o y.usda"}}};

const std::vector<Row> kSolver{
    {"; leave out this option",
     "$F solve square.obj $V --method harmonic --phi square -o x.npy",
     1,
     {"$F solve square.obj $V --method harmonic -o x.npy"}},
    {"; leave out this option",
     "$F solve square.obj $V --recovery least-squares -o x.npy",
     1,
     {"$F solve square.obj $V -o x.npy"}},
    {"; leave out this option",
     "$F solve square.obj $V --outside nearest -o x.npy",
     1,
     {"$F solve square.obj $V -o x.npy"}},
    {"; leave out this option",
     "$F solve square.obj --domain d.obj --mesh-timeout 10 -o x.npy",
     1,
     {"$F solve square.obj --domain d.obj -o x.npy"}},
    {"--gap does not apply to weights that may be negative; choose --non-negative constraint or "
     "project",
     "$F solve square.obj $V --gap 1e-3 --non-negative off -o x.npy",
     1,
     {"$F solve square.obj $V --gap 1e-3 --non-negative constraint -o x.npy",
      "$F solve square.obj $V --gap 1e-3 --non-negative project -o x.npy"}},
    {"; project the weights, or choose another method",
     "$F solve square.obj $V --method gradient --non-negative constraint -o x.npy",
     1,
     {"$F solve square.obj $V --method gradient --non-negative project -o x.npy",
      "$F solve square.obj $V --method value --non-negative constraint -o x.npy"}},
    {"; try the default penalty and relaxation, or double precision",
     "$F solve square.obj $V --penalty 1e300 -o x.npy",
     2,
     {"$F solve square.obj $V -o x.npy"}}};

class Advice : public CommandLineTest, public ::testing::WithParamInterface<Row> {
 protected:
  void SetUp() override {
    const std::string square = "v 0 0\nv 1 0\nv 1 1\nv 0 1\nl 1 2 3 4 1\n";
    const std::string points = "v 0.5 0.5 0\nv 0.3 0.2 0\nv 0.2 0.6 0\n";
    const std::string zeros = "c 0 0 0 0\nc 0 0 0 0\nc 0 0 0 0\nc 0 0 0 0\n";
    file("square.obj", square);
    file("pose.obj", "v 0 0\nv 1 0\nv 2 1\nv 0 1\nl 1 2 3 4 1\n");
    file("two.obj", square + "v 2 0\nv 3 0\nv 3 1\nv 2 1\nl 5 6 7 8 5\n");
    file("slit.obj", "v 0 0\nv 1 0\nv 1 1\nv 0 1\nv 0 0\nl 1 2 3 4 5\n");
    file("loose.obj", square + "v -1 0.5\n");
    file("tiny.obj", "v 0 0\nv 1e-200 0\nv 1e-200 1e-200\nv 0 1e-200\nl 1 2 3 4 1\n");
    file("far.obj",
         "v 1000000000000000 0\nv 1000000000000001 0\nv 1000000000000001 1\nv 1000000000000000 1\n"
         "l 1 2 3 4 1\n");
    file("thin.obj",
         "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.3 0.3 1e-9\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    file("points.obj", points);
    file("model.obj", points + "f 1 2 3\n");
    file("outside.obj", "v 0.5 0.5 0\nv 0.3 -0.2 0\nv 0.2 0.6 0\nf 1 2 3\n");
    file("keys.txt", "k 0\nk 1\n" + zeros + std::regex_replace(zeros, std::regex("c 0"), "c 1"));
    ASSERT_EQ(shell("$F solve square.obj --model model.obj $V -q -o w.npy").status, 0);
    ASSERT_EQ(shell("$F solve square.obj $V --save-domain d.obj -q -o dw.npy").status, 0);
  }

  Ended shell(const std::string& command) const {
    const auto script =
        file("script.sh", "cd " + path("") + "\nF=" + FLBC_PROGRAM + "\nM=" + FLBC_MESHES_DIR +
                              "\n" + kNames + command + "\n");
    const int status = std::system(
        ("bash " + script + " >" + path("stdout") + " 2>" + path("stderr") + " </dev/null")
            .c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, slurp(path("stdout")),
            slurp(path("stderr"))};
  }

 private:
  static constexpr const char* kNames = R"(V='--vertices 200'
away() { awk '/^v/ { $2 += 1e7; $3 += 2e7 } { print }' CONVFMT=%.17g "$1"; }
grid() {
  awk 'BEGIN {
    n = 500
    for (i = 0; i <= n; ++i) for (j = 0; j <= n; ++j) print "v", i / n, j / n, 0
    for (i = 0; i < n; ++i) for (j = 0; j < n; ++j) {
      k = i * (n + 1) + j + 1
      print "f", k, k + n + 1, k + n + 2, k + 1
    }
  }'
}
)";
};

TEST_P(Advice, Works) {
  const auto& row = GetParam();
  SCOPED_TRACE(row.command);
  const auto refused = shell(row.command);
  EXPECT_EQ(refused.status, row.status) << refused.errors;
  EXPECT_NE((refused.output + refused.errors).find(row.advice), std::string::npos)
      << refused.output << refused.errors;
  ASSERT_FALSE(row.cures.empty());
  for (const auto& cure : row.cures) {
    const auto done = shell(cure);
    EXPECT_EQ(done.status, 0) << cure << '\n' << done.errors;
    EXPECT_EQ(done.errors.find(row.advice), std::string::npos) << cure << '\n' << done.errors;
  }
}

INSTANTIATE_TEST_SUITE_P(Usage, Advice, ::testing::ValuesIn(kUsage));
INSTANTIATE_TEST_SUITE_P(Outside, Advice, ::testing::ValuesIn(kOutside));
INSTANTIATE_TEST_SUITE_P(Runs, Advice, ::testing::ValuesIn(kRuns));
INSTANTIATE_TEST_SUITE_P(Files, Advice, ::testing::ValuesIn(kFiles));
INSTANTIATE_TEST_SUITE_P(Solver, Advice, ::testing::ValuesIn(kSolver));

}  // namespace
}  // namespace flbc::testing
