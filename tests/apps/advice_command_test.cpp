// SPDX-License-Identifier: BSD-3-Clause
// Messages with suggestions: a command triggers each message, and following the suggestion works.
#include "support/command_line.h"

namespace flbc::testing {
namespace {

// Tables of "# a piece of a message", the exit status and the command that provokes it, and what
// was advised, each in one command that works. $V stands for few vertices.
const char* const kUsage = R"(
# see flbc --help
1 flbc quux
flbc --help
# ; see
1 flbc solve
flbc solve --help
# MODEL to enclose is missing, or a cage with --repair
1 flbc cage -o c.obj
flbc cage model.obj -o c.obj
flbc cage --repair slit.obj -o c.obj
# ; try flbc cage --repair
2 flbc solve slit.obj $V -o x.npy
flbc cage --repair slit.obj -o c.obj && flbc solve c.obj $V -o x.npy
# ; remove it or connect it
2 flbc solve loose.obj $V -o x.npy
flbc cage --repair loose.obj -o c.obj && flbc solve c.obj $V -o x.npy
grep -v 'v -1' loose.obj >c.obj && flbc solve c.obj $V -o x.npy
sed 's/l 1 2 3 4 1/l 1 2 3 4 5 1/' loose.obj >c.obj && flbc solve c.obj $V -o x.npy
# merge them into one
2 flbc solve slit.obj $V -o x.npy
flbc solve square.obj $V -o x.npy
# ; use another unit of length
2 flbc solve tiny.obj $V -o x.npy
sed s/e-200//g tiny.obj >c.obj && flbc solve c.obj $V -o x.npy
# ; move it to the origin
2 flbc solve far.obj $V -o x.npy
sed s/100000000000000//g far.obj >c.obj && flbc solve c.obj $V -o x.npy
# ; are CAGE and MODEL swapped?
2 flbc solve model.obj --model square.obj -o x.npy
flbc solve square.obj --model model.obj $V -o x.npy
# ; move them apart or merge them
2 flbc mesh thin.obj -o x.mesh
sed s/1e-9/0.1/ thin.obj >c.obj && flbc mesh c.obj $V -o x.mesh
# out of memory; try fewer --vertices
5 (ulimit -v 100000; OMP_NUM_THREADS=1 flbc mesh 3d/limb_cage.obj --vertices 200000 --mesher tetgen -o x.mesh)
(ulimit -v 100000; OMP_NUM_THREADS=1 flbc mesh 3d/limb_cage.obj --vertices 400 --mesher tetgen -o x.mesh)
# raise the limit, ask for fewer vertices
2 flbc mesh 3d/limb_cage.obj --vertices 1000000 --mesh-timeout 1 --mesher tetgen -o x.mesh
flbc mesh 3d/limb_cage.obj --vertices 300 --mesh-timeout 1 --mesher tetgen -o x.mesh
flbc mesh 3d/limb_cage.obj --vertices 3000 --mesh-timeout 100 --mesher tetgen -o x.mesh
)";

const char* const kOutside = R"(
# use flbc solve --outside, or make a cage around it with flbc cage
0 flbc check square.obj --model outside.obj
flbc solve square.obj --model outside.obj $V --outside nearest -o x.npy
flbc cage outside.obj -o c.obj && flbc check c.obj --model outside.obj
# add --outside nearest, by which they follow the cage, or --outside keep, by which they stay where they are; or make a cage around the model with flbc cage
2 flbc solve square.obj --model outside.obj $V -o x.npy
flbc solve square.obj --model outside.obj $V --outside keep -o x.npy
flbc solve square.obj --model outside.obj $V --outside nearest -o x.npy
flbc cage outside.obj -o c.obj && flbc solve c.obj --model outside.obj $V -o x.npy
# leave out --embed or --outside
1 flbc solve square.obj --model model.obj $V --embed --outside nearest -o x.npy
flbc solve square.obj --model model.obj $V --outside nearest -o x.npy
flbc solve square.obj --model model.obj $V --embed -o x.npy
# use nearest, or flbc solve and flbc deform
1 flbc run square.obj outside.obj $V --outside extend -o out
flbc run square.obj outside.obj $V --outside nearest -o out
flbc solve square.obj --model outside.obj $V --outside extend -o x.npy && flbc deform outside.obj --weights x.npy --pose square.obj -o y.obj
)";

const char* const kRuns = R"(
# give MODEL only
1 flbc run square.obj model.obj --auto-cage $V -o out
flbc run model.obj --auto-cage $V -o out
# did you mean --auto-cage?
1 flbc run 3d/limb_model.obj $V -o out
flbc run 3d/limb_model.obj --auto-cage $V -o out
# save a pose there, and apply it with flbc deform
0 flbc run square.obj model.obj $V -o out
flbc deform model.obj --weights out/weights.npy --pose pose.obj -o y.obj
# use another folder, or --force to replace it
1 mkdir full && cp w.npy full/weights.npy && flbc run square.obj $V -o full
flbc run square.obj $V -o another
flbc run square.obj $V -o full --force
# Increase --max-iterations, --tolerance, or --gap
3 flbc solve square.obj $V --max-iterations 3 -o x.npy
flbc solve square.obj $V --max-iterations 3000 -o x.npy
flbc solve square.obj $V --max-iterations 30 --tolerance 0.1 -o x.npy
flbc solve square.obj $V --max-iterations 500 --gap 0.5 -o x.npy
)";

