// SPDX-License-Identifier: Apache-2.0
#include "cli/output.h"
#include "cli/verbs.h"

#include "buckens/model_file/model_file.h"

namespace buckens::cli {

namespace {

constexpr char kSchemaFooter[] = R"(
Example:
  buckens schema > buckens.schema.json

Editors that support JSON Schema (2020-12) can then complete and check model files. With the YAML
extension of many editors, this first line of a model file is enough:
  # yaml-language-server: $schema=buckens.schema.json)";

constexpr char kReferenceFooter[] = R"(
Example:
  buckens reference | less)";

}  // namespace

void add_schema_verb(CLI::App& program, Invocation& invocation) {
  CLI::App& verb = *program.add_subcommand("schema", "Print the JSON Schema of model files");
  add_json_option(verb, invocation);
  verb.footer(kSchemaFooter);
  verb.callback([&invocation] {
    invocation.action = [] {
      print(model_file::model_schema_json());
      return ExitCode::ok;
    };
  });
}

void add_reference_verb(CLI::App& program, Invocation& invocation) {
  CLI::App& verb =
      *program.add_subcommand("reference", "Print the reference of model files (Markdown)");
  add_json_option(verb, invocation);
  verb.footer(kReferenceFooter);
  verb.callback([&invocation] {
    invocation.action = [&invocation] {
      const std::string page = model_file::model_reference_markdown();
      print(invocation.json ? to_text({{"reference", page}}) : page);
      return ExitCode::ok;
    };
  });
}

}  // namespace buckens::cli
