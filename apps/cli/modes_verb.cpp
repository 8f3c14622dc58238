// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/build.h"
#include "cli/number_range.h"
#include "cli/output.h"
#include "cli/verbs.h"
#include "cli/vibration_text.h"

#include "buckens/analysis/vibration/body_vibration.h"
#include "buckens/analysis/vibration/record.h"
#include "buckens/analysis/vibration/system_vibration.h"
#include "buckens/base/allowed_threads.h"
#include "buckens/base/errors.h"
#include "buckens/base/nearest.h"
#include "buckens/files/output_file.h"
#include "buckens/run_store/run_directory.h"

namespace buckens::cli {

namespace {

struct ModesArguments {
  std::string model, body, method = "automatic", about = "initial", out;
  std::vector<std::string> overrides;
  int count = 10;
  double tolerance = 1e-9;
  int threads = 1;
  bool system = false;
  bool condition = false;
};

template <class Choice>
Choice chosen(const std::string& name) {
  const auto names = choice_names(Choice{});
  const auto found = std::find(names.begin(), names.end(), name);
  return static_cast<Choice>(found - names.begin());
}

/// Indices into Model::wholes of the bodies whose free vibrations are wanted.
std::vector<int> wanted_bodies(const model::Model& model, const ModesArguments& arguments) {
  if (!arguments.body.empty()) {
    const int index = model.find_whole(arguments.body);
    if (index >= 0) return {index};
    std::vector<std::string> names;
    for (const model::WholeBody& whole : model.wholes) names.push_back(whole.name);
    throw InputError(fmt::format("--body: the model has no body \"{}\".{}", arguments.body,
                                 base::suggestion(arguments.body, names)));
  }
  std::vector<int> out;
  for (std::size_t k = 0; k < model.wholes.size(); ++k) {
    const auto first = static_cast<std::size_t>(model.wholes[k].first);
    const body::Body& body = model.bodies[first];
    if (body.is_flexible() && !body.flexible->is_quasi_static) out.push_back(static_cast<int>(k));
  }
  if (out.empty()) {
    throw ModelError(
        "all bodies are rigid or quasi-static, so none has free vibrations; use --system for those "
        "of the "
        "mechanism");
  }
  return out;
}

std::vector<analysis::VibrationReport> analyse(const model::BuiltModel& built,
                                               const ModesArguments& arguments) {
  if (arguments.system) {
    analysis::SystemVibrationSettings settings;
    settings.count = arguments.count;
    settings.tolerance = arguments.tolerance;
    settings.about = chosen<analysis::RestPosition>(arguments.about);
    return {analysis::system_vibrations(built, settings)};
  }
  body::FreeModesSettings settings;
  settings.count = arguments.count;
  settings.tolerance = arguments.tolerance;
  settings.method = chosen<body::FreeModeMethod>(arguments.method);
  settings.condition = arguments.condition;
  std::vector<analysis::VibrationReport> reports;
  for (const int body : wanted_bodies(built.model, arguments)) {
    reports.push_back(analysis::free_body_vibrations(built, body, settings));
  }
  return reports;
}

ExitCode modes(const ModesArguments& arguments, bool json) {
  const base::AllowedThreads threads(arguments.threads);
  const auto built = read_and_build(arguments.model, arguments.overrides);
  const std::string& title = built->description.title;
  const auto reports = analyse(*built, arguments);
  if (!arguments.out.empty()) {
    const std::filesystem::path path = arguments.out;
    run_store::RunDirectory directory(path, {title, built->description.source, {}});
    analysis::record_vibrations(*built, reports, directory);
    files::replace_text_file(path / run_store::kModesName, vibration_json(title, reports));
  }
  print(json ? vibration_json(title, reports) : vibration_text(title, reports));
  if (!json && !arguments.out.empty()) {
    print(fmt::format("shapes: {}; look at them with: buckens view {}\n", arguments.out,
                      arguments.out));
  }
  return ExitCode::ok;
}

constexpr char kModesFooter[] = R"(
Examples:
  buckens modes slider_crank.yaml                       free vibrations of each flexible body
  buckens modes slider_crank.yaml --system --count 6    modes of the mechanism with its joints
  buckens modes crane.yaml --system --about static -o modes && buckens view modes

Free vibrations are those of an unconstrained body; its rigid modes are not listed. With --system the
bodies are connected as in the model file: --about initial is the assembled, unloaded position with
the stiffness of springs; --about static is the equilibrium under gravity and loads, whose change with
the motion is included. "mass" belongs to the shape scaled to a largest displacement of 1 m; effective
masses are shares of the total mass.

Methods: subspace (sieved simultaneous inverse iteration), augmented (bordered matrix), penalty,
spectra (Lanczos), slepc (Krylov-Schur, of large bodies over several processes), dense; automatic
uses dense up to 600 unknowns and subspace above, or slepc where it can.

Without -o no files are written. OUT contains results.h5 with the shapes, and modes.json.

Exit codes: 0 done, 2 bad input, 3 the model cannot be solved, 4 numerical failure, 5 files.
Details: docs/reference/command-line.md)";

}  // namespace

void add_modes_verb(CLI::App& program, Invocation& invocation) {
  CLI::App& verb = *program.add_subcommand("modes", "Compute natural frequencies and mode shapes");
  const auto arguments = std::make_shared<ModesArguments>();
  add_model_options(verb, arguments->model, arguments->overrides);
  CLI::Option* body = verb.add_option("--body", arguments->body, "Only this body");
  verb.add_option("--count", arguments->count, "Number of modes, 10 by default")
      ->check(CLI::Range(1, 100000));
  const auto methods = choice_names(body::FreeModeMethod{});
  CLI::Option* method =
      verb.add_option("--method", arguments->method, "Eigensolver for free vibrations")
          ->check(CLI::IsMember(std::vector<std::string>(methods.begin(), methods.end())));
  CLI::Option* condition = verb.add_flag("--condition", arguments->condition,
                                         "Estimate the condition number of the factored matrix");
  CLI::Option* system =
      verb.add_flag("--system", arguments->system, "Modes of the assembled system");
  verb.add_option("--about", arguments->about, "Position of the system: initial or static")
      ->check(CLI::IsMember({"initial", "static"}))
      ->needs(system);
  system->excludes(body)->excludes(method)->excludes(condition);
  verb.add_option("--tolerance", arguments->tolerance,
                  "Relative error of the shapes, 1e-9 by default")
      ->check(number_between(1e-14, 1e-2));
  verb.add_option("--threads", arguments->threads,
                  "Number of threads that share large bodies, 1 by default. Results are bitwise\n"
                  "identical")
      ->check(CLI::Range(1, kMostThreads));
  verb.add_option("-o,--out", arguments->out, "Directory for the shapes")->type_name("OUT");
  add_json_option(verb, invocation);
  verb.footer(kModesFooter);
  verb.callback([arguments, &invocation] {
    invocation.action = [arguments, &invocation] { return modes(*arguments, invocation.json); };
  });
}

}  // namespace buckens::cli
