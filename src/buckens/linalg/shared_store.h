// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <typeindex>
#include <utility>
#include <vector>

namespace buckens::linalg {

/// Constant objects that several owners have in common, each as long as one of them holds it.
class SharedStore {
 public:
  /// The object of type T, among those that are still held, of which matches(object) is true;
  /// otherwise make().
  /// @param make returns a shared_ptr<const T>; what it returns is known from then on unless empty
  template <class T, class Matches, class Make>
  std::shared_ptr<const T> find_or_make(Matches&& matches, Make&& make) {
    std::erase_if(known_, [](const Known& one) { return one.object.expired(); });
    for (const Known& one : known_) {
      if (one.type != typeid(T)) continue;
      auto object = std::static_pointer_cast<const T>(one.object.lock());
      if (object && matches(*object)) return object;
    }
    std::shared_ptr<const T> made = make();
    if (made) known_.push_back({typeid(T), made});
    return made;
  }

 private:
  struct Known {
    std::type_index type;
    std::weak_ptr<const void> object;
  };
  std::vector<Known> known_;
};

}  // namespace buckens::linalg