const char* const kFiles = R"(
# --from (a model that has these weights) or --domain (a mesh) is missing
1 flbc transfer w.npy --to model.obj --cage square.obj -o x.npy
flbc transfer w.npy --to model.obj --cage square.obj --from model.obj -o x.npy
flbc transfer dw.npy --to model.obj --cage square.obj --domain d.obj -o x.npy
# MODEL is missing, a model or a domain mesh
1 flbc draw --weights w.npy --cage square.obj -o p.png
flbc draw model.obj --weights w.npy --cage square.obj --control-point 0 -o p.png
flbc draw d.obj --weights dw.npy --cage square.obj --control-point 0 -o p.png
# --weights: --model or --domain is missing
1 flbc check square.obj --weights w.npy
flbc check square.obj --weights w.npy --model model.obj
flbc check square.obj --weights dw.npy --domain d.obj
# --pose is missing
1 flbc deform model.obj --weights w.npy -o y.obj
flbc deform model.obj --weights w.npy --pose pose.obj -o y.obj
# add %d to this name, as in out_%03d.obj
1 flbc deform model.obj --weights w.npy --pose square.obj pose.obj -o y.obj
flbc deform model.obj --weights w.npy --pose square.obj pose.obj -o out_%03d.obj
# --displacement: --rest is missing
1 flbc deform model.obj --weights w.npy --pose pose.obj --displacement x.npy -o y.obj
flbc deform model.obj --weights w.npy --pose pose.obj --rest square.obj --displacement x.npy -o y.obj
# --show-displacement: --rest is missing
1 flbc deform model.obj --weights w.npy --pose pose.obj --show-displacement -o y.ply
flbc deform model.obj --weights w.npy --pose pose.obj --rest square.obj --show-displacement -o y.ply
# -k (maximum influences per vertex) or --threshold is missing
1 flbc sparsify w.npy --cage square.obj --points model.obj -o x.npy
flbc sparsify w.npy --cage square.obj --points model.obj -k 3 -o x.npy
flbc sparsify w.npy --cage square.obj --points model.obj --threshold 0.1 -o x.npy
flbc sparsify w.npy --cage square.obj --points model.obj -k 3 --threshold 0.1 -o x.npy
# -k must be at least 3 in 2D
1 flbc sparsify w.npy --cage square.obj --points model.obj -k 2 -o x.npy
flbc sparsify w.npy --cage square.obj --points model.obj -k 3 -o x.npy
# -k 20: a page holds from 3 to 16
1 flbc view model.obj --weights w.npy --cage square.obj -k 20 -o p.html
flbc view model.obj --weights w.npy --cage square.obj -k 16 -o p.html
# to make a cage around a model, leave out --repair
0 flbc cage --repair 3d/limb_model.obj -o c.obj
flbc cage 3d/limb_model.obj -o c.obj
# so this is 3D; a 2D cage needs a 2D model, with the same z everywhere
2 flbc solve square.obj --model 3d/limb_model.obj $V -o x.npy
flbc solve 3d/limb_cage.obj --model 3d/limb_model.obj $V -o x.npy
# use --reduction quadratic
2 flbc sparsify w.npy --cage square.obj --points points.obj -k 3 --reduction poisson -o x.npy
flbc sparsify w.npy --cage square.obj --points model.obj -k 3 --reduction poisson -o x.npy
flbc sparsify w.npy --cage square.obj --points points.obj -k 3 --reduction quadratic -o x.npy
# save the array with astype('<f8')
2 sed 's/<f8/>f8/' w.npy >x.npy; flbc info x.npy
flbc info w.npy
# save the mesh as text
2 printf '$MeshFormat\n4.1 1 8\n' >x.msh; flbc info x.msh
flbc mesh 3d/limb_cage.obj $V -o x.msh && flbc info x.msh
# save the mesh as .mesh (in 2D .obj) as well
1 flbc mesh square.obj $V -o x.vtu && flbc info x.vtu
flbc mesh square.obj $V -o x.obj && flbc info x.obj
# for a smaller page, reduce influences per vertex, for example -k 4
0 grid >grid.obj && flbc cage grid.obj --control-points 12 -o c.obj && flbc solve c.obj --model grid.obj --method harmonic $V -o x.npy && flbc view grid.obj --weights x.npy --cage c.obj -k 12 -o p.html
flbc view grid.obj --weights x.npy --cage c.obj -k 4 -o p.html
# move the cage and the model closer to the origin
0 away square.obj >x.obj; away model.obj >y.obj; flbc solve x.obj --model y.obj $V -o x.npy && flbc export y.obj --weights x.npy --cage x.obj -o y.usda
flbc export model.obj --weights w.npy --cage square.obj -o y.usda
)";

