// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/number_range.h"
#include "cli/output.h"
#include "cli/text_table.h"
#include "cli/verbs.h"

#include "buckens/base/errors.h"
#include "buckens/run_store/run_comparison.h"

namespace buckens::cli {

namespace {

using Json = nlohmann::ordered_json;

struct CompareArguments {
  std::string first, second;
  double tolerance = 0;  // 0: none
  bool sensors_only = false;
};

run_store::RunComparison compared(const CompareArguments& arguments) {
  const run_store::RunReader first(arguments.first);
  const run_store::RunReader second(arguments.second);
  run_store::RunComparison out = run_store::compare_runs(first, second);
  if (arguments.sensors_only) {
    std::erase_if(out.quantities,
                  [](const auto& q) { return !q.quantity.starts_with("sensors/"); });
  }
  if (out.quantities.empty()) {
    throw InputError(fmt::format(
        "{} and {} have no {} with the same name and shape, so there is nothing to compare; {}",
        arguments.first, arguments.second, arguments.sensors_only ? "sensor" : "quantity",
        arguments.sensors_only ? "leave `--sensors` out, or record the same sensors"
                               : "compare runs of one model"));
  }
  std::stable_sort(out.quantities.begin(), out.quantities.end(),
                   [](const auto& a, const auto& b) { return a.relative > b.relative; });
  return out;
}

std::string comparison_text(const CompareArguments& arguments,
                            const run_store::RunComparison& found) {
  std::string out =
      found.is_of_modes
          ? fmt::format("{} and {}: {}\n", arguments.first, arguments.second,
                        counted(static_cast<long>(found.common_times), "vibration"))
          : fmt::format("{} and {}: {} from {:.6g} to {:.6g} s\n", arguments.first,
                        arguments.second,
                        counted(static_cast<long>(found.common_times), "common record"),
                        found.first_time, found.last_time);
  std::vector<std::vector<std::string>> rows = {{"quantity", "unit", "largest", "difference",
                                                 found.is_of_modes ? "number" : "at t [s]",
                                                 "relative"}};
  for (const auto& q : found.quantities) {
    rows.push_back({q.quantity, q.unit, fmt::format("{:.5g}", q.largest),
                    fmt::format("{:.3g}", q.difference), fmt::format("{:.6g}", q.at),
                    fmt::format("{:.2g}", q.relative)});
  }
  out += text_table(rows);
  const auto list = [&out](const char* what, const std::vector<std::string>& paths) {
    if (paths.empty()) return;
    out += fmt::format("{}: {}\n", what, fmt::join(paths, ", "));
  };
  list("only in the first", found.only_in_first);
  list("only in the second", found.only_in_second);
  list("of other meshes, not compared", found.of_other_shape);
  if (arguments.tolerance > 0) {
    const bool agree = found.largest() <= arguments.tolerance;
    out += fmt::format("largest relative difference {:.3g}: {} the tolerance {:g}\n",
                       found.largest(), agree ? "within" : "beyond", arguments.tolerance);
  }
  return out;
}

std::string comparison_json(const CompareArguments& arguments,
                            const run_store::RunComparison& found) {
  Json quantities = Json::array();
  for (const auto& q : found.quantities) {
    quantities.push_back({{"quantity", q.quantity},
                          {"unit", q.unit},
                          {"largest", q.largest},
                          {"difference", q.difference},
                          {"at", q.at},
                          {"relative", q.relative}});
  }
  Json out = {{"first", arguments.first},
              {"second", arguments.second},
              {"kind", found.is_of_modes ? "vibrations" : "motion"},
              {"common_records", found.common_times},
              {"first_time", found.first_time},
              {"last_time", found.last_time},
              {"largest_relative_difference", found.largest()},
              {"quantities", std::move(quantities)},
              {"only_in_first", found.only_in_first},
              {"only_in_second", found.only_in_second},
              {"of_other_shape", found.of_other_shape}};
  if (arguments.tolerance > 0) out["within_tolerance"] = found.largest() <= arguments.tolerance;
  return to_text(out);
}

ExitCode compare(const CompareArguments& arguments, bool json) {
  const run_store::RunComparison found = compared(arguments);
  print(json ? comparison_json(arguments, found) : comparison_text(arguments, found));
  const bool differ = arguments.tolerance > 0 && !(found.largest() <= arguments.tolerance);
  return differ ? ExitCode::different : ExitCode::ok;
}

constexpr char kCompareFooter[] = R"(
Examples:
  buckens compare full reduced                       differences, largest first
  buckens compare full reduced --sensors --tolerance 1e-3
  buckens compare modes_a modes_b                    frequencies of two `buckens modes -o`

Values are compared at the record times that the runs have in common; nothing is interpolated.
"relative" is the difference over the largest magnitude of the quantity in the first run; energies are
relative to the largest energy. Lengths and angles in one channel are judged separately, as are forces
and torques.

Exit codes: 0 compared, and within the tolerance if one is given, 2 bad input, 5 files, 6 the runs
differ by more than the tolerance. Details: docs/reference/command-line.md)";

}  // namespace

void add_compare_verb(CLI::App& program, Invocation& invocation) {
  CLI::App& verb = *program.add_subcommand("compare", "Compare two runs of a model");
  const auto arguments = std::make_shared<CompareArguments>();
  verb.add_option("A", arguments->first, "Run directory")->required();
  verb.add_option("B", arguments->second, "Run directory")->required();
  verb.add_option("--tolerance", arguments->tolerance,
                  "Largest acceptable relative difference; beyond it the exit code is 6")
      ->check(any_number(true));
  verb.add_flag("--sensors", arguments->sensors_only, "Compare sensors only");
  add_json_option(verb, invocation);
  verb.footer(kCompareFooter);
  verb.callback([arguments, &invocation] {
    invocation.action = [arguments, &invocation] { return compare(*arguments, invocation.json); };
  });
}

}  // namespace buckens::cli
