// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "buckens/model/build/build_model.h"
#include "buckens/model/build/function_signals.h"

namespace buckens::python {

/// A model as read; it is built for the first simulation that needs it.
class ModelHandle {
 public:
  explicit ModelHandle(model::ModelDescription description);

  /// @throws InputError citing file:line:column; IoError
  static std::shared_ptr<ModelHandle> read(const std::string& path,
                                           const std::vector<std::string>& overrides);
  /// The same from a text.
  /// @param name of the text in messages; tables are searched for in its directory
  /// @param is_generated the user has not seen the text, so that messages do not cite its lines
  static std::shared_ptr<ModelHandle> parse(const std::string& text, const std::string& name,
                                            const std::vector<std::string>& overrides,
                                            bool is_generated);

  const model::ModelDescription& description() const { return description_; }
  /// @throws InputError, ModelError with the names of bodies, joints and markers
  std::shared_ptr<const model::BuiltModel> built() const;
  /// The same with forces and signals in code, which other simulations do not get.
  std::shared_ptr<const model::BuiltModel> built_with(
      std::vector<model::OwnForce> forces, const std::vector<model::SignalFunction>& signals) const;

 private:
  model::ModelDescription description_;
  mutable std::mutex mutex_;
  mutable std::shared_ptr<const model::BuiltModel> built_;
};

}  // namespace buckens::python
