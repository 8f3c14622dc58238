// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "cli/output.h"
#include "cli/verbs.h"

#include "buckens/base/errors.h"
#include "buckens/io/view_page.h"

namespace buckens::cli {

namespace {

namespace fs = std::filesystem;

struct ViewArguments {
  std::string run, page;
  std::size_t frames = io::ViewPageOptions{}.max_frames;
};

/// The viewer's page lies at the same place relative to the program in the build and after
/// installation.
fs::path find_template() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path page = (program.parent_path() / "../share/buckens/viewer.html").lexically_normal();
  if (error || !fs::is_regular_file(page, error)) {
    throw IoError(fmt::format(
        "{}: the page of the viewer is missing. It is built by the target buckens_viewer, which "
        "needs npm; configure again with -DBUCKENS_VIEWER=ON after tools/setup.sh, and build.",
        page.string()));
  }
  return page;
}

ExitCode view(const ViewArguments& arguments, bool json) {
  const fs::path run = arguments.run;
  const fs::path page = arguments.page.empty() ? run / "view.html" : fs::path(arguments.page);
  io::ViewPageOptions options;
  options.max_frames = arguments.frames;
  const io::ViewPageReport report = io::write_view_page(run, find_template(), page, options);
  if (json) {
    print(
        to_text({{"page", page.string()}, {"records", report.records}, {"frames", report.frames}}));
  } else {
    print(fmt::format("{} ({} of {} records); open it in a browser.\n", page.string(),
                      report.frames, report.records));
  }
  return ExitCode::ok;
}

constexpr char kFooter[] = R"(
Example:
  buckens run slider_crank.yaml -o out
  buckens view out

Writes out/view.html, one file that needs nothing else: the machine in motion with its deformation,
stresses and the curves of the sensors. Works while the run goes on and after it was interrupted.

Exit codes: 0 done, 2 bad command line, 5 the run or the page cannot be read or written.
The page is explained in docs/tutorials/viewer.md)";

}  // namespace

void add_view_verb(CLI::App& program, Invocation& invocation) {
  CLI::App& verb = *program.add_subcommand("view", "Make a web page that shows a run");
  const auto arguments = std::make_shared<ViewArguments>();
  verb.add_option("OUT", arguments->run, "Run directory, as written by `buckens run`")->required();
  verb.add_option("-o,--out", arguments->page, "The page; without it OUT/view.html")
      ->type_name("PAGE");
  verb.add_option("--frames", arguments->frames, "Most frames in the page")
      ->capture_default_str()
      ->check(CLI::Range(2, 1000000));
  add_json_option(verb, invocation);
  verb.footer(kFooter);
  verb.callback([arguments, &invocation] {
    invocation.action = [arguments, &invocation] { return view(*arguments, invocation.json); };
  });
}

}  // namespace buckens::cli
