// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/curve_plot.h"
#include "cli/number_range.h"
#include "cli/output.h"
#include "cli/verbs.h"

#include "buckens/base/errors.h"
#include "buckens/run_store/run_curves.h"
#include "buckens/run_store/run_directory.h"

namespace buckens::cli {

namespace {

namespace fs = std::filesystem;

// A picture of points has twice as many in each direction, four bytes each.
constexpr double kLargestPicture = 4000;

struct PlotArguments {
  std::vector<std::string> places;   // run directories, then sensors
  std::vector<std::string> sensors;  // by option
  std::string out = "plot.svg", title, x;
  std::optional<double> from, to;
  std::vector<double> size;
};

/// A run with the name that its curves bear.
struct NamedRun {
  std::string name;
  std::unique_ptr<run_store::RunReader> reader;
};

bool is_run(const std::string& place) {
  std::error_code ignored;
  return fs::exists(fs::path(place) / run_store::kSummaryName, ignored);
}

std::vector<NamedRun> open_runs(PlotArguments& arguments) {
  std::vector<NamedRun> runs;
  std::vector<std::string> sensors;
  for (const std::string& place : arguments.places) {
    // The first is always meant as a run: its reader says what is wrong with it.
    if (runs.empty() || is_run(place)) {
      const std::string path = fs::path(place).lexically_normal().string();
      runs.push_back({path, std::make_unique<run_store::RunReader>(place)});
    } else {
      sensors.push_back(place);
    }
  }
  sensors.insert(sensors.end(), arguments.sensors.begin(), arguments.sensors.end());
  arguments.sensors = std::move(sensors);
  return runs;
}

/// The records between two times.
std::vector<std::size_t> records_between(const run_store::RunReader& run,
                                         const PlotArguments& arguments) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < run.num_records(); ++i) {
    const double t = run.times()[i];
    if (arguments.from && t < *arguments.from) continue;
    if (arguments.to && t > *arguments.to) continue;
    out.push_back(i);
  }
  if (out.empty()) {
    throw InputError(fmt::format("no record lies between --from and --to; {}",
                                 run.num_records() == 0
                                     ? "the run has none yet"
                                     : fmt::format("they go from {:.6g} to {:.6g} s",
                                                   run.times().front(), run.times().back())));
  }
  return out;
}

std::vector<double> taken(const std::vector<double>& values,
                          const std::vector<std::size_t>& records) {
  std::vector<double> out;
  out.reserve(records.size());
  for (const std::size_t i : records) out.push_back(values[i]);
  return out;
}

/// One curve of a name that must mean one.
run_store::RunCurve single_curve(const run_store::RunReader& run, const std::string& name) {
  std::vector<run_store::RunCurve> curves = run_store::find_curves(run, name);
  if (curves.size() == 1) return std::move(curves.front());
  throw InputError(fmt::format("--x {}: expected one curve; name a component such as {}", name,
                               curves.front().name));
}

void add_curves(const NamedRun& run, const std::string& sensor, bool has_run_name,
                const PlotArguments& arguments, PlotFigure& figure) {
  const std::vector<std::size_t> records = records_between(*run.reader, arguments);
  std::vector<double> x = run.reader->times();
  if (!arguments.x.empty()) {
    run_store::RunCurve curve = single_curve(*run.reader, arguments.x);
    figure.x_unit = curve.unit;
    x = std::move(curve.values);
  }
  for (const run_store::RunCurve& curve : run_store::find_curves(*run.reader, sensor)) {
    auto panel = std::find_if(figure.panels.begin(), figure.panels.end(),
                              [&](const PlotPanel& known) { return known.unit == curve.unit; });
    if (panel == figure.panels.end()) {
      panel = figure.panels.insert(figure.panels.end(), PlotPanel{curve.unit, {}});
    }
    panel->curves.push_back(
        {has_run_name ? fmt::format("{}: {}", run.name, curve.name) : curve.name, taken(x, records),
         taken(curve.values, records)});
  }
}

ExitCode plot(PlotArguments arguments, bool json) {
  const std::vector<NamedRun> runs = open_runs(arguments);
  if (arguments.sensors.empty()) {
    const std::vector<std::string> known = run_store::sensor_names(*runs.front().reader);
    throw InputError(fmt::format("say what to plot. {}",
                                 known.empty() ? "The run has no sensors; name a channel such as "
                                                 "energies/total"
                                               : fmt::format("Sensors of {}: {}", runs.front().name,
                                                             fmt::join(known, ", "))));
  }
  PlotFigure figure;
  figure.title = arguments.title;
  if (figure.title.empty() && runs.size() == 1) figure.title = runs.front().reader->title();
  if (!arguments.x.empty()) {
    figure.x_name = arguments.x;
    figure.is_x_increasing = false;
  }
  if (arguments.size.size() == 2) {
    figure.width = arguments.size[0];
    figure.height = arguments.size[1];
  }
  for (const std::string& sensor : arguments.sensors) {
    for (const NamedRun& run : runs) {
      try {
        add_curves(run, sensor, runs.size() > 1, arguments, figure);
      } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", run.name, error.what()));
      }
    }
  }
  draw_figure(figure, arguments.out);
  std::size_t curves = 0;
  for (const PlotPanel& panel : figure.panels) curves += panel.curves.size();
  if (json) {
    print(to_text({{"file", arguments.out}, {"panels", figure.panels.size()}, {"curves", curves}}));
  } else {
    print(fmt::format("{} ({} {})\n", arguments.out, curves, curves == 1 ? "curve" : "curves"));
  }
  return ExitCode::ok;
}

constexpr char kPlotFooter[] = R"(
Examples:
  buckens plot out tip.x tip.y -o tip.svg          two components of a sensor over time
  buckens plot out energies/kinetic energies/strain -o energy.png
  buckens plot coarse fine --sensor tip.y          the same curve of two runs
  buckens plot out angle.velocity --x angle        one sensor over another

A sensor without a component gives all its components; NAME.norm is the length of a vector. Curves
with different units get separate diagrams, one below the other.

Exit codes: 0 done, 2 bad input, 5 a run cannot be read or the picture cannot be written.
Details: docs/tutorials/results.md)";

}  // namespace

void add_plot_verb(CLI::App& program, Invocation& invocation) {
  CLI::App& verb = *program.add_subcommand("plot", "Plot sensors to a picture");
  const auto arguments = std::make_shared<PlotArguments>();
  verb.add_option("OUT SENSOR...", arguments->places,
                  "Run directories, and names of sensors or channels")
      ->required();
  verb.add_option("--sensor", arguments->sensors, "Name of a sensor; may be repeated")
      ->type_name("NAME")
      ->allow_extra_args(false);
  verb.add_option("-o,--out", arguments->out, "File for the picture: .svg, .png or .pdf")
      ->type_name("FILE")
      ->capture_default_str();
  verb.add_option("--x", arguments->x, "Sensor for the horizontal axis instead of time")
      ->type_name("NAME");
  verb.add_option("--from", arguments->from, "Start time in seconds")->check(any_number(false));
  verb.add_option("--to", arguments->to, "End time in seconds")->check(any_number(false));
  verb.add_option("--title", arguments->title, "Title; that of the model by default");
  verb.add_option("--size", arguments->size, "Width and height in points of 1/96 inch")
      ->expected(2)
      ->type_name("W H")
      ->check(number_between(150, kLargestPicture));
  add_json_option(verb, invocation);
  verb.footer(kPlotFooter);
  verb.callback([arguments, &invocation] {
    invocation.action = [arguments, &invocation] { return plot(*arguments, invocation.json); };
  });
}

}  // namespace buckens::cli
