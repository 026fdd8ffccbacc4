// SPDX-License-Identifier: BSD-3-Clause
// flbc run as its users and their scripts see it: it does what the other commands do one by one.
#include "support/command_line.h"
#include "support/model_cages.h"
#include "support/splats.h"

namespace flbc::testing {
namespace {

namespace fs = std::filesystem;

using Names = std::set<std::string>;

class RunCommand : public CommandLineTest {
 protected:
  void expect_run(const std::string& folder, const std::string& arguments, int status,
                  const std::string& words) const {
    expect("run " + arguments + " -o " + folder, status, words);
  }

  Names names_in(const std::string& folder) const {
    Names names;
    if (!fs::exists(folder)) return names;
    for (const auto& entry : fs::directory_iterator(folder)) {
      names.insert(entry.path().filename().string());
    }
    return names;
  }
  nlohmann::json report(const std::string& folder) const {
    return json_in(folder + "/report.json");
  }

  // The command on its own makes the same file.
  void expect_same(const std::string& command, const std::string& own, const std::string& file_made,
                   const std::string& options = "") const {
    SCOPED_TRACE(command);
    const auto result = expect(command + " -o " + own + options);
    EXPECT_FALSE(slurp(own).empty());
    EXPECT_EQ(slurp(own), slurp(file_made));
  }

