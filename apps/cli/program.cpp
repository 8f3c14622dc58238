// SPDX-License-Identifier: Apache-2.0
#include "cli/program.h"

#include <algorithm>
#include <exception>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "cli/failure.h"
#include "cli/output.h"
#include "cli/verbs.h"
#include "cli/work_display.h"

#include "buckens/base/nearest.h"
#include "buckens/base/version.h"

namespace buckens::cli {

namespace {

constexpr char kDescription[] =
    "Buckens simulates machines whose parts deform: each flexible body keeps its full "
    "finite-element\n"
    "model, which is factorised once per simulation.\n";

constexpr char kProgramFooter[] = R"(
Getting started:
  buckens check examples/slider_crank/slider_crank.yaml        describe the model
  buckens run examples/slider_crank/slider_crank.yaml -o out   simulate it
  buckens view out                                             write a page that shows the run
  buckens run --help                                           help on a verb

Exit codes:
  0    done
  1    internal error; please report it with the model file
  2    bad input: model file or command line
  3    the model can be read but not built, assembled or solved
  4    numerical failure, or not enough memory; results up to that point are kept
  5    a file cannot be read or written
  6    two runs differ by more than the tolerance (`buckens compare`)
  130  interrupted by Ctrl-C, SIGTERM or SIGHUP; results up to that point are complete

The documentation is in docs/ of the source tree: docs/reference/command-line.md describes the verbs,
docs/reference/model-file.md is what `buckens reference` prints.)";

void describe(CLI::App& app) {
  app.name("buckens");
  app.description(kDescription);
  app.footer(kProgramFooter);
  app.set_version_flag("--version", fmt::format("buckens {}", kVersion), "Print the version");
  app.get_formatter()->column_width(24);
  app.get_formatter()->label("SUBCOMMAND", "VERB");
}

/// Verb that was probably meant, as the ending of a message.
std::string verb_suggestion(const CLI::App& app, const std::string& word) {
  std::vector<std::string> names;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(verb->get_name());
  }
  return base::suggestion(word, names);
}

Failure usage_failure(const CLI::App& app, const CLI::ParseError& error,
                      const std::vector<std::string>& arguments) {
  const auto used = app.get_subcommands();
  std::string message = error.what();
  std::string verb;
  if (!used.empty()) {
    verb = " " + used.front()->get_name();
  } else if (!arguments.empty() && !arguments.front().starts_with('-')) {
    message = fmt::format("there is no verb \"{}\".{}", arguments.front(),
                          verb_suggestion(app, arguments.front()));
  }
  const bool is_sentence = message.ends_with('.') || message.ends_with('?');
  message += fmt::format("{} See `buckens{} --help`.", is_sentence ? "" : ".", verb);
  return {ExitCode::input, "usage", message, {}};
}

}  // namespace

int run_program(int argc, const char* const* argv) {
  const std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
  Invocation invocation;
  // Errors of the command line itself come before its options are known.
  bool json = std::find(arguments.begin(), arguments.end(), "--json") != arguments.end();
  try {
    CLI::App app;
    describe(app);
    add_run_verb(app, invocation);
    add_sweep_verb(app, invocation);
    add_static_verb(app, invocation);
    add_check_verb(app, invocation);
    add_modes_verb(app, invocation);
    add_compare_verb(app, invocation);
    add_mesh_info_verb(app, invocation);
    add_convert_verb(app, invocation);
    add_view_verb(app, invocation);
    add_export_verb(app, invocation);
    add_plot_verb(app, invocation);
    add_schema_verb(app, invocation);
    add_reference_verb(app, invocation);
    add_version_verb(app, invocation);
    for (CLI::App* verb : app.get_subcommands([](CLI::App*) { return true; })) verb->group("Verbs");
    app.require_subcommand(0, 1);
    try {
      app.parse(argc, argv);
    } catch (const CLI::Success& request) {  // --help, --version
      std::ostringstream page;
      const int code = app.exit(request, page, page);
      print(page.str());
      return code;
    } catch (const CLI::ParseError& error) {
      return report_failure(usage_failure(app, error, arguments), json);
    }
    if (!invocation.action) {
      print(app.help());
      return static_cast<int>(ExitCode::input);
    }
    json = invocation.json;
    const WorkDisplay work(stderr, json ? ProgressDisplay::Style::none : style_for(stderr));
    return static_cast<int>(invocation.action());
  } catch (...) {
    return report_failure(describe_failure(std::current_exception()), json);
  }
}

}  // namespace buckens::cli
