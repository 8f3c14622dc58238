// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>
#include <vector>

#include "cli/build.h"
#include "cli/model_report_text.h"
#include "cli/output.h"
#include "cli/verbs.h"

#include "buckens/analysis/simulation/model_report.h"
#include "buckens/model/build/build_model.h"

namespace buckens::cli {

namespace {

struct CheckArguments {
  std::string model;
  std::vector<std::string> overrides;
};

ExitCode check(const CheckArguments& arguments, bool json) {
  std::vector<std::string> meshes;
  const auto built = read_and_build(arguments.model, arguments.overrides, &meshes);
  analysis::ModelReport report = analysis::report_model(*built);
  report.notes.insert(report.notes.end(), meshes.begin(), meshes.end());
  const std::string& title = built->description.title;
  print(json ? report_json(title, report) : report_text(title, report));
  return ExitCode::ok;
}

constexpr char kCheckFooter[] = R"(
Example:
  buckens check slider_crank.yaml

Reads and builds the model, closes its joints, and tells what can be said without running: mass,
mass centre, principal inertia and lowest free-free frequencies of each body, the names of markers,
joints and their equations, which of them are redundant, degrees of freedom, advice on the step
size. Writes no files.

Exit codes: 0 the model can be run, 2 bad input, 3 the mechanism cannot be built or assembled,
4 numerical failure, 5 files. Details: docs/reference/command-line.md)";

}  // namespace

void add_check_verb(CLI::App& program, Invocation& invocation) {
  CLI::App& verb = *program.add_subcommand("check", "Describe a model without running it");
  const auto arguments = std::make_shared<CheckArguments>();
  add_model_options(verb, arguments->model, arguments->overrides);
  add_json_option(verb, invocation);
  verb.footer(kCheckFooter);
  verb.callback([arguments, &invocation] {
    invocation.action = [arguments, &invocation] { return check(*arguments, invocation.json); };
  });
}

}  // namespace buckens::cli
