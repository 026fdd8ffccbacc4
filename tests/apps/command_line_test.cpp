// SPDX-License-Identifier: BSD-3-Clause
// The program as its users and their scripts see it: files, messages, exit status.
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include "flbc/io/mesh_io.h"
#include "front/estimate.h"
#include "support/command_line.h"
#include "support/vtu_fields.h"

namespace flbc::testing {
namespace {

namespace fs = std::filesystem;

using CommandLine = CommandLineTest;

struct SolveSamples : CommandLineTest, ::testing::WithParamInterface<const char*> {
  // Solves a sample at its model and on its mesh, and checks the files against each other.
  template <int Dim>
  void expect_solved(const std::string& domain_file) const {
    const auto cage_file = std::string(GetParam()) + "_cage.obj";
    const auto model_file = std::string(GetParam()) + "_model.obj";
    expect("solve " + cage_file + " -o w.mtx --vertices 2000 --model " + model_file +
           " --save-domain " + domain_file + " --report r.json");
    const auto cage = std::get<Cage<Dim>>(io::to_cage(io::read_polygons(cage_file), cage_file));
    const auto model = points_in<Dim>(model_file);
    const auto rows = io::read_weights("w.mtx").dense();
    const auto quality = measure_quality(cage.points, model, rows);
    EXPECT_LT(quality.max_partition_error, 1e-12);
    EXPECT_LT(quality.max_reproduction_error, 1e-12);
    EXPECT_GT(quality.min_weight, -0.05);

    const auto report = json_in("r.json");
    for (const char* key :
         {"method", "dim", "control_points", "vertices", "cells", "iterations", "converged",
          "objective", "seconds", "min_weight", "max_partition_error", "max_reproduction_error",
          "version", "options"}) {
      EXPECT_TRUE(report.contains(key)) << key;
    }
    EXPECT_EQ(report["dim"], Dim);
    EXPECT_EQ(report["converged"], true);
    EXPECT_EQ(report["min_weight"].get<double>(), quality.min_weight);
    const auto domain = io::read_domain<Dim>(domain_file);
    EXPECT_EQ(report["vertices"], domain.num_vertices());
    EXPECT_EQ(report["cells"], domain.num_cells());
  }
};

TEST_P(SolveSamples, AtTheirModels) {
  GetParam()[0] == '2' ? expect_solved<2>("d.obj") : expect_solved<3>("d.mesh");
}
INSTANTIATE_TEST_SUITE_P(CommandLine, SolveSamples,
                         ::testing::Values("2d/figure", "2d/letter", "2d/ring", "3d/limb",
                                           "3d/star", "3d/torus"));

TEST_F(CommandLine, ScriptsMayUseTheFormerNameOfTheMethod) {
  expect("solve 2d/letter_cage.obj --vertices 300 -q --method value -o w.npy --report r.json");
  EXPECT_EQ(json_in("r.json")["method"], "weights");
  expect_no_piece(run("solve --help").output, "|value");
}

// Scripts name the model by --model.
TEST_F(CommandLine, DrawsTheSameModelByEitherName) {
  const std::string cage = "3d/star_cage.obj", model = "3d/star_model.obj";
  expect("solve " + cage + " --method meanvalue -q --model " + model + " -o w.npy");
  const auto rest = model + " --weights w.npy --width 300 --cage " + cage + " -o ";
  expect("draw " + rest + "p.svg");
  expect("draw --model " + rest + "q.svg");
  EXPECT_EQ(slurp("p.svg"), slurp("q.svg"));
  expect_refused("draw " + cage + " --model " + rest + "r.svg", 1, "cannot be combined");
}

// Weights of a model by this method need no mesh, but their gradients do.
TEST_F(CommandLine, GradientsOfAModelByAMethodWithoutAMesh) {
  expect(
      "solve 2d/letter_cage.obj --method meanvalue -q --model 2d/letter_model.obj -o w.npy "
      "--gradients g.npy");
  EXPECT_EQ(io::read_weights("g.npy").num_points(), io::read_weights("w.npy").num_points());
}

TEST_F(CommandLine, ParserNamesTheCommandAndVersionTheComponents) {
  const auto help = run("--help").output;
  const auto list = help.substr(help.find("Commands:"));
  const std::regex command(R"(\n  ([a-z]+) +[a-z])");
  int count = 0;
  for (std::sregex_iterator at(list.begin(), list.end(), command), end; at != end; ++at, ++count) {
    const auto refused = run((*at)[1].str() + " --no-such-option");
    EXPECT_EQ(refused.status, 1) << refused.errors;
    EXPECT_EQ(refused.errors.find("flbc " + (*at)[1].str() + ": "), 0U) << refused.errors;
  }
  EXPECT_GE(count, 14) << help;
  const auto version = run("--version").output;
  for (const char* component : {"\nwith", "CGAL (", "TetGen ("}) expect_piece(version, component);
  // Between releases, with the commit where there is a repository.
  EXPECT_TRUE(
      std::regex_search(version, std::regex("^flbc [0-9.]+(-dev(, commit [0-9a-f]{7,})?)?\n")));
}

// The progress line fits one.
TEST_F(CommandLine, ProgressIsForTerminalsOnly) {
  const std::string solve = "solve 3d/limb_cage.obj --method gradient -o w.npy --vertices ";
  expect_no_piece(expect(solve + "300").errors, "iteration ");
  if (!has_program("script")) GTEST_SKIP() << "no script(1)";
  ASSERT_EQ(
      status_of("script -qec '" FLBC_PROGRAM " " + solve + "800' log.txt >/dev/null </dev/null"),
      0);
  const auto text = slurp("log.txt");
  const std::string begin = "\rsolving: iteration ";
  int last = 0;
  for (auto at = text.find(begin); at != std::string::npos; at = text.find(begin, at + 1)) {
    EXPECT_LT(text.find("\033[K", at) - at, 80U);
    const int iteration = std::stoi(text.substr(at + begin.size()));
    EXPECT_GE(iteration, last);
    last = iteration;
  }
  EXPECT_GT(last, 0);
}

TEST_F(CommandLine, MessagesThatNobodyReadsDoNotEndASolve) {
  const std::string solve =
      FLBC_PROGRAM " solve 2d/ring_cage.obj --method harmonic --vertices 500 -o ";
  EXPECT_EQ(status_of("bash -c 'set -o pipefail; " + solve + "w.npy 2>&1 | true'"), 0);
  expect("solve 2d/ring_cage.obj --method harmonic --vertices 500 -o plain.npy");
  EXPECT_EQ(slurp("w.npy"), slurp("plain.npy"));
}

TEST_F(CommandLine, TellsWhatIsInAFile) {
  auto result = expect("info 3d/torus_cage.obj");
  expect_piece(result.output, "a sound 3D cage of 48 control points and 96 triangles");
  result = run("info 2d/ring_cage.obj");
  expect_piece(result.output, "a sound 2D cage of 22 control points");
  expect("solve 2d/ring_cage.obj --method harmonic --vertices 500 -o w.npy");
  result = run("info w.npy");
  expect_piece(result.output, "for 22 control points");
  expect("convert -q w.npy -o w.mtx");
  const auto words = [](const std::string& info) { return info.substr(info.find(": ")); };
  EXPECT_EQ(words(run("info w.mtx").output), words(result.output));
  expect("mesh 3d/torus_cage.obj --vertices 800 -q -o d.mesh");
  expect("convert -q d.mesh -o d.msh");
  result = expect("info d.msh");
  expect_piece(result.output, " tetrahedra, volume ");
  EXPECT_EQ(words(result.output), words(run("info d.mesh").output));
  io::write_weights("p.npy", SparseWeights(Eigen::MatrixXd{{0.0, 2.0}, {1.0, 5.0}, {-1.0, 3.0}}));
  EXPECT_EQ(expect("info p.npy").output, "p.npy: 2 points in 3D\n  from (0, 1, -1) to (2, 5, 3)\n");
  result = expect("info " + file("scan.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"));
  expect_piece(result.output, "4 vertices");
  expect_piece(result.output, "no facets and no polylines");
  std::string scan = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int face = 0; face <= 100000; ++face) scan += "f 1 2 3\n";
  expect_piece(expect("info " + file("scan.obj", scan)).output, "not checked as a cage");
  expect("info missing.obj", 4);
}

// Where cells of good shape take more vertices than were asked for, there are more, and a note.
TEST_F(CommandLine, TooFewVerticesBecomeMore) {
  expect("mesh 2d/letter_cage.obj --vertices 3 -o d.obj", 0, "instead of 3 (--vertices)");
  EXPECT_GT(io::read_domain<2>("d.obj").num_vertices(), 3);
  expect_refused("mesh 2d/letter_cage.obj --vertices 2000000000 -o e.obj", 1, "too many; at most");
}

TEST_F(CommandLine, ALostOutputIsAFailure) {
  for (const std::string arguments :
       {"info 3d/limb_cage.obj", "--help", "--version", "solve --help"}) {
    EXPECT_EQ(status_of(FLBC_PROGRAM " " + arguments + " >/dev/full 2>errors.txt"), 4) << arguments;
    expect_piece(slurp("errors.txt"), "standard output");
  }
}

TEST_F(CommandLine, LongSolvesAreAnnounced) {
  const std::string cage = "3d/limb_cage.obj";
  expect_no_piece(expect("info " + cage).output, "takes about");
  const auto seconds = [&](const std::string& vertices) {
    const auto text = expect("info " + cage + " --estimate" + vertices).output;
    const auto at = text.find("takes about ");
    EXPECT_NE(at, std::string::npos) << text;
    return std::stod(text.substr(at + 12));
  };
  EXPECT_GT(seconds(" --vertices 50000"), 4 * seconds(""));
  expect_piece(expect("info " + cage + " --estimate --vertices 10000000").output, " min and ");
  expect("info " + cage + " --vertices 500", 1, "requires --estimate");
  const auto quick = expect("solve " + cage + " --vertices 500 -o w.npy");
  expect_no_piece(quick.errors, "this may take");
}

// Each row of results is one solve. Meshes in 2D have fewer cells per vertex.
TEST(Estimates, AreNearTheStoredResults) {
  int rows = 0;
  for (const char* name : {"models", "speed"}) {
    std::ifstream file(FLBC_SOURCE_DIR "/docs/results/" + std::string(name) + ".csv");
    std::map<std::string, std::size_t> columns;
    for (std::string line; std::getline(file, line);) {
      if (line[0] == '#') continue;
      std::vector<std::string> cells;
      std::istringstream text(line);
      for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
      if (columns.empty()) {
        for (std::size_t k = 0; k < cells.size(); ++k) columns[cells[k]] = k;
        continue;
      }
      const auto number = [&](const char* column) { return std::stod(cells[columns.at(column)]); };
      const auto vertices = static_cast<Index>(number("vertices"));
      const auto made =
          app::estimate_solve(number("cells") < 2.5 * vertices ? 2 : 3,
                              static_cast<Index>(number("control_points")), vertices, {});
      const double seconds = made.seconds / number("total_seconds");
      const double bytes = made.bytes / number("peak_mebibytes") / (1 << 20);
      EXPECT_TRUE(seconds > 0.39 && seconds < 2 && bytes > 0.73 && bytes < 1.4)
          << line << ": " << seconds << ' ' << bytes;
      ++rows;
    }
  }
  EXPECT_GE(rows, 18);
}

// Job systems close them.
TEST_F(CommandLine, ClosedStreamsAreNoObstacle) {
  const auto mesh = std::string(FLBC_PROGRAM) + " mesh 3d/limb_cage.obj --vertices 500 -o m.mesh";
  for (const std::string streams : {" <&- >&-", " <&- 2>&-", " >&- 2>&-", " <&- >&- 2>&-"}) {
    fs::remove("m.mesh");
    EXPECT_EQ(status_of(mesh + streams), 0) << streams;
    EXPECT_GE(io::read_domain<3>("m.mesh").num_vertices(), 400) << streams;
  }
  const auto info = std::string(FLBC_PROGRAM) + " info 3d/limb_cage.obj";
  EXPECT_EQ(status_of(info + " >&- 2>&-"), 4);
}

TEST_F(CommandLine, LimitsOfTheSystemEndInMessages) {
  const auto status_within = [&](const std::string& limit, const std::string& arguments) {
    return status_of("bash -c '" + limit + " " FLBC_PROGRAM " " + arguments + "' 2>errors.txt");
  };
  const std::string mesh = "mesh 3d/limb_cage.obj --vertices 3000 -o m.mesh";
  EXPECT_EQ(status_within("ulimit -f 10;", mesh), 4);
  EXPECT_FALSE(fs::exists("m.mesh"));
  const std::string solve = "solve 2d/letter_cage.obj --vertices 2000 -o w.npy";
  EXPECT_EQ(status_within("ulimit -s 128;", mesh), 0) << slurp("errors.txt");
  EXPECT_EQ(status_within("OMP_NUM_THREADS=100000", solve), 0) << slurp("errors.txt");
#ifndef __SANITIZE_ADDRESS__  // which takes terabytes of addresses
  // OpenBLAS would try for ever to get its buffer.
  EXPECT_EQ(status_within("ulimit -v 200000; export OMP_NUM_THREADS=1; timeout 60", solve), 5);
  EXPECT_EQ(status_within("ulimit -v 120000; export OMP_NUM_THREADS=1;",
                          "run 3d/limb_cage.obj -o out --vertices 8000 --mesher tetgen -q"),
            5);
  expect_piece(slurp("errors.txt"), "out of memory");
  expect_piece(slurp("out/report.json"), "\"failed\": \"out of memory\"");
#endif
}

TEST_F(CommandLine, WrongUsageIsStatus1) {
  const std::string cage = "2d/letter_cage.obj";
  const std::string o = " -o w.npy";
  expect_refused("", 1, "subcommand");
  expect_refused("solve", 1, "CAGE");
  expect_refused("solve " + cage, 1, "flbc solve: --output is required");
  expect_refused("solve " + cage + o + " --vertices -5", 1, "--vertices");
  expect_refused("solve " + cage + o + " --method magic", 1,
                 "invalid value 'magic'; choose from weights|");
  expect_refused("solve " + cage + o + " --tolerance=-1", 1, "tolerance must be positive");
  expect_refused("solve " + cage + o + " --threads -1", 1, "threads must be in");
  expect_refused("solve " + cage + o + " --embed", 1, "--model");
  expect_refused("solve " + cage + o + " --domain a.obj --vertices 100", 1, "--domain");
  expect_refused("solve " + cage + " -o w.xls", 1, ".mtx, .npy, .csv or .npz");
  expect_refused("mesh " + cage + " -o d.mesh", 1, ".obj, .off or .vtu");
  for (const std::string count : {"0", "abc", "1e9", "99999999999"}) {
    expect_refused("solve " + cage + o + " --vertices " + count, 1, "not '" + count + "'");
  }
  expect_refused("mesh '' -o d.obj", 1, "CAGE: the value is empty");
}

TEST_F(CommandLine, OptionsThatNothingReadsAreWrongUsage) {
  const std::string cage = "2d/letter_cage.obj";
  const auto solve = "solve " + cage + " --vertices 300 -q -o w.npy" + ' ';
  for (const std::string method : {"harmonic", "meanvalue"}) {
    for (const std::string option :
         {"--tolerance 1e-5", "--penalty 10", "--phi linear", "--precision single",
          "--max-iterations 9", "--distances exact", "--gap 1e-3", "--certify"}) {
      const auto name = option.substr(0, option.find(' '));
      expect_refused(solve + "--method " + method + ' ' + option, 1,
                     name + ": the method " + method + " does not use it");
    }
  }
  for (const std::string method : {"gradient", "paper", "lbc2014"}) {
    expect_refused(solve + "--method " + method + " --locality l.json", 1,
                   "--locality: the method " + method + " does not use it");
  }
  expect_refused(solve + "--outside nearest", 1, "--outside: no model is given");
  for (const std::string way : {"", "--auto-cage "}) {
    expect_refused("run " + cage + ' ' + way + "--method harmonic --tolerance 1 -q -o out", 1,
                   "--tolerance: the method harmonic");
  }
  expect("mesh " + cage + " --vertices 300 -q -o d.obj");
  expect_refused("solve " + cage + " --domain d.obj --mesher cgal -q -o w.npy", 1,
                 "--mesher: --domain gives the mesh");
  expect_refused("solve " + cage + " --domain d.obj --phi phi.npy --distances exact -q -o w.npy", 1,
                 "--distances: --phi gives a file of phi");
}

TEST_F(CommandLine, ResultsReplaceNeitherInputsNorEachOther) {
  const std::string content = slurp("2d/letter_cage.obj");
  const auto cage = file("cage.obj", content);
  file("w.npy", "old");
  fs::create_hard_link("w.npy", "w.json");
  expect_refused("mesh " + cage + " -o ./cage.obj", 1, "would replace this input file");
  expect_refused("solve " + cage + " -o x.npy --save-domain " + cage, 1,
                 "would replace this input file");
  expect_refused("solve " + cage + " -o w.npy --report w.json", 1, "two results");
  EXPECT_EQ(slurp(cage), content);
  EXPECT_EQ(slurp("w.npy"), "old");
}

TEST_F(CommandLine, ReportsAreValidWhateverTheFilesAreCalled) {
  const auto cage = file("bad\xff name.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  expect("solve '" + cage + "' -o w.npy --vertices 100 -q --method harmonic --report r.json");
  EXPECT_TRUE(nlohmann::json::accept(slurp("r.json")));
}

TEST_F(CommandLine, IoFailureIsStatus4) {
  expect_refused("solve missing.obj -o w.npy", 4, "missing.obj");
  expect_refused("solve 2d/letter_cage.obj -o no/folder/w.npy", 4, "w.npy");
  expect_refused("solve 2d/letter_cage.obj -o w.npy --report no/r.json", 4, "r.json");
  expect_refused("solve 2d/letter_cage.obj -o w.npy --domain no.obj", 4, "no.obj");
  expect_refused("solve " + std::string(FLBC_MESHES_DIR) + "/2d -o w.npy", 1, "2d");
}

TEST_F(CommandLine, BadCagesAreStatus2AndNamed) {
  file("bad.obj", "v 0 0 0\nv 1 nan 0\nv 0 1 0\n");
  expect_refused("solve bad.obj -o w.npy", 2, "bad.obj:2");
  file("bad.obj", "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nl 1 2 3 4 1\n");
  expect_piece(expect("solve bad.obj -o w.npy", 2, "(0.5, 0.5)").errors, "bad.obj");
}

// Lists of points are models, and functions are fields of a mesh.
TEST_F(CommandLine, PointsAsNumbersAndFunctionsAsFields) {
  const std::string cage = "2d/letter_cage.obj", model = "2d/letter_model.obj";
  const auto solve = "solve " + cage + " --vertices 600 --method harmonic -q -o ";
  const auto points = points_in<2>(model);
  io::write_weights("p.npy", points);
  io::write_weights("p.csv", points);
  expect(solve + "expected.npy --model " + model + " --save-domain d.vtu");
  const auto expected = io::read_weights("expected.npy").dense();
  for (const std::string list : {"p.npy", "p.csv"}) {
    expect(solve + "w.npy --model " + list);
    EXPECT_EQ(io::read_weights("w.npy").dense(), expected) << list;
    expect("check " + cage + " --model " + list + " --weights w.npy");
    expect("sparsify w.npy --cage " + cage + " --points " + list + " -k 4 -q -o s.mtx");
  }
  expect(solve + "w.npy --model " + file("q.csv", "1,2,3\n"), 2,
         "q.csv: holds 1 rows of 3 numbers; points need 2 coordinates");

  const auto fields = fields_in_vtu(slurp("d.vtu"));
  expect(solve + "w.npy --model " + model + " --save-domain d.obj");
  expect("solve " + cage + " --method harmonic -q --domain d.obj -o v.npy");
  const auto weights = io::read_weights("v.npy").dense();
  ASSERT_EQ(fields.size(), 3 * static_cast<std::size_t>(weights.rows()));
  for (std::size_t i = 0; i < static_cast<std::size_t>(weights.rows()); ++i) {
    EXPECT_EQ(fields[i].name, "w_" + std::to_string(i));
    const Eigen::VectorXd row = weights.row(static_cast<Eigen::Index>(i));
    EXPECT_LT((fields[i].values - row).cwiseAbs().maxCoeff(), 1e-9);
  }
}

// Which other coordinates do not minimize.
TEST_F(CommandLine, ReportsOfOtherCoordinatesHaveAnObjective) {
  expect("mesh 2d/letter_cage.obj --vertices 800 -q -o d.obj");
  const auto objective = [&](const std::string& method) {
    expect("solve 2d/letter_cage.obj --domain d.obj -q -o w.npy --report r.json --method " +
           method);
    return json_in("r.json")["objective"].get<double>();
  };
  const double least = objective("weights");
  EXPECT_GT(objective("meanvalue"), 1.01 * least);
  EXPECT_GT(objective("harmonic"), 1.01 * least);
  EXPECT_LT(objective("weights --smoothness 0"), least);
}

TEST_F(CommandLine, PhiMayComeFromAFile) {
  for (const auto& [name, dim] : {std::pair("2d/letter", 2), std::pair("3d/star", 3)}) {
    const auto cage = std::string(name) + "_cage.obj";
    const std::string mesh = dim == 2 ? "d.obj" : "d.mesh";
    expect("mesh " + cage + " --vertices 600 -q -o " + mesh);
    const auto cells =
        dim == 2 ? io::read_domain<2>(mesh).num_cells() : io::read_domain<3>(mesh).num_cells();
    const auto points = static_cast<Eigen::Index>(io::read_polygons(cage).points.size());
    WeightMatrix phi = WeightMatrix::Ones(points, cells);
    io::write_weights("ones.npy", phi);
    const auto solve = "solve " + cage + " --domain " + mesh + " -q --tolerance 1e-8 --phi ";
    expect(solve + "ones.npy -o a.npy --report a.json");
    expect(solve + "constant -o b.npy");
    const auto ours = io::read_weights("a.npy").dense();
    EXPECT_LT((ours - io::read_weights("b.npy").dense()).cwiseAbs().maxCoeff(), 1e-2);
    expect_piece(slurp("a.json"), "ones.npy");

    phi(1, 2) = -1;
    io::write_weights("negative.npy", phi);
    expect_refused(solve + "negative.npy -o c.npy", 2, "negative.npy");
    io::write_weights("few.npy", WeightMatrix(phi.leftCols(cells - 1)));
    expect_refused(solve + "few.npy -o c.npy", 2, "few.npy");
    expect_refused("solve " + cage + " -q --phi ones.npy -o c.npy", 1, "--domain");
    expect_refused(solve + "steep -o c.npy", 1, "choose from square|linear|sqrt|constant");
  }
}

// The published criterion can be met far from the optimum.
TEST_F(CommandLine, ConvergedFarFromTheOptimumIsTold) {
  const std::string solve =
      "solve 2d/ring_cage.obj --vertices 500 --certify -o w.npy --report r.json --method ";
  const auto paper = expect(solve + "paper");
  const auto report = json_in("r.json");
  EXPECT_EQ(report["status"], "converged");
  EXPECT_GT(report["relative_gap"], 5e-3);
  expect_piece(paper.errors, "above the optimum; lower --tolerance");
  expect_no_piece(expect(solve + "weights").errors, "above the optimum");
}

// The weights are then not unique, so that small changes of them bound nothing.
TEST_F(CommandLine, WithoutSmoothnessTheGapIsTheCriterion) {
  for (const std::string method : {"weights", "gradient"}) {
    const auto solve =
        "solve 2d/ring_cage.obj --vertices 500 -o w.npy --report r.json --method " + method + ' ';
    const auto rough =
        expect(solve + "--smoothness 0", 0, "smoothness 0: several weights may be optimal");
    expect_piece(rough.errors, "iterations, ended by the certified gap");
    EXPECT_EQ(json_in("r.json")["criterion"], "gap");
    EXPECT_LE(json_in("r.json")["relative_gap"], 1e-3);

    const auto estimated = expect(solve + "--smoothness 0 --tolerance 1e-5");
    expect_piece(estimated.errors, "iterations, ended by the estimated error");
    expect_piece(estimated.errors,
                 "% above the minimum (a smaller --tolerance tightens the proof)");

    const auto smooth = expect(solve);
    expect_no_piece(smooth.errors, "smoothness 0");
    expect_no_piece(smooth.errors, "ended by");
    EXPECT_EQ(json_in("r.json")["criterion"], "tolerance");
    EXPECT_EQ(expect(solve + "--smoothness 0 -q").errors, "");
  }
}

TEST_F(CommandLine, NotConvergedIsStatus3AndTheResultIsThere) {
  expect("solve 2d/ring_cage.obj -o w.npy --vertices 1000 --max-iterations 5 --report r.json", 3,
         "not converged within 5 iterations");
  EXPECT_EQ(json_in("r.json")["converged"], false);
  EXPECT_EQ(io::read_weights("w.npy").dense().rows(), 22);
}

// The second mesher where the first one fails.
TEST_F(CommandLine, NetgenMeshesWhatTetgenCannot) {
  // Too thin for cells of good shape.
  file("flat.obj",
       "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 0.0005\nv 1 0 0.0005\nv 0 1 0.0005\n"
       "v 1 1 0.0005\nf 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n");
  const std::string solve =
      "solve flat.obj --vertices 200 --mesh-timeout 4 -o w.npy --report report.json";
  const auto refused = expect(solve + " --mesher tetgen", 2, "TetGen");
  EXPECT_FALSE(std::filesystem::exists("w.npy"));
  if (FLBC_HAS_NETGEN == 0) GTEST_SKIP() << "built without Netgen";
  expect_piece(refused.errors, "--mesher netgen");
  for (const std::string mesher : {"", " --mesher netgen"}) {
    const auto solved = expect(solve + mesher);
    const auto report = json_in("report.json");
    EXPECT_EQ(report["mesher"], "netgen");
    const bool is_second = mesher != " --mesher netgen";
    EXPECT_EQ(solved.errors.find("the mesh was made by netgen") != std::string::npos, is_second)
        << solved.errors;
    const auto weights = io::read_weights("w.npy").dense();
    EXPECT_NEAR(weights.colwise().sum().minCoeff(), 1, 1e-12);
    EXPECT_NEAR(weights.colwise().sum().maxCoeff(), 1, 1e-12);
    EXPECT_GE(weights.minCoeff(), 0);
  }
}

TEST_F(CommandLine, SoundCagesAreMeshedByTheFirst) {
  expect("run 3d/limb_cage.obj --vertices 1000 -q -o out");
  const auto report = json_in("out/report.json");
  EXPECT_EQ(report["solve"]["mesher"], "tetgen");
  EXPECT_EQ(report["mesh"]["mesher"], "tetgen");
}

TEST_F(CommandLine, MeshersOfTheOtherDimensionAreRefused) {
  expect("mesh 3d/limb_cage.obj --mesher cgal -o m.mesh", 1,
         "--mesher cgal: this mesher does not support 3D");
  expect("mesh 2d/ring_cage.obj --mesher tetgen -o m.obj", 1);
  expect("mesh 2d/ring_cage.obj --mesher x -o m.obj", 1);
}

}  // namespace
}  // namespace flbc::testing