  void expect_all_that_others_do(const std::string& name, const std::string& domain) const {
    SCOPED_TRACE(name);
    const auto cage = name + "_cage.obj", model = name + "_model.obj";
    const auto pose = name + "_cage_pose.obj";
    const auto result = run("run " + cage + " " + model + " --pose " + pose +
                            " -k 6 --tolerance 1e-4 --vertices 800 -o out");
    ASSERT_EQ(result.status, 0) << result.errors;
    EXPECT_EQ(result.output, "");
    const Names expected{
        domain,         "weights.npy",     "domain_weights.npy", "sparse_weights.mtx",
        "binding.npz",  "deformed.obj",    "model.glb",          "model_8.glb",
        "function.png", "deformation.png", "model.html",         "report.json"};
    EXPECT_EQ(names_in("out"), expected);
    for (const auto& file : expected) {
      expect_piece(result.errors, "  " + file + ' ');
    }
    const auto json = report("out");
    EXPECT_EQ(json["files"].get<Names>(), expected);
    EXPECT_EQ(json["cage"], cage);

    expect_same("solve " + cage + " --vertices 800 --model " + model + " --tolerance 1e-4", "w.npy",
                "out/weights.npy", " --save-domain " + domain);
    EXPECT_EQ(slurp(domain), slurp("out/" + domain));
    expect_same("solve " + cage + " --domain " + domain + " --tolerance 1e-4", "d.npy",
                "out/domain_weights.npy", " --report solve.json");
    expect_same("sparsify w.npy --cage " + cage + " --points " + model +
                    " -k 6 --reduction poisson --pose " + pose,
                "s.mtx", "out/sparse_weights.mtx", " --report sparsify.json");
    expect_same("deform " + model + " --weights s.mtx --rest " + cage + " --pose " + pose, "m.obj",
                "out/deformed.obj");
    expect_same("export " + model + " --weights s.mtx --cage " + cage + " --fps 1 --pose " + cage +
                    " " + pose,
                "m.glb", "out/model_8.glb");
    expect_same("export " + model + " --weights s.mtx --cage " + cage + " -k 4 --fps 1 --pose " +
                    cage + " " + pose,
                "m4.glb", "out/model.glb");
    const auto shown = name[0] == '2' ? domain + " --weights d.npy" : model + " --weights w.npy";
    expect_same("draw " + shown + " --cage " + cage + " --control-point " +
                    json["pictures"]["control_point"].dump(),
                "f.png", "out/function.png");

    // All reports are in one.
    EXPECT_NEAR(json["sparsify"]["deformation_error"]["rms"],
                json_in("sparsify.json")["error"]["deformation"]["poses"][0]["rms"], 1e-15);
    EXPECT_EQ(json["sparsify"]["after"]["max_nonzeros"], 6);
    const auto solved = json_in("solve.json");
    EXPECT_EQ(json["solve"]["objective"], solved["objective"]);
    EXPECT_EQ(json["solve"]["converged"], true);
    expect("check " + cage + " --weights d.npy --domain " + domain + " --json check.json");
    const auto checked = json_in("check.json");
    EXPECT_EQ(json["check"]["cage"], checked["cage"]);
    EXPECT_EQ(json["check"]["weights"]["worst"], checked["weights"]["worst"]);
    EXPECT_EQ(json["deform"][0]["file"], "deformed.obj");
    EXPECT_GT(json["deform"][0]["largest_displacement"], 0.1);
    EXPECT_EQ(json["export"]["bytes"], fs::file_size("out/model.glb"));
    EXPECT_LE(json["export"]["max_influences"], 4);
    EXPECT_EQ(json["export"]["full"]["bytes"], fs::file_size("out/model_8.glb"));
    for (const char* step :
         {"mesh", "solve", "check", "sparsify", "deform", "export", "pictures", "page"})
      EXPECT_GE(json["seconds"][step], 0) << step;
  }
};

TEST_F(RunCommand, DoesWhatTheOthersDoIn2D) {
  expect_all_that_others_do("2d/figure", "domain.obj");
}
TEST_F(RunCommand, DoesWhatTheOthersDoIn3D) {
  expect_all_that_others_do("3d/limb", "domain.mesh");
}

TEST_F(RunCommand, MovesTheMeshIfThereIsNoModel) {
  for (const std::string name : {"2d/figure", "3d/limb"}) {
    SCOPED_TRACE(name);
    const std::string extension = name[0] == '2' ? ".obj" : ".mesh";
    const auto pose = name + "_cage_pose.obj";
    expect_run(
        "out",
        name + "_cage.obj --vertices 500 --method harmonic --non-negative project --pose " + pose,
        0, "of which");
    const auto domain = "out/domain" + extension;
    EXPECT_EQ(names_in("out"),
              (Names{"domain" + extension, "weights.npy", "sparse_weights.mtx", "binding.npz",
                     "deformed" + extension, "model.glb", "model_8.glb", "function.png",
                     "deformation.png", "model.html", "report.json"}));
    expect_same("deform " + domain + " --weights out/binding.npz --pose " + pose, "m" + extension,
                "out/deformed" + extension);
    fs::remove_all("out");
  }
}

TEST_F(RunCommand, SequencesAndWhatIsLeftOfThem) {
  const auto pose = slurp("2d/figure_cage_pose.obj");
  for (const int k : {1, 2, 3}) file("pose_" + std::to_string(k) + ".obj", pose);
  fs::create_directory("out");
  file("out/notes.txt", "mine");
  file("out/deformed_009.obj", "mine, too");
  const std::string common =
      "2d/figure_cage.obj 2d/figure_model.obj --method harmonic --vertices 200 --reduction "
      "quadratic";
  expect_run("out", common + " --pose pose_%d.obj", 0, "3 poses; largest");
  auto names = names_in("out");
  for (const char* name : {"deformed_001.obj", "deformed_002.obj", "deformed_003.obj", "notes.txt",
                           "deformed_009.obj"}) {
    EXPECT_EQ(names.count(name), 1U) << name;
  }
  EXPECT_EQ(report("out")["export"]["times"].size(), 4U);
  EXPECT_EQ(report("out")["deform"].size(), 3U);

  // The next run removes all results of this one, but no other files.
  expect_run("out", common + " --pose pose_1.obj pose_2.obj", 0, "2 poses");
  names = names_in("out");
  EXPECT_EQ(names.count("deformed_000.obj"), 1U);
  EXPECT_EQ(names.count("deformed_002.obj"), 0U);
  // It does not remove its input files.
  fs::copy_file("pose_2.obj", "out/deformed_001.obj", fs::copy_options::overwrite_existing);
  expect_run("out", common + " --pose out/deformed_001.obj", 0, "largest");
  EXPECT_EQ(slurp("out/deformed_001.obj"), pose);
  fs::remove("out/deformed_001.obj");
  expect_run("out", common, 0, "influences per vertex");
  EXPECT_EQ(names_in("out"),
            (Names{"domain.obj", "weights.npy", "domain_weights.npy", "sparse_weights.mtx",
                   "binding.npz", "model.glb", "model_8.glb", "function.png", "model.html",
                   "report.json", "notes.txt", "deformed_009.obj"}));
  EXPECT_EQ(slurp("out/notes.txt"), "mine");
}

TEST_F(RunCommand, FilesOfOthersAreNotReplaced) {
  fs::create_directory("out");
  file("precious.txt", "mine");
  file("out/below.txt", "mine");
  const std::string common =
      "2d/letter_cage.obj --method harmonic --vertices 200 --reduction quadratic";
  for (const char* name : {"weights.npy", "model.glb", "report.json"}) {
    file(std::string("out/") + name, "mine");
    expect_run("out", common, 1,
               std::string("out/") + name + ": exists and is not from an earlier flbc run");
    EXPECT_EQ(slurp(std::string("out/") + name), "mine");
    EXPECT_EQ(names_in("out").size(), 2U);
    fs::remove(std::string("out/") + name);
  }
  // Manipulated reports cannot remove anything except results.
  for (const char* report :
       {R"({"command": "other", "files": ["below.txt"]})",
        R"({"command": "run", "files": ["../precious.txt", "..", "", 7, "below.txt"]})",
        R"({"command": "run", "files": ["../precious.txt", "..", ".", "", "/", "report.json"]})"}) {
    file("out/report.json", report);
    expect_run("out", common + " --force", 0, "influences per vertex");
    EXPECT_TRUE(fs::exists("precious.txt"));
    EXPECT_TRUE(fs::exists("out/below.txt"));
  }
}

TEST_F(RunCommand, AnInterruptedRunIsNoObstacle) {
  const std::string program = FLBC_PROGRAM;
  const auto endless = program +
                       " run 2d/letter_cage.obj -q -o out --method paper --tolerance 1e-15 "
                       "--max-iterations 100000000 --vertices 2000";
  const auto kill = "sh -c '" + endless +
                    " & for k in $(seq 1000); do [ -e out/domain.obj ] && break; sleep 0.02; done; "
                    "kill -9 $!; wait; true' 2>&1";
  ASSERT_EQ(status_of(kill), 0);
  EXPECT_EQ(names_in("out").count("domain.obj"), 1U);
  EXPECT_EQ(names_in("out").count("weights.npy"), 0U);
  EXPECT_EQ(report("out")["unfinished"], true);
  expect("run 2d/letter_cage.obj -q -o out --method harmonic --vertices 200");
  EXPECT_FALSE(report("out").contains("unfinished"));
}

TEST_F(RunCommand, StepsThatFailAreNamedAndLeaveWhatWasDone) {
  // Outside: nothing can be solved.
  expect_run("out", "2d/figure_cage.obj 2d/ring_model.obj", 2,
             "flbc: step mesh: 2d/ring_model.obj: ");
  EXPECT_EQ(names_in("out"), Names{"report.json"});
  EXPECT_EQ(report("out")["failed"].get<std::string>().substr(0, 10), "step mesh:");
  // Messages of the library name options of the program, on the terminal and in the report.
  const std::string too_many = "step mesh: --vertices: 999999999 are too many";
  expect_run("many", "2d/figure_cage.obj --vertices 999999999", 1,
             std::string("flbc: ") + too_many);
  EXPECT_EQ(report("many")["failed"].get<std::string>().rfind(too_many, 0), 0U);
  // A folder where a file should go.
  fs::create_directories("busy/model.glb/x");
  const std::string common =
      "2d/letter_cage.obj 2d/letter_model.obj --method harmonic --vertices 200 "
      "--reduction quadratic";
  expect_run("busy", common + " --force", 4, "flbc: step export: ");
  // What needs no skin is there.
  EXPECT_EQ(names_in("busy"),
            (Names{"domain.obj", "weights.npy", "domain_weights.npy", "sparse_weights.mtx",
                   "binding.npz", "model.glb", "function.png", "model.html", "report.json"}));
  EXPECT_EQ(report("busy")["files"].size(), 8U);
  EXPECT_FALSE(report("busy")["seconds"].contains("export"));
  // Not converged is no failure of a step.
  expect_run("early", "2d/letter_cage.obj --max-iterations 10 --vertices 500 -q", 3,
             "not converged within 10 iterations");
  EXPECT_EQ(names_in("early").size(), 9U);
  EXPECT_EQ(report("early")["solve"]["converged"], false);
}

TEST_F(RunCommand, RefusesBeforeAnyWorkIsDone) {
  const std::string cage = "2d/figure_cage.obj";
  expect_run("out", cage + " -k 2", 1, "must be at least 3 in 2D");
  expect_run("out", cage + " --control-point 40", 1, "--control-point must be in [0, 39]");
  expect_run("out", cage + " --fps 0.5", 1, "--fps requires --pose");
  expect_run("out", cage + " --embed", 1, "--embed: MODEL is missing");
  expect_run("out", "3d/limb_model.obj", 1, "did you mean --auto-cage?");
  expect_run("out", cage + " --pose 2d/letter_cage.obj", 2, "has 24 vertices, but");
  expect_run("out", cage + " --pose no_%d.obj", 4, "there is neither");
  file("file", "");
  EXPECT_FALSE(fs::exists("out"));
  expect_run("file", cage, 4, "file: cannot make this folder");
  // An input that would be replaced.
  fs::create_directory("out");
  file("out/domain.obj", slurp(cage));
  expect_run("out", "out/domain.obj", 1, "the result would replace this input file");
  EXPECT_EQ(slurp("out/domain.obj"), slurp(cage));
}

TEST_F(RunCommand, SplatsGetACageAndMoveAsByDeform) {
  const auto model = io::read_polygons("3d/limb_model.obj");
  const auto splats = random_splats(io::to_points<3>(model, ""), 1);
  const auto splat_file = file("splats.ply", splats.text());
  expect_run("out", splat_file + " --auto-cage --vertices 800", 0, " --weights out/binding.npz");
  Eigen::Matrix3d a;
  a << 0, -2, 0, 1, 0, 0.5, 0, 0, 1;
  moved("out/cage.obj", "pose.obj", [&](const auto& point) { return a * point; });
  expect_run("posed", "out/cage.obj " + splat_file + " --vertices 800 --pose pose.obj", 0,
             "deformed.ply");
  const auto posed = splats.parse(slurp("posed/deformed.ply"));
  for (Eigen::Index p = 0; p < posed.values.cols(); ++p) {
    const Vector<3> before = splats.values.col(p).head<3>().cast<double>();
    EXPECT_LT((posed.values.col(p).head<3>().cast<double>() - a * before).norm(), 1e-4);
    const Eigen::Matrix3d expected = a * splats.covariance(p) * a.transpose();
    EXPECT_LT((posed.covariance(p) - expected).norm(), 1e-4 * expected.norm());
  }
  const auto command = "deform " + splat_file + " --weights posed/weights.npy --pose pose.obj";
  expect(command + " -q -o own.ply", 1, "need a binding");
  expect_same("deform " + splat_file + " --weights posed/binding.npz --pose pose.obj -q", "own.ply",
              "posed/deformed.ply");
  // They have no weights of their own to mirror or to mask.
  expect_run("out", splat_file + " --auto-cage --symmetric z --vertices 800 --force", 0, "out");
  expect_run("out", "out/cage.obj " + splat_file + " --symmetric z", 1,
             "--symmetric: there is no model");
  const auto masks = file("masks.json", "[{\"control_points\": [0], \"region\": [0]}]");
  expect_run("out", "out/cage.obj " + splat_file + " --locality " + masks, 1,
             "which have no weights of their own");
}

// The same surface or outline, with its vertices in another order.
void renumber(const std::string& from, const std::string& to) {
  auto soup = io::read_polygons(from);
  std::vector<Index> numbers(soup.points.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  std::shuffle(numbers.begin(), numbers.end(), std::mt19937(1));
  const auto points = soup.points;
  for (std::size_t v = 0; v < points.size(); ++v) soup.points[numbers[v]] = points[v];
  for (auto* polygons : {&soup.polygons, &soup.polylines}) {
    for (auto& polygon : *polygons) {
      for (Index& vertex : polygon) vertex = numbers[vertex];
    }
  }
  io::write_model(to, {soup});
}

// With and without a rest cage.
TEST_F(RunCommand, RenumberedPosesAreRefusedByAllCommands) {
  for (const std::string name : {"2d/figure", "3d/limb"}) {
    SCOPED_TRACE(name);
    const auto cage = name + "_cage.obj", model = name + "_model.obj";
    expect("solve " + cage + " --model " + model + " --method meanvalue -o w.npy");
    renumber(cage, "pose.obj");
    const std::string words = "pose.obj: face 0 joins vertices ";
    expect_refused("run " + cage + " " + model + " --pose pose.obj -o out", 2, words);
    expect_refused(
        "export " + model + " --weights w.npy --cage " + cage + " --pose pose.obj -o skin.glb", 2,
        words);
    const auto deform = "deform " + model + " --weights w.npy -o moved_%d.obj ";
    expect_refused(deform + "--rest " + cage + " --pose pose.obj", 2, words);
    expect_refused(deform + "--pose " + cage + " pose.obj", 2, words);
  }
}

TEST_F(RunCommand, PosesOfAnotherCageWithAsManyPointsAreRefused) {
  const std::string points =
      "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 3 0 0\nv 4 0 0\nv 4 1 0\nv 3 1 0\n";
  file("cage.obj", points + "l 1 2 3 4 1\nl 5 6 7 8 5\n");
  file("other.obj", points + "l 1 2 3 4 5 6 7 8 1\n");
  expect_refused("run cage.obj --pose other.obj -o out", 2,
                 "other.obj: face 0 joins vertices 0 1 2 3 4 5 6 7, but cage.obj has no such face");
}

TEST_F(RunCommand, AFileThatIsThereIsNoPattern) {
  std::filesystem::copy_file("2d/figure_cage_pose.obj", "percent%d.obj");
  expect("run 2d/figure_cage.obj --vertices 500 --method harmonic --pose percent%d.obj -o out", 0,
         "percent%d.obj");
}

}  // namespace
}  // namespace flbc::testing
