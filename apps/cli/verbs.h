// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "cli/exit_code.h"

namespace buckens::cli {

/// The request of a command line; filled by the verb found in it.
struct Invocation {
  std::function<ExitCode()> action;
  bool json = false;  ///< results and errors as JSON on the standard output
};

/// Each adds one verb with its options and help. The action may throw whatever the library throws.
void add_run_verb(CLI::App& program, Invocation& invocation);
void add_sweep_verb(CLI::App& program, Invocation& invocation);
void add_static_verb(CLI::App& program, Invocation& invocation);
void add_check_verb(CLI::App& program, Invocation& invocation);
void add_modes_verb(CLI::App& program, Invocation& invocation);
void add_compare_verb(CLI::App& program, Invocation& invocation);
void add_mesh_info_verb(CLI::App& program, Invocation& invocation);
void add_convert_verb(CLI::App& program, Invocation& invocation);
void add_view_verb(CLI::App& program, Invocation& invocation);
void add_export_verb(CLI::App& program, Invocation& invocation);
void add_plot_verb(CLI::App& program, Invocation& invocation);
void add_schema_verb(CLI::App& program, Invocation& invocation);
void add_reference_verb(CLI::App& program, Invocation& invocation);
void add_version_verb(CLI::App& program, Invocation& invocation);

/// Options of more than one verb.
void add_json_option(CLI::App& verb, Invocation& invocation);
void add_model_options(CLI::App& verb, std::string& model, std::vector<std::string>& overrides);

}  // namespace buckens::cli
