// SPDX-License-Identifier: Apache-2.0
#include "cli/several_processes.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "cli/failure.h"
#include "cli/program.h"

#include "buckens/base/errors.h"
#include "buckens/fem/assembly/made_columns.h"
#include "buckens/linalg/grid_library.h"
#include "buckens/linalg/ranks.h"

namespace buckens::cli {

namespace {

constexpr std::array<std::string_view, 3> kVerbs = {"run", "static", "modes"};

bool asks(int argc, const char* const* argv, std::string_view word) {
  return std::find(argv + std::min(argc, 1), argv + argc, word) != argv + argc;
}

/// Of the first process on a machine that lacks the plug-in; the others are silent.
int refuse(int argc, const char* const* argv, const linalg::StartedProcesses& started) {
  if (started.rank_on_machine > 0) return static_cast<int>(ExitCode::io);
  Failure failure;
  failure.code = ExitCode::io;
  failure.kind = "io";
  failure.message = fmt::format(
      "mpirun has started {} processes, which share large solves by PETSc: {}; or run it without "
      "mpirun",
      started.count, linalg::missing_grid_solver());
  return report_failure(failure, asks(argc, argv, "--json"));
}

}  // namespace

bool are_several(int argc, const char* const* argv) {
  if (linalg::started_processes().count < 2) return false;
  if (asks(argc, argv, "--help") || asks(argc, argv, "-h")) return false;
  return std::any_of(kVerbs.begin(), kVerbs.end(),
                     [&](std::string_view verb) { return argc > 1 && verb == argv[1]; });
}

int run_together(int argc, const char* const* argv) {
  const linalg::StartedProcesses started = linalg::started_processes();
  if (!linalg::missing_grid_solver().empty()) return refuse(argc, argv, started);
  linalg::Ranks ranks;
  if (ranks.is_first()) return run_program(argc, argv);
  // The first process ends the others: after Ctrl-C it still completes its step with their help.
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, SIG_IGN);
  ranks.serve(fem::made_columns);
  return 0;
}

}  // namespace buckens::cli