const char* const kSolver = R"(
# ; leave out this option
1 flbc solve square.obj $V --method harmonic --phi square -o x.npy
flbc solve square.obj $V --method harmonic -o x.npy
# ; leave out this option
1 flbc solve square.obj $V --outside nearest -o x.npy
flbc solve square.obj $V -o x.npy
# ; leave out this option
1 flbc solve square.obj --domain d.obj --mesh-timeout 10 -o x.npy
flbc solve square.obj --domain d.obj -o x.npy
# proven to be at most
0 flbc solve square.obj $V --gap 1e-9 --tolerance 1e-2 -o x.npy
flbc solve square.obj $V --tolerance 1e-2 -o x.npy
# make a symmetric cage with flbc cage --symmetric, or leave out --symmetric
2 flbc run pose.obj model.obj $V --symmetric x -o out
flbc run pose.obj model.obj $V -o out
flbc cage model.obj --symmetric x -o c.obj && flbc run c.obj model.obj $V --symmetric x -o out
# --gap does not apply to weights that may be negative; choose --non-negative constraint or project
1 flbc solve square.obj $V --gap 1e-3 --non-negative off -o x.npy
flbc solve square.obj $V --gap 1e-3 --non-negative constraint -o x.npy
flbc solve square.obj $V --gap 1e-3 --non-negative project -o x.npy
# lbc2014 only; choose project
1 flbc solve square.obj $V --method gradient --non-negative constraint -o x.npy
flbc solve square.obj $V --method gradient --non-negative project -o x.npy
flbc solve square.obj $V --method weights --non-negative constraint -o x.npy
# ; try the default penalty, or double precision
2 flbc solve square.obj $V --penalty 1e300 -o x.npy
flbc solve square.obj $V -o x.npy
)";

class Advice : public CommandLineTest, public ::testing::WithParamInterface<const char*> {
 protected:
  Advice() {
    std::filesystem::create_directory("base");
    std::filesystem::rename("2d", "base/2d");
    std::filesystem::rename("3d", "base/3d");
    const std::string square = "v 0 0\nv 1 0\nv 1 1\nv 0 1\nl 1 2 3 4 1\n";
    const std::string points = "v 0.5 0.5 0\nv 0.3 0.2 0\nv 0.2 0.6 0\n";
    file("base/square.obj", square);
    file("base/pose.obj", "v 0 0\nv 1 0\nv 2 1\nv 0 1\nl 1 2 3 4 1\n");
    file("base/slit.obj", "v 0 0\nv 1 0\nv 1 1\nv 0 1\nv 0 0\nl 1 2 3 4 5\n");
    file("base/loose.obj", square + "v -1 0.5\n");
    file("base/tiny.obj", "v 0 0\nv 1e-200 0\nv 1e-200 1e-200\nv 0 1e-200\nl 1 2 3 4 1\n");
    file("base/far.obj",
         "v 1000000000000000 0\nv 1000000000000001 0\nv 1000000000000001 1\nv 1000000000000000 1\n"
         "l 1 2 3 4 1\n");
    file("base/thin.obj",
         "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.3 0.3 1e-9\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    file("base/points.obj", points);
    file("base/model.obj", points + "f 1 2 3\n");
    file("base/outside.obj", "v 0.5 0.5 0\nv 0.3 -0.2 0\nv 0.2 0.6 0\nf 1 2 3\n");
    EXPECT_EQ(shell("flbc solve square.obj --model model.obj $V -q -o w.npy", "base").status, 0);
    EXPECT_EQ(shell("flbc solve square.obj $V --save-domain d.obj -q -o dw.npy", "base").status, 0);
  }

  static Ended shell(const std::string& command, const std::string& folder) {
    file("script.sh", std::string(kNames) + "cd " + folder + '\n' + command + '\n');
    const int status = status_of("bash script.sh >stdout 2>stderr </dev/null");
    return {status, slurp("stdout"), slurp("stderr")};
  }

 private:
  static constexpr const char* kNames =
      R"(PATH=$(dirname )" FLBC_PROGRAM R"():$PATH V='--vertices 200'
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
  std::istringstream lines(GetParam());
  std::string advice, line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    SCOPED_TRACE(line);
    if (line.rfind("# ", 0) == 0) {
      advice = line.substr(2);
      ASSERT_TRUE(std::getline(lines, line));
      SCOPED_TRACE(line);
      ASSERT_EQ(status_of("rm -rf row && cp -a base row"), 0);
      const auto refused = shell(line.substr(2), "row");
      EXPECT_EQ(refused.status, line[0] - '0') << refused.errors;
      expect_piece(refused.output + refused.errors, advice);
    } else {
      const auto done = shell(line, "row");
      EXPECT_EQ(done.status, 0) << done.errors;
      expect_no_piece(done.errors, advice);
    }
  }
}
INSTANTIATE_TEST_SUITE_P(On, Advice, ::testing::Values(kUsage, kOutside, kRuns, kFiles, kSolver));

}  // namespace
}  // namespace flbc::testing
