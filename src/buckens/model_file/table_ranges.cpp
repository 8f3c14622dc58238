// SPDX-License-Identifier: Apache-2.0
#include "buckens/model_file/table_ranges.h"

#include <optional>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/field_types.h"
#include "buckens/base/visit_fields.h"

namespace buckens::model_file {

namespace {

// Durations and times of a table are read from decimals; see time_law.cpp.
constexpr double kRounding = 1e-9;

/// Visits every law of time below a spec.
class RangeChecker {
 public:
  explicit RangeChecker(double duration) : duration_(duration) {}

  template <class T>
  void operator()(const base::Field<const T>& field) {
    visit(field.member);
  }

  template <class T>
  void visit(const T& value) {
    if constexpr (std::is_same_v<T, base::TimeLaw>) {
      check(value);
    } else if constexpr (std::is_same_v<T, base::SignalLaw>) {
      if (!value.formula) check(value.law);
    } else if constexpr (base::kIsOptional<T>) {
      if (value) visit(*value);
    } else if constexpr (base::kIsVariant<T>) {
      std::visit([&](const auto& alternative) { visit(alternative); }, value);
    } else if constexpr (base::kIsArray<T> || base::kIsVector<T>) {
      for (const auto& item : value) visit(item);
    } else if constexpr (base::HasFields<T>) {
      base::visit_fields(value, *this);
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
  RangeChecker checker(model.simulation ? model.simulation->duration : 0.0);
  checker.visit(model.loads);
  checker.visit(model.joints);
  checker.visit(model.signals);
}

}  // namespace buckens::model_file
