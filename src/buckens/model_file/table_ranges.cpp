// SPDX-License-Identifier: Apache-2.0
#include "buckens/model_file/table_ranges.h"

#include <optional>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/field.h"
#include "buckens/model/spec/description_member.h"

namespace buckens::model_file {

namespace {

using Form = base::MemberType::Form;

// Durations and times of a table are read from decimals; see time_law.cpp.
constexpr double kRounding = 1e-9;

/// Visits every law of time below a member.
class RangeChecker {
 public:
  explicit RangeChecker(double duration) : duration_(duration) {}

  void visit(const base::Member& member) const {
    if (const auto* law = member.get<base::TimeLaw>()) check(*law);
    if (const auto* law = member.get<base::SignalLaw>()) {
      if (!law->formula) check(law->law);
    }
    const Form form = member.type->form();
    if (form == Form::record) {
      for (const base::Field& field : member.fields()) visit(field.member);
    } else if (form != Form::value && form != Form::choice && form != Form::reference) {
      for (const base::Member& part : member.parts()) visit(part);
    }
  }

 private:
  void check(const base::TimeLaw& law) const {
    const std::optional<base::TimeRange> range = law.range();
    if (!range) return;
    const double rounding = kRounding * (range->last - range->first);
    if (range->first <= rounding && range->last >= duration_ - rounding) return;
    throw InputError(
        range->where,
        fmt::format("the table goes from t = {:.6g} s to {:.6g} s, but its values are needed from "
                    "0 to {:.6g} s; add points, or write `extrapolation: hold`",
                    range->first, range->last, duration_));
  }

  double duration_;
};

}  // namespace

void check_table_ranges(const model::ModelDescription& model) {
  const RangeChecker checker(model.simulation ? model.simulation->duration : 0.0);
  const base::Member description = model::description_member(model);
  for (const char* list : {"loads", "joints", "signals"}) {
    checker.visit(model::field_member(description, list));
  }
}

}  // namespace buckens::model_file
