// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include "buckens/base/field.h"
#include "buckens/base/source_location.h"

namespace buckens::model {

/// Which way a signal goes through zero.
enum class Crossing { rising, falling, both };

constexpr std::array<const char*, 3> choice_names(Crossing) {
  return {"rising", "falling", "both"};
}

enum class EventAction { note, stop };

constexpr std::array<const char*, 2> choice_names(EventAction) { return {"note", "stop"}; }

/// Something that happens when a signal goes through zero.
struct EventSpec {
  std::string name;
  SourceLocation where;
  std::string when;  ///< name of a signal
  Crossing direction = Crossing::both;
  EventAction action = EventAction::note;

  template <class Visitor>
  void fields(Visitor& visit) {
    visit(base::field("when", when, "name of the signal that goes through zero")
              .required()
              .like("height"));
    visit(base::field("direction", direction, "which way it goes"));
    visit(base::field("do", action,
                      "`note` the time in the summary of the run, or note it and `stop`"));
  }
};

}  // namespace buckens::model
