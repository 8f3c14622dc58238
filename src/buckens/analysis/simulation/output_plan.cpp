// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/output_plan.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/results/stored_size.h"

namespace buckens::analysis {

namespace {

// About this many records if the model file has no `every`.
constexpr double kDefaultRecords = 500;
constexpr double kMostRecords = 1e7;
constexpr double kLargeFile = 4e9;  // bytes

}  // namespace

OutputPlan plan_output(const model::ModelDescription& description) {
  const model::SimulationSpec& simulation = *description.simulation;
  const model::OutputSpec& output = description.output;
  OutputPlan plan;
  double step = 0.0;  // records are not closer than the steps, unless the file says so
  if (!simulation.has_step_control()) {
    const double longest = *simulation.step;
    step = simulation.duration / std::max(1.0, std::ceil(simulation.duration / longest - 1e-9));
  }
  plan.every = output.every.value_or(std::max(simulation.duration / kDefaultRecords, step));
  plan.finest = plan.every;
  plan.records = simulation.duration / plan.every + 1.0;  // the one at the start
  if (plan.records > kMostRecords + 1.0) {
    throw InputError(output.where,
                     fmt::format("output: `every` asks for {:.3g} records, more than {:.0e}; use a "
                                 "longer time than {:.3g} s",
                                 plan.records, kMostRecords, plan.every));
  }
  if (!output.field_output) return plan;
  if (output.field_output->extremes == model::ExtremeRate::steps) {
    plan.finest = std::min(plan.every, step);
  }
  const double stride = output.field_output->every.value_or(plan.every) / plan.every;
  plan.fields_stride = std::max(1L, std::lround(stride));
  if (std::abs(stride - static_cast<double>(plan.fields_stride)) > 1e-6 * stride) {
    throw InputError(output.field_output->where,
                     fmt::format("output.fields: `every` is {:.6g} s, which is not a multiple of "
                                 "the {:.6g} s between two records; use {:.6g} s",
                                 *output.field_output->every, plan.every,
                                 static_cast<double>(plan.fields_stride) * plan.every));
  }
  // At the start, at every n-th record, and at the end.
  plan.field_records =
      std::ceil((plan.records - 1.0) / static_cast<double>(plan.fields_stride) - 1e-6) + 1.0;
  return plan;
}

double OutputPlan::bytes(const results::RecordLayout& layout,
                         const results::FieldLayout& fields) const {
  // There is a last record at the end if that is not a multiple of the interval.
  const double rows = std::ceil(records - 1e-6);
  return results::stored_bytes(layout, rows, sizeof(double)) +
         results::stored_bytes(fields.fields, std::min(field_records, rows), sizeof(float)) +
         results::stored_bytes(fields.extremes);
}

std::string judge_size(double bytes) {
  if (bytes < kLargeFile) return {};
  return fmt::format(
      "results.h5 will take about {}: record less often (`output.every`, `output.fields.every`), "
      "or fields at fewer places (`output.fields.on`)",
      size_text(bytes));
}

std::string size_text(double bytes) {
  if (bytes < 1e6) return fmt::format("{:.0f} kB", std::ceil(bytes / 1e3));
  return bytes < 1e9 ? fmt::format("{:.0f} MB", bytes / 1e6)
                     : fmt::format("{:.1f} GB", bytes / 1e9);
}

}  // namespace buckens::analysis
