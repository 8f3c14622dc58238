// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/function_signals.h"

#include <algorithm>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/nearest.h"
#include "buckens/model/build/add_signals.h"

namespace buckens::model {

namespace {

std::size_t find_signal(const ModelDescription& description, const std::string& name,
                        const std::string& who) {
  std::vector<std::string> known;
  for (std::size_t k = 0; k < description.signals.size(); ++k) {
    if (description.signals[k].name == name) return k;
    known.push_back(description.signals[k].name);
  }
  throw InputError(
      known.empty()
          ? fmt::format("{}, but the model has no `signals`; add them to it", who)
          : fmt::format("{}, and there is no such signal.{}", who, base::suggestion(name, known)));
}

void require_free(const ModelDescription& description, std::size_t index) {
  const SignalSpec& spec = description.signals[index];
  if (!spec.setting && !spec.value) {
    throw ModelError(spec.where,
                     fmt::format("signal \"{}\" follows from the motion or has states; only one "
                                 "with a `setting` or a formula takes a function",
                                 spec.name));
  }
  for (const EventSpec& event : description.events) {
    for (const SettingChange& change : event.changes) {
      if (change.name != spec.name) continue;
      throw ModelError(event.where,
                       fmt::format("event \"{}\" sets the signal \"{}\", which a function gives; "
                                   "let the event set another signal that the function takes",
                                   event.name, spec.name));
    }
  }
}

}  // namespace

void give_functions(const std::vector<SignalFunction>& functions, BuiltModel& built) {
  const ModelDescription& description = built.description;
  for (const SignalFunction& function : functions) {
    const std::size_t index =
        find_signal(description, function.name,
                    fmt::format("a function gives the signal \"{}\"", function.name));
    require_free(description, index);
    std::vector<int> places;
    for (const std::string& input : function.inputs) {
      places.push_back(static_cast<int>(find_signal(
          description, input,
          fmt::format("the function of signal \"{}\" takes \"{}\"", function.name, input))));
    }
    Signal& signal = built.model.signals.all[index];
    signal.kind = Signal::Kind::block;
    signal.input = {};
    signal.block =
        std::make_shared<FunctionSignal>(function.name, function.inputs, places, function.law);
  }
  if (!functions.empty()) connect_signals(description, built.model);
}

}  // namespace buckens::model
