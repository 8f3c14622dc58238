// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/interruption.h"
#include "cli/live_page.h"
#include "cli/open_page.h"
#include "cli/output.h"
#include "cli/verbs.h"
#include "cli/viewer_page.h"

#include "buckens/base/errors.h"
#include "buckens/base/nearest.h"
#include "buckens/page/view_page.h"

namespace buckens::cli {

namespace {

namespace fs = std::filesystem;

struct ViewArguments {
  std::vector<std::string> runs;
  std::string page, fields;
  bool live = false, open = false;
  std::size_t frames = page::ViewPageOptions{}.max_frames;
  std::size_t megabytes = page::ViewPageOptions{}.max_bytes >> 20U;
};

/// The names between commas.
std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> names;
  std::istringstream stream(list);
  for (std::string name; std::getline(stream, name, ',');) {
    if (!name.empty()) names.push_back(name);
  }
  return names;
}

/// Tells of names that no run has a field of.
void warn_of_unknown(const std::vector<std::string>& wanted,
                     const std::vector<page::ViewPageReport>& reports) {
  std::vector<std::string> known;
  for (const page::ViewPageReport& report : reports) {
    known.insert(known.end(), report.fields.begin(), report.fields.end());
  }
  std::sort(known.begin(), known.end());
  known.erase(std::unique(known.begin(), known.end()), known.end());
  for (const std::string& name : wanted) {
    if (std::binary_search(known.begin(), known.end(), name)) continue;
    tell(stderr, fmt::format("buckens: warning: --fields: no field \"{}\" was recorded.{}\n", name,
                             base::suggestion(name, known)));
  }
}

/// Serves the page until Ctrl-C.
ExitCode view_live(const ViewArguments& arguments, const page::ViewPageOptions& options,
                   bool json) {
  if (!arguments.page.empty()) {
    throw InputError("--live serves the page and writes none; leave out -o, or --live");
  }
  LivePage page({arguments.runs.begin(), arguments.runs.end()}, find_page_template(), options);
  print(json ? to_text({{"address", page.address()}})
             : fmt::format("{}\nFollows the run on this machine only; Ctrl-C ends it.\n",
                           page.address()));
  if (arguments.open) open_in_browser(page.address());
  const Interruption interruption(false);
  page.serve([&interruption] { return interruption.requested(); });
  return ExitCode::ok;
}

ExitCode view(const ViewArguments& arguments, bool json) {
  const std::vector<fs::path> runs(arguments.runs.begin(), arguments.runs.end());
  const fs::path page =
      arguments.page.empty() ? runs.front() / "view.html" : fs::path(arguments.page);
  page::ViewPageOptions options;
  options.max_frames = arguments.frames;
  options.max_bytes = arguments.megabytes << 20U;
  options.fields = split(arguments.fields);
  if (arguments.live) return view_live(arguments, options, json);
  const std::vector<page::ViewPageReport> reports =
      page::write_view_page(runs, find_page_template(), page, options);
  warn_of_unknown(options.fields, reports);
  if (arguments.open) open_in_browser(fs::absolute(page).string());
  if (json) {
    nlohmann::ordered_json out = {{"page", page.string()},
                                  {"records", reports.front().records},
                                  {"frames", reports.front().frames},
                                  {"rounded", reports.front().rounded}};
    if (reports.size() > 1) {
      out["second"] = {{"records", reports.back().records},
                       {"frames", reports.back().frames},
                       {"rounded", reports.back().rounded}};
    }
    print(to_text(out));
    return ExitCode::ok;
  }
  std::string counts;
  for (const page::ViewPageReport& report : reports) {
    counts += fmt::format("{}{} of {} records{}", counts.empty() ? "" : ", ", report.frames,
                          report.records, report.rounded ? ", fields rounded to 16 bits" : "");
  }
  print(fmt::format("{} ({}){}\n", page.string(), counts,
                    arguments.open ? "" : "; open it in a browser."));
  return ExitCode::ok;
}

constexpr char kViewFooter[] = R"(
Example:
  buckens run slider_crank.yaml -o out
  buckens view out
  buckens view out --open                  also opens the page in the browser
  buckens view out --live --open           follows a run in progress
  buckens view out other -o both.html      shows two runs side by side

Writes out/view.html, a self-contained page with the machine in motion, its deformation, stresses and
other fields, and the curves of the sensors. This works during the run and after it was interrupted.
With --live the page is served instead, and updated during the run, until Ctrl-C; its address on this
machine is shown to its user only.

Exit codes: 0 done, 2 bad command line, 5 the run or the page cannot be read or written.
docs/tutorials/viewer.md explains the page.)";

}  // namespace

void add_view_verb(CLI::App& program, Invocation& invocation) {
  CLI::App& verb = *program.add_subcommand("view", "Write a web page that shows a run");
  const auto arguments = std::make_shared<ViewArguments>();
  verb.add_option("OUT", arguments->runs,
                  "Run directory, as written by `buckens run`; two are shown side by side")
      ->required()
      ->expected(1, 2);
  verb.add_option("-o,--out", arguments->page, "File for the page; OUT/view.html by default")
      ->type_name("PAGE");
  verb.add_flag("--open", arguments->open, "Open the page in the browser");
  verb.add_flag("--live", arguments->live,
                "Serve the page on this machine and update it during the run");
  verb.add_option("--frames", arguments->frames, "Maximum number of frames in the page")
      ->capture_default_str()
      ->check(CLI::Range(2, 1000000));
  verb.add_option("--fields", arguments->fields,
                  "Fields to show, such as von_mises,stress; all by default")
      ->type_name("NAMES");
  verb.add_option("--max-size", arguments->megabytes,
                  "Maximum size of the numbers in the page [MiB]; frames are left out if needed")
      ->capture_default_str()
      ->check(CLI::Range(1, 300));
  add_json_option(verb, invocation);
  verb.footer(kViewFooter);
  verb.callback([arguments, &invocation] {
    invocation.action = [arguments, &invocation] { return view(*arguments, invocation.json); };
  });
}

}  // namespace buckens::cli
