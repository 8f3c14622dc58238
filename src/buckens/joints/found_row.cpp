// SPDX-License-Identifier: Apache-2.0
#include "buckens/joints/found_row.h"

#include <cmath>
#include <utility>

namespace buckens::joints {

using spatial::MarkerBias;
using spatial::MarkerMotion;

namespace {

const double* behind_first(const double* states) {
  return states == nullptr ? nullptr : states + 1;
}

}  // namespace

FoundRow::FoundRow(ConstraintRow row, double period) : row_(std::move(row)), period_(period) {}

RowValue FoundRow::evaluate(const MarkerMotion& F, const MarkerMotion& M, double t,
                            const double* states) const {
  RowValue out = row_.evaluate(F, M, t, behind_first(states));
  if (states == nullptr || states[0] == 0.0) return out;
  out.g -= states[0];
  if (period_ > 0.0) out.g = std::remainder(out.g, period_);
  return out;
}

double FoundRow::bias(const MarkerMotion& F, const MarkerMotion& M, const MarkerBias& bias_F,
                      const MarkerBias& bias_M, double t, const double* states) const {
  return row_.bias(F, M, bias_F, bias_M, t, behind_first(states));
}

void FoundRow::follow(const MarkerMotion& F, const MarkerMotion& M, double lambda, double t,
                      const double* before, double* after) const {
  after[0] = before == nullptr ? 0.0 : before[0];
  if (row_.law() != nullptr) {
    row_.law()->follow(F, M, lambda, t, behind_first(before), after + 1);
  }
}

void FoundRow::attach(const MarkerMotion& F, const MarkerMotion& M, double t,
                      double* states) const {
  if (row_.law() != nullptr) row_.law()->attach(F, M, t, states + 1);
  states[0] = row_.evaluate(F, M, t, states + 1).g;
}

}  // namespace buckens::joints
