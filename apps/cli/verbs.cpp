// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs.h"

namespace buckens::cli {

void add_json_option(CLI::App& verb, Invocation& invocation) {
  verb.add_flag("--json", invocation.json,
                "Print one JSON object to standard output and nothing else, errors included");
}

void add_model_options(CLI::App& verb, std::string& model, std::vector<std::string>& overrides) {
  verb.add_option("MODEL", model, "Model file, YAML or JSON")->required();
  verb.add_option("--set", overrides,
                  "Replace a value of the model file before it is read, for example\n"
                  "bodies.rod.beam.elements=8 or \"parameters.L=20 mm\"; may be repeated")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
}

}  // namespace buckens::cli
