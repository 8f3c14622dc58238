// SPDX-License-Identifier: Apache-2.0
#include "cli/several_processes.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdlib>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

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

int report(int argc, const char* const* argv, ExitCode code, std::string kind,
           std::string message) {
  Failure failure;
  failure.code = code;
  failure.kind = std::move(kind);
  failure.message = std::move(message);
  return report_failure(failure, asks(argc, argv, "--json"));
}

/// Of the first process on a machine that lacks the plug-in; the others are silent.
int refuse(int argc, const char* const* argv, const linalg::StartedProcesses& started) {
  if (started.rank_on_machine > 0) return static_cast<int>(ExitCode::io);
  return report(argc, argv, ExitCode::io, "io",
                fmt::format("mpirun has started {} processes, which share large solves by PETSc: "
                            "{}; or run it without mpirun",
                            started.count, linalg::missing_grid_solver()));
}

/// From how many variables on bodies are shared, if the environment says it.
constexpr char kVariablesName[] = "BUCKENS_MPI_VARIABLES";

/// @return false if what the environment says is no such number
bool read_shared_size() {
  const char* text = std::getenv(kVariablesName);
  if (text == nullptr || *text == '\0') return true;
  const std::string_view given = text;
  int variables = 0;
  const auto [end, failed] = std::from_chars(given.data(), given.data() + given.size(), variables);
  const bool is_number = failed == std::errc() && end == given.data() + given.size();
  if (!is_number || variables < linalg::kFewestShared) return false;
  linalg::share_from(variables);
  return true;
}

int refuse_shared_size(int argc, const char* const* argv, const linalg::StartedProcesses& started) {
  if (started.rank > 0) return static_cast<int>(ExitCode::input);
  return report(
      argc, argv, ExitCode::input, "input",
      fmt::format("the environment variable {} is \"{}\", but should be the number of "
                  "variables from which on processes share a body, {} to {}; unset it for "
                  "{}",
                  kVariablesName, std::getenv(kVariablesName), linalg::kFewestShared,
                  std::numeric_limits<int>::max(), linalg::kWorthSharing));
}

/// Whether what waits while a factor is computed may be on the disk: plug-ins read it.
constexpr char kDiskName[] = "BUCKENS_MPI_DISK";

bool is_disk_told_well() {
  const char* text = std::getenv(kDiskName);
  const std::string_view given = text != nullptr ? text : "";
  return given.empty() || given == "on" || given == "off";
}

int refuse_disk(int argc, const char* const* argv, const linalg::StartedProcesses& started) {
  if (started.rank > 0) return static_cast<int>(ExitCode::input);
  return report(argc, argv, ExitCode::input, "input",
                fmt::format("the environment variable {} is \"{}\", but should be \"on\" or "
                            "\"off\": whether the factor and matrices may be on the disk while "
                            "the factor is computed; unset it for \"on\"",
                            kDiskName, std::getenv(kDiskName)));
}

/// Time for the processes to find each other. MPI itself waits for ever if one of them never joins.
constexpr double kSecondsToJoin = 120;
constexpr char kSecondsName[] = "BUCKENS_MPI_SECONDS";
// The first process tells what is missing, or the second if that is the first itself.
constexpr double kMorePerRank = 3, kMost = 10;

double seconds_to_join(int rank) {
  const char* text = std::getenv(kSecondsName);
  const double given = text != nullptr ? std::atof(text) : 0.0;
  return (given > 0.0 ? given : kSecondsToJoin) + std::min(kMost, kMorePerRank * rank);
}

/// Ends this process if the others have not joined it in time.
class JoinLimit {
 public:
  JoinLimit(const linalg::StartedProcesses& started, bool json)
      : thread_([this, started, json] { watch(started, json); }) {}
  ~JoinLimit() {
    {
      const std::scoped_lock lock(mutex_);
      has_joined_ = true;
    }
    changed_.notify_one();
    thread_.join();
  }
  JoinLimit(const JoinLimit&) = delete;
  JoinLimit& operator=(const JoinLimit&) = delete;

 private:
  void watch(const linalg::StartedProcesses& started, bool json) {
    const double limit = seconds_to_join(started.rank);
    std::unique_lock lock(mutex_);
    const auto patience = std::chrono::duration<double>(limit);
    if (changed_.wait_for(lock, patience, [this] { return has_joined_; })) return;
    Failure failure;
    failure.code = ExitCode::io;
    failure.kind = "io";
    failure.message = fmt::format(
        "mpirun has started {} processes, but not all have joined within {:.0f} s: each of them "
        "has to be buckens with the same verb; start it without mpirun where a script or another "
        "program calls it, or raise the limit by the environment variable {}",
        started.count, limit, kSecondsName);
    const int code = static_cast<int>(failure.code);
    std::_Exit(started.rank < 2 ? report_failure(failure, json) : code);
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  bool has_joined_ = false;
  std::thread thread_;  // last: it uses the others
};

/// Whether every process would run all variants of a sweep.
bool repeats_sweep(int argc, const char* const* argv) {
  if (argc < 2 || std::string_view(argv[1]) != "sweep") return false;
  return std::none_of(argv + 2, argv + argc, [](std::string_view word) {
    return word.starts_with("--shard") || word.starts_with("--merge") ||
           word.starts_with("--status");
  });
}

int refuse_sweep(int argc, const char* const* argv, const linalg::StartedProcesses& started) {
  if (started.rank > 0) return static_cast<int>(ExitCode::input);
  return report(argc, argv, ExitCode::input, "input",
                fmt::format("mpirun has started {} processes, each of which would run all variants "
                            "of the sweep; start it without mpirun, or give each process its part "
                            "(--shard I/{})",
                            started.count, started.count));
}

}  // namespace

bool are_several(int argc, const char* const* argv) {
  if (linalg::started_processes().count < 2) return false;
  if (asks(argc, argv, "--help") || asks(argc, argv, "-h")) return false;
  if (repeats_sweep(argc, argv)) return true;
  return std::any_of(kVerbs.begin(), kVerbs.end(),
                     [&](std::string_view verb) { return argc > 1 && verb == argv[1]; });
}

int run_together(int argc, const char* const* argv) {
  const linalg::StartedProcesses started = linalg::started_processes();
  if (repeats_sweep(argc, argv)) return refuse_sweep(argc, argv, started);
  if (!linalg::missing_grid_solver().empty()) return refuse(argc, argv, started);
  if (!read_shared_size()) return refuse_shared_size(argc, argv, started);
  if (!is_disk_told_well()) return refuse_disk(argc, argv, started);
  std::optional<JoinLimit> limit(std::in_place, started, asks(argc, argv, "--json"));
  linalg::Ranks ranks;
  limit.reset();
  if (ranks.is_first()) return run_program(argc, argv);
  // The first process ends the others: after Ctrl-C it still completes its step with their help.
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, SIG_IGN);
  ranks.serve(fem::made_columns);
  return 0;
}

}  // namespace buckens::cli
