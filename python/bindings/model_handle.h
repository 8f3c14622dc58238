// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "buckens/base/errors.h"
#include "buckens/model/build/build_model.h"
#include "buckens/model/build/function_signals.h"

namespace buckens::python {

/// Calls a function, and takes places in a file that the user has not seen out of its errors.
template <class Work>
auto without_places(const std::string& file, Work&& work) {
  try {
    return work();
  } catch (const InputError& error) {
    if (error.where().file != file) throw;
    throw InputError(error.text());
  } catch (const ModelError& error) {
    if (error.where().file != file) throw;
    throw ModelError(error.text());
  } catch (const IoError& error) {
    if (error.where().file != file) throw;
    throw IoError(error.text());
  }
}

/// A model as read; it is built for the first simulation that needs it.
class ModelHandle {
 public:
  /// @param unseen name of a text that the user has not seen; empty: the user's file
  ModelHandle(model::ModelDescription description, std::string unseen);

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
  /// Calls a function that builds the model or sets it up; its errors cite no lines that the user
  /// has not seen.
  template <class Work>
  void call(Work&& work) const {
    without_places(unseen_, work);
  }
  /// The same with forces and signals in code, which other simulations do not get.
  std::shared_ptr<const model::BuiltModel> built_with(
      std::vector<model::OwnForce> forces, const std::vector<model::SignalFunction>& signals) const;

 private:
  model::ModelDescription description_;
  std::string unseen_;
  mutable std::mutex mutex_;
  mutable std::shared_ptr<const model::BuiltModel> built_;
};

}  // namespace buckens::python
