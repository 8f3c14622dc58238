// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "buckens/analysis/statics/rest_rows.h"

namespace buckens::analysis {

/// Elastic contacts with frozen friction on which bodies land in the steps of a descent: friction
/// holds them from where they touch, before they sink in.
///
/// Springs of contacts that are open by less than kDifference are felt by the linearised loads, so
/// that bodies sink in gently: these contacts are held in the step in which they begin to press. A
/// step that leads to such a contact from afar ends where it touches. Theory:
/// docs/theory/12-static-paths.md §5.
class Landings {
 public:
  /// @param rest must outlive this object
  explicit Landings(const RestRows& rest);

  /// Closes rows of contacts that are nearly touched at the start of a step and press at its end.
  /// @param values at the start, @param end bodies at the end
  /// @return whether there are any that were open: the step must then be found again
  bool hold(const RestValues& values, const std::vector<dynamics::BodyMotion>& end, double t,
            RestStands& stands) const;

  /// Bodies after a share of the step, from 0 to 1.
  using Way = std::function<std::vector<dynamics::BodyMotion>(double share)>;
  /// Share of a step at which the first contact is touched that begins to press in it from afar;
  /// empty if none does. After a few such steps a contact does not end any more of them.
  std::optional<double> find(const Way& way, double t);

 private:
  struct Touch {
    std::size_t first = 0, end = 0;  ///< its rows among RestRows
    int landings = 0;                ///< so far
  };
  double gap(const Touch& touch, const std::vector<dynamics::BodyMotion>& motions, double t) const;

  const RestRows& rest_;
  std::vector<Touch> touches_;
};

}  // namespace buckens::analysis
