// SPDX-License-Identifier: BSD-3-Clause
// flbc run: from a cage, a model and poses to everything that can be made of them.
#include <omp.h>

#include <chrono>
#include <future>
#include <iostream>
#include <memory>
#include <utility>

#include "commands/commands.h"
#include "draw/canvas.h"
#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "flbc/io/model_file.h"
#include "flbc/io/splat_file.h"
#include "flbc/sparsify.h"
#include "flbc/version.h"
#include "front/facts.h"
#include "front/load.h"
#include "front/model_facets.h"
#include "front/wording.h"
#include "run/steps.h"
#include "solve/make_cage.h"

namespace flbc::app {
namespace {

void check_arguments(const RunArguments& arguments) {
  validate_settings(arguments.settings);
  if (arguments.settings.coordinates == Coordinates::kBiharmonic) {
    throw OptionError(
        "--method bbw: flbc run needs weights that reproduce the model, which bounded biharmonic "
        "weights do not; use flbc solve and flbc deform --relative, or flbc compare");
  }
  if (arguments.settings.outside == OutsidePoints::kExtend) {
    throw OptionError(
        "--outside extend: skins cannot have negative weights; use nearest, or flbc solve and flbc "
        "deform");
  }
}

// What the steps report, in this order. Steps at the same time write to different ones.
constexpr const char* kSteps[] = {"cage",   "mesh",   "solve",  "check",    "sparsify",
                                  "deform", "border", "export", "pictures", "page"};

// Errors of a step begin with its name.
template <int Dim>
void take(Run<Dim>& run, const char* name, void (*step)(Run<Dim>&)) {
  const auto start = std::chrono::steady_clock::now();
  const auto text = [&](const std::exception& error) {
    return std::string("step ") + name + ": " + error.what();
  };
  try {
    step(run);
  } catch (const OptionError& error) {
    throw OptionError(text(error));
  } catch (const IoError& error) {
    throw IoError(text(error));
  } catch (const std::bad_alloc&) {
    throw;  // has an exit status of its own
  } catch (const std::exception& error) {
    throw InputError(text(error));
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  auto& sum = run.report["seconds"][name];
  sum = sum.template get<double>() + seconds.count();
}

// Those that draw and check, which need one thread, while others reduce influences by all.
template <int Dim>
void take_other_steps(Run<Dim>& run, std::future<void> deformed) {
  omp_set_num_threads(1);
  take(run, "check", check_weights_of_mesh);
  if (draw::can_draw()) take(run, "pictures", draw_function);
  deformed.get();
  if (draw::can_draw()) take(run, "pictures", draw_farthest_pose);
  take(run, "page", write_page);
}

template <int Dim>
void take_steps(Run<Dim>& run) {
  for (const char* name : kSteps) {
    run.report.emplace(name, nullptr);  // "cage" already names its file
    run.report["seconds"][name] = 0.0;
  }
  run.report["seconds"]["cage"] = run.arguments.caging_seconds;
  take(run, "cage", deliver_cage);
  take(run, "mesh", mesh_interior);
  take(run, "solve", compute_weights);
  std::future<void> others;     // waits when it goes out of scope
  std::promise<void> deformed;  // breaks before that if a step fails
  others = std::async(std::launch::async, [&run, ready = deformed.get_future()]() mutable {
    take_other_steps(run, std::move(ready));
  });
  take(run, "sparsify", reduce_influences);
  take(run, "deform", deform_shape);
  deformed.set_value();
  take(run, "export", export_shape);
  others.get();
  const std::chrono::duration<double> total =
      std::chrono::steady_clock::now() - run.arguments.start;
  run.report["seconds"]["total"] = total.count();
}

// Leaves out what no step has reported.
template <int Dim>
void tidy_report(Run<Dim>& run) {
  for (const char* name : kSteps) {
    if (!run.report.contains(name) || !run.report[name].is_null()) continue;
    run.report.erase(name);
    if (run.report["seconds"][name] == 0.0) run.report["seconds"].erase(name);
  }
}

template <int Dim>
void print_summary(const Run<Dim>& run) {
  const auto& after = run.report["sparsify"]["after"];
  const auto& error = run.report["sparsify"]["deformation_error"];
  Facts facts;
  facts << run.shape().points.cols() << " vertices, at most " << after["max_influences"]
        << " influences per vertex, deformation error " << 100 * error["rms"].template get<double>()
        << "% rms, reproduction error " << after["max_reproduction_error"].template get<double>()
        << ", " << run.report["seconds"]["total"].template get<double>() << " s";
  std::cerr << run.arguments.output << ": " << facts.text() << "\nNext: open "
            << run.folder.path_of(kPage) << " in a browser and drag the cage;\n      "
            << "save a pose there, and apply it with flbc deform.\n";
  const auto& follower = run.arguments.follower;
  if (follower.empty()) return;
  const auto file = [&](const std::string& name) { return run.folder.path_of(name); };
  std::cerr << "      flbc deform " << follower << " --weights " << file(kBinding)
            << " --pose POSE -o " << name_of_follower(0, 1, run.arguments) << '\n';
}

// \return the exit status
template <int Dim>
int finish(Run<Dim>& run) {
  run.folder.add_report(run.report, "all of this in numbers");
  if (!run.arguments.quiet) print_summary(run);
  for (const auto& violation : run.report["check"]["weights"]["violations"]) {
    std::cerr << "flbc: " << run.arguments.output << ": " << violation.template get<std::string>()
              << '\n';
  }
  if (!report_convergence(run.solver.report(), run.arguments.settings)) return kNotConverged;
  return run.report["check"]["fine"] ? kDone : kBadInput;
}

// Of a run that failed; it must not hide why.
template <int Dim>
void leave_report(Run<Dim>& run, const std::string& failure) {
  tidy_report(run);
  run.report["failed"] = failure;
  try {
    run.folder.add_report(run.report, "");
  } catch (const IoError&) {
  }
}

template <int Dim>
int run_cage(const Cage<Dim>& cage, const RunArguments& arguments,
             const io::ModelFile* cage_file = nullptr) {
  const auto& settings = arguments.settings;
  validate<Dim>(SparsifyOptions{arguments.max_influences});
  if (arguments.control_point != -1) require_control_point(arguments.control_point, cage.size());
  auto inputs = load_inputs(cage, arguments);
  CageSolver<Dim> solver(cage, inputs.shape.points, inputs.shape.edges, settings);
  RunFolder folder(arguments.output, {inputs.files, names_of_results(inputs, arguments),
                                      arguments.force, arguments.quiet, "run", kReport});
  Run<Dim> run{arguments, cage, cage_file, inputs, solver, folder};
  run.report = {{"command", "run"},      {"version", FLBC_VERSION}, {"dim", Dim},
                {"cage", settings.cage}, {"model", settings.model}, {"inputs", inputs.files}};
  try {
    take_steps(run);
    tidy_report(run);
  } catch (const Error& error) {
    leave_report(run, in_words_of_program(error.what()));
    throw;
  } catch (const std::bad_alloc&) {
    leave_report(run, "out of memory");
    throw;
  }
  return finish(run);
}

// A model is easily taken for a cage, and then keeps the solver busy for long.
void refuse_model_as_cage(const io::PolygonSoup& soup, const SolveSettings& settings) {
  const auto note = note_many_vertices(settings.cage, soup.points.size());
  if (note.empty() || !settings.model.empty()) return;
  throw OptionError(note +
                    "; did you mean --auto-cage? Otherwise name the model inside this cage, "
                    "or use flbc solve");
}

void require_model_to_embed(const SolveSettings& settings) {
  if (!settings.embed || !settings.model.empty()) return;
  throw OptionError("--embed: MODEL is missing");
}

// An axis that was named applies to the weights of a model as well.
void mirror_weights(RunArguments& arguments) {
  const auto symmetry = arguments.caging.symmetry;
  if (symmetry == CageSymmetry::kNone || symmetry == CageSymmetry::kAuto) return;
  if (!arguments.settings.model.empty()) {
    arguments.settings.mirror_axis =
        static_cast<int>(symmetry) - static_cast<int>(CageSymmetry::kX);
  } else if (!arguments.makes_cage) {
    throw OptionError("--symmetric: there is no model with vertices; leave out this option");
  }
}

bool is_art(const std::string& path) {
  return moves_drawing({path, path}) || is_picture_file(path);
}

// Splats, drawings, and pictures move with the mesh, so they have no weights of their own.
void take_follower(RunArguments& arguments) {
  auto& settings = arguments.settings;
  if (!is_art(settings.model) && !io::is_splat_file(settings.model)) return;
  arguments.follower = std::exchange(settings.model, "");
  if (!settings.locality.empty()) {
    throw OptionError("--locality: " + arguments.follower +
                      " has splats, curves, or pixels, which have no weights of their own; leave "
                      "out this option");
  }
}

void prepare_model(const CLI::App& command, RunArguments& arguments) {
  refuse_unread_options(command, arguments.settings);
  take_follower(arguments);
  if (!arguments.joint.empty()) parse_joint(arguments.joint);
  if (!arguments.joint.empty() && !arguments.follower.empty()) {
    throw OptionError("--joint: " + arguments.follower +
                      " moves with the domain mesh, which has no joint; leave out this option");
  }
  mirror_weights(arguments);
  require_model_to_embed(arguments.settings);
}

// The first file of the command line is the model around which a cage is made.
int run_model(const CLI::App& command, RunArguments& arguments) {
  auto& settings = arguments.settings;
  if (!settings.model.empty()) {
    throw OptionError(
        "--auto-cage makes the cage; give MODEL only, and the number of control points by "
        "--control-points");
  }
  const std::string file = std::exchange(settings.cage, kCage);
  (is_art(file) ? arguments.follower : settings.model) = file;
  prepare_model(command, arguments);
  const auto run_in_cage = [&](const auto& model) {
    const auto start = std::chrono::steady_clock::now();
    const auto cage = make_cage(file, model, arguments.caging, arguments.quiet).cage;
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    arguments.caging_seconds = seconds.count();
    return run_cage(cage, arguments);
  };
  return std::visit(run_in_cage, load_model_facets(file));
}

// \return the exit status
int run_command(const CLI::App& command, RunArguments& arguments) {
  check_arguments(arguments);
  arguments.settings.needs_domain = true;
  const auto& settings = arguments.settings;
  arguments.up = up_of(arguments.up, arguments.makes_cage ? settings.cage : settings.model);
  if (arguments.makes_cage) return run_model(command, arguments);
  prepare_model(command, arguments);
  const io::ModelFile file(arguments.settings.cage);
  const auto& soup = file.model().soup;
  refuse_model_as_cage(soup, arguments.settings);
  const auto cage = checked_cage(soup, arguments.settings.cage);
  return std::visit([&](const auto& any) { return run_cage(any, arguments, &file); }, cage);
}

// CAGE, MODEL, and the options that make the first of them of the second.
void add_shapes(CLI::App& command, RunArguments& a) {
  command
      .add_option("CAGE", a.settings.cage,
                  "closed polylines or a drawing (2D), or surface (3D); with --auto-cage a model, "
                  "a drawing, or a .png with transparent pixels")
      ->required();
  command.add_option(
      "MODEL", a.settings.model,
      "model inside the cage: .obj .off .ply .stl .glb .gltf, drawing or picture: .svg .png .jpg, "
      "or points: .npy .csv (default: the mesh of the cage interior)");
  command.option_defaults()->group("Cage and poses");
  auto* makes_cage =
      command.add_flag("--auto-cage", a.makes_cage, "make a cage around the first file");
  command
      .add_option(
          "--control-points", a.caging.control_points,
          "maximum number of control points for --auto-cage (default: depends on the shape)")
      ->check(refuse_vertex_count)
      ->needs(makes_cage);
  add_symmetric_option(command, a.caging.symmetry,
                       ". An axis also makes weights of mirrored model vertices exactly alike, in "
                       "given cages too")
      ->group(kMore);
}

// bbw and extend, which check_arguments() refuses with the reason, are the last values.
void hide_refused_values(CLI::App& command) {
  for (const char* name : {"--method", "--outside"}) {
    auto* option = command.get_option(name);
    const auto values = option->get_type_name();
    option->type_name(values.substr(0, values.rfind('|')));
  }
  command.get_option("--outside")
      ->description(
          "method for model vertices outside the cage (default: fail). nearest: follow the nearest "
          "point of the cage at a constant offset. keep: stay where they are, without weights");
}

void add_rare_options(CLI::App& command, RunArguments& a, CLI::Option* poses) {
  command.add_flag("--embed", a.settings.embed, "use the model vertices as vertices of the mesh");
  add_reduction_option(command, a.reduction);
  add_rate_option(command, a.poses, poses);
  add_up_option(command, a.up);
  add_choice(command, "--pictures", {"png", "svg", "pdf"}, a.pictures,
             "format of the pictures (default: png)");
}

}  // namespace

void add_run_command(CLI::App& app, int& exit_status) {
  auto arguments = std::make_shared<RunArguments>();
  auto& a = *arguments;
  auto* command = app.add_subcommand(
      "run", "mesh, solve, check, sparsify, deform, export, and draw in one step");
  command->footer(
      "OUTDIR receives the mesh of the cage interior, dense and sparse weights, the model in each\n"
      "pose, model.glb (an animated skin), pictures, model.html (a page for moving the cage), and\n"
      "report.json. A run replaces the files of an earlier run in OUTDIR. Model and skin use the\n"
      "sparse weights. If a step fails, the results of earlier steps remain.\n"
      "\n"
      "Examples:\n"
      "  flbc run model.obj --auto-cage -o out\n"
      "  flbc run cage.obj model.obj --pose pose.obj -o posed");
  add_shapes(*command, a);
  auto* poses = add_pose_option(*command, a.poses);
  command->option_defaults()->group("Output");
  command->add_option("-o,--output", a.output, "folder for all results")
      ->required()
      ->type_name("OUTDIR");
  command->add_option("-k,--max-influences", a.max_influences,
                      "maximum influences per vertex (default: 8)");
  add_joint_option(*command, a.joint);
  command->add_option("--control-point", a.control_point,
                      "control point to draw, counted from 0 (default: the one that moves most)");
  command->add_flag("--force", a.force, "replace files in OUTDIR that are not from an earlier run");
  command->add_flag("-q,--quiet", a.quiet, "print only errors");
  command->option_defaults()->group("Solver");
  command->add_option("--vertices", a.settings.vertices, "number of mesh vertices (default: 10000)")
      ->check(refuse_vertex_count);
  add_solver_options(*command, a.settings);
  hide_refused_values(*command);
  add_rare_options(*command, a, poses);
  command->callback(
      [arguments, command, &exit_status] { exit_status = run_command(*command, *arguments); });
}

}  // namespace flbc::app
