// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "cli/number_range.h"
#include "cli/output.h"
#include "cli/verbs.h"

#include "buckens/base/errors.h"
#include "buckens/exports/csv.h"
#include "buckens/exports/glb.h"
#include "buckens/exports/vtk.h"

namespace buckens::cli {

namespace {

namespace fs = std::filesystem;

struct ExportArguments {
  std::string run, out;
  bool vtk = false, csv = false, glb = false;
  std::vector<double> times;
  std::size_t count = run_store::InstantChoice{}.count;
  double exaggeration = 1, playback = 0;
};

/// "out" for "some/out/".
std::string name_of(const fs::path& run) {
  const fs::path plain = fs::absolute(run).lexically_normal();
  const std::string name = plain.has_filename() ? plain.filename() : plain.parent_path().filename();
  return name.empty() ? "run" : name;
}

exports::GlbOptions glb_options(const ExportArguments& arguments) {
  exports::GlbOptions options;
  options.animation.count = arguments.count;
  if (!arguments.times.empty()) {
    options.at = arguments.times.front();
    if (arguments.times.size() > 1) options.animation.times = arguments.times;
  }
  options.exaggeration = arguments.exaggeration;
  options.playback = arguments.playback;
  return options;
}

void make_directory(const fs::path& directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error) {
    throw IoError(
        fmt::format("{}: cannot create the directory: {}.", directory.string(), error.message()));
  }
}

ExitCode export_run(const ExportArguments& arguments, bool json) {
  if (!arguments.vtk && !arguments.csv && !arguments.glb) {
    throw InputError("say what to export: --vtk, --csv, --glb, or several of them");
  }
  const run_store::RunReader run(arguments.run);
  const fs::path directory =
      arguments.out.empty() ? fs::path(arguments.run) / "export" : fs::path(arguments.out);
  make_directory(directory);
  run_store::InstantChoice choice;
  choice.times = arguments.times;
  choice.count = arguments.count;
  const std::string name = name_of(arguments.run);
  nlohmann::ordered_json report = nlohmann::ordered_json::object();
  std::string text;
  if (arguments.vtk) {
    const std::size_t instants = exports::export_vtk(run, choice, directory, name);
    const std::string file = (directory / (name + ".pvd")).string();
    report["vtk"] = {{"file", file}, {"instants", instants}};
    text += fmt::format("{} ({} instants); open it in ParaView.\n", file, instants);
  }
  if (arguments.csv) {
    const std::vector<std::string> files = exports::export_csv(run, choice, directory);
    report["csv"] = {{"directory", directory.string()}, {"files", files}};
    for (const std::string& file : files) text += (directory / file).string() + '\n';
  }
  if (arguments.glb) {
    const fs::path file = directory / (name + ".glb");
    const exports::GlbReport glb = exports::export_glb(run, glb_options(arguments), file);
    report["glb"] = {{"file", file.string()},         {"at", glb.at},
                     {"instants", glb.instants},      {"playback", glb.playback},
                     {"von_mises_min", glb.least},    {"von_mises_max", glb.most},
                     {"shape_error", glb.shape_error}};
    text += fmt::format(
        "{} (colours: von Mises stress at {:.6g} s, {:.4g} to {:.4g} Pa; {} instants in {:.3g} s; "
        "deformation to {:.1g} of its largest)\n",
        file.string(), glb.at, glb.least, glb.most, glb.instants, glb.playback, glb.shape_error);
  }
  print(json ? to_text(report) : text);
  return ExitCode::ok;
}

constexpr char kExportFooter[] = R"(
Examples:
  buckens export out --vtk                  out/export/out.pvd and .vtu files for ParaView
  buckens export out --csv --at 0.05        fields at one instant as tables
  buckens export out --glb --exaggerate 50  out/export/out.glb for glTF viewers

The instants are those of the fields requested in the model file (output: {fields: ...}), otherwise
the records. This works during the run and after it was interrupted.

Exit codes: 0 done, 2 bad input, 5 the run or a file cannot be read or written.
docs/tutorials/results.md describes the files.)";

}  // namespace

void add_export_verb(CLI::App& program, Invocation& invocation) {
  CLI::App& verb =
      *program.add_subcommand("export", "Write a run for ParaView, spreadsheets, 3-D viewers");
  const auto arguments = std::make_shared<ExportArguments>();
  verb.add_option("OUT", arguments->run, "Run directory, as written by `buckens run`")->required();
  verb.add_flag("--vtk", arguments->vtk, "VTK: a .vtu file per instant and a .pvd file");
  verb.add_flag("--csv", arguments->csv, "Sensors, fields and extremes as tables");
  verb.add_flag("--glb", arguments->glb, "Binary glTF 2.0: animated surfaces");
  verb.add_option("-o,--out", arguments->out, "Directory for the files; OUT/export by default")
      ->type_name("DIR");
  verb.add_option("--at", arguments->times,
                  "Instant in seconds; the nearest one is used. May be repeated.\n"
                  "--glb: pose and colours outside the animation")
      ->type_name("T")
      ->allow_extra_args(false);
  verb.add_option("--count", arguments->count, "Maximum number of instants, evenly spaced; 0: all")
      ->capture_default_str()
      ->check(number_between(0, 1e9));
  verb.add_option("--exaggerate", arguments->exaggeration, "--glb: magnification of deformations")
      ->capture_default_str()
      ->check(number_between(0, 1e9));
  verb.add_option("--playback", arguments->playback,
                  "--glb: duration of the animation in seconds; by default that of\n"
                  "the run, but 2 to 30 s")
      ->check(any_number(true));
  add_json_option(verb, invocation);
  verb.footer(kExportFooter);
  verb.callback([arguments, &invocation] {
    invocation.action = [arguments, &invocation] {
      return export_run(*arguments, invocation.json);
    };
  });
}

}  // namespace buckens::cli
