// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "cli/output.h"
#include "cli/verbs.h"

#include "buckens/base/version.h"

namespace buckens::cli {

void add_version_verb(CLI::App& program, Invocation& invocation) {
  CLI::App& verb = *program.add_subcommand("version", "Print the version");
  add_json_option(verb, invocation);
  verb.callback([&invocation] {
    invocation.action = [&invocation] {
      print(invocation.json ? to_text({{"program", "buckens"}, {"version", kVersion}})
                            : fmt::format("buckens {}\n", kVersion));
      return ExitCode::ok;
    };
  });
}

}  // namespace buckens::cli
