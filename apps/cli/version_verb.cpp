// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "cli/output.h"
#include "cli/verbs.h"

#include "buckens/base/version.h"
#include "buckens/linalg/gpl_parts.h"

namespace buckens::cli {

void add_version_verb(CLI::App& program, Invocation& invocation) {
  CLI::App& verb =
      *program.add_subcommand("version", "Print the version and the licence of this build");
  add_json_option(verb, invocation);
  verb.callback([&invocation] {
    invocation.action = [&invocation] {
      const bool has_gpl = linalg::has_gpl_parts();
      print(invocation.json
                ? to_text({{"program", "buckens"},
                           {"version", kVersion},
                           {"licence", has_gpl ? "GPL-3.0-or-later" : "Apache-2.0"}})
                : fmt::format("buckens {}\n{}\n", kVersion,
                              has_gpl
                                  ? "this binary may be passed on under the GNU GPL, version 3 "
                                    "or later: it uses SPQR, CHOLMOD and Gmsh"
                                  : "this binary may be passed on under the Apache License 2.0: "
                                    "it uses no library under the GPL"));
      return ExitCode::ok;
    };
  });
}

}  // namespace buckens::cli
