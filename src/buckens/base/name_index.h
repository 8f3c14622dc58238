// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>
#include <vector>

namespace buckens::base {

/// Finds entries of one list by their names, in a time that does not grow with the list.
///
/// The list may grow between two calls. Whether an entry still has its name is looked at in each
/// call, so that other changes of the list make it slower, never wrong.
class NameIndex {
 public:
  /// The first entry called `name`, or null. Entries have a member `name`.
  template <class T>
  const T* find(const std::vector<T>& list, const std::string& name) {
    see(list);
    const auto found = places_.find(name);
    if (found != places_.end() && found->second < list.size() && list[found->second].name == name) {
      return &list[found->second];
    }
    for (const T& entry : list) {
      if (entry.name == name) return &entry;
    }
    return nullptr;
  }

  /// Whether the list has an entry called `name`. One that got this name after it was first seen is
  /// not found: a "no" takes no time that grows with the list either.
  template <class T>
  bool has_seen(const std::vector<T>& list, const std::string& name) {
    see(list);
    return places_.contains(name) && find(list, name) != nullptr;
  }

 private:
  template <class T>
  void see(const std::vector<T>& list) {
    if (list.size() < num_known_) {
      places_.clear();
      num_known_ = 0;
    }
    for (; num_known_ < list.size(); ++num_known_)
      places_.emplace(list[num_known_].name, num_known_);
  }

  std::unordered_map<std::string, std::size_t> places_;
  std::size_t num_known_ = 0;
};

}  // namespace buckens::base
