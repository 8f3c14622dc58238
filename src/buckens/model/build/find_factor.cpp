// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/find_factor.h"

#include <vector>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/nearest.h"

namespace buckens::model {

loads::SignalFactor find_factor(const Model& model, const std::string& name,
                                const std::string& load, const SourceLocation& where) {
  if (name.empty()) return loads::SignalFactor();
  std::vector<std::string> known;
  for (std::size_t k = 0; k < model.signals.all.size(); ++k) {
    if (model.signals.all[k].name == name) return loads::SignalFactor(static_cast<int>(k));
    known.push_back(model.signals.all[k].name);
  }
  throw InputError(where, fmt::format("load \"{}\": there is no signal \"{}\".{}", load, name,
                                      base::suggestion(name, known)));
}

}  // namespace buckens::model
