// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/build.h"
#include "cli/model_report_text.h"
#include "cli/open_page.h"
#include "cli/output.h"
#include "cli/verbs.h"
#include "cli/viewer_page.h"

#include "buckens/analysis/simulation/model_report.h"
#include "buckens/model/build/build_model.h"

namespace buckens::cli {

namespace {

struct CheckArguments {
  std::string model;
  std::vector<std::string> overrides;
  bool view = false, open = false;
  std::string page;

  std::filesystem::path page_path() const {
    return page.empty() ? std::filesystem::path(model).stem() += ".html"
                        : std::filesystem::path(page);
  }
};

ExitCode check(const CheckArguments& arguments, bool json) {
  const bool has_page = arguments.view || arguments.open || !arguments.page.empty();
  std::vector<std::string> meshes;
  const auto built = read_and_build(arguments.model, arguments.overrides, &meshes);
  analysis::ModelReport report = analysis::report_model(*built);
  report.notes.insert(report.notes.end(), meshes.begin(), meshes.end());
  const std::string& title = built->description.title;
  print(json ? report_json(title, report) : report_text(title, report));
  if (has_page) {
    const std::filesystem::path page = arguments.page_path();
    write_model_page(*built, page);
    if (!json) print(fmt::format("{} shows it; open it in a browser.\n", page.string()));
    if (arguments.open) open_in_browser(std::filesystem::absolute(page).string());
  }
  return ExitCode::ok;
}

constexpr char kCheckFooter[] = R"(
Example:
  buckens check slider_crank.yaml
  buckens check slider_crank.yaml --view     also writes slider_crank.html

Reads and builds the model, closes its joints, and reports what is known without running: mass, mass
centre, principal inertia and lowest free-free frequencies of each body, marker names, joints and
their equations, which of these are redundant, degrees of freedom, and advice on the step size.
Without --view it writes no files.

Exit codes: 0 the model can be run, 2 bad input, 3 the mechanism cannot be built or assembled,
4 numerical failure, 5 files. Details: docs/reference/command-line.md)";

}  // namespace

void add_check_verb(CLI::App& program, Invocation& invocation) {
  CLI::App& verb = *program.add_subcommand("check", "Describe a model without running it");
  const auto arguments = std::make_shared<CheckArguments>();
  add_model_options(verb, arguments->model, arguments->overrides);
  verb.add_flag("--view", arguments->view,
                "Write a page that shows the assembled model: bodies, joints, markers,\n"
                "loads, axes and names");
  verb.add_flag("--open", arguments->open, "Also open the page in the browser");
  verb.add_option("-o,--out", arguments->page,
                  "File for the page; by default the model's name with its extension\n"
                  "replaced by .html, in the current directory")
      ->type_name("PAGE");
  add_json_option(verb, invocation);
  verb.footer(kCheckFooter);
  verb.callback([arguments, &invocation] {
    invocation.action = [arguments, &invocation] { return check(*arguments, invocation.json); };
  });
}

}  // namespace buckens::cli
