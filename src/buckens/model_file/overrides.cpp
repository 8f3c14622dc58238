// SPDX-License-Identifier: Apache-2.0
#include "buckens/model_file/overrides.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/nearest.h"
#include "buckens/model_file/shape.h"

namespace buckens::model_file {

namespace {

/// Goes down the tree and the format's shape together.
class OverrideWalk {
 public:
  OverrideWalk(YamlNode& root, std::string where)
      : node_(&root), shape_(&model_file_shape()), where_(std::move(where)) {}

  YamlNode& node() { return *node_; }
  /// Name of a parameter that was not there before, or empty.
  const std::string& added_parameter() const { return added_parameter_; }

  /// @param is_last the value goes here
  void enter(const std::string& key, bool is_last) {
    names_entry_ = shape_ != nullptr && shape_->kind == Shape::Kind::reference;
    while (shape_ != nullptr &&
           (shape_->kind == Shape::Kind::reference || shape_->kind == Shape::Kind::time_law)) {
      shape_ = shape_->element.data();
    }
    if (shape_ == nullptr) {
      fail(fmt::format("there is nothing below \"{}\"", path_));
    } else if (shape_->kind == Shape::Kind::record && shape_->find(key) == nullptr &&
               shape_->shorthand() != nullptr) {
      // A value that stands for its record, such as the position of a node.
      const FieldShape* list = node_->is_list() ? shape_->list_shorthand() : nullptr;
      shape_ = &(list != nullptr ? list : shape_->shorthand())->shape;
      enter(key, is_last);
      return;
    }
    switch (shape_->kind) {
      case Shape::Kind::record:
        enter_record(key);
        break;
      case Shape::Kind::named:
        enter_named(key, is_last);
        break;
      case Shape::Kind::list:
        enter_list(key);
        break;
      default:
        fail(fmt::format("there is nothing below \"{}\"", path_));
    }
    path_ += (path_.empty() ? "" : ".") + key;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError({where_, 0, 0}, message);
  }

  YamlNode* child(const std::string& key) {
    if (node_->kind == YamlNode::Kind::null) node_->kind = YamlNode::Kind::map;
    if (!node_->is_map()) {
      fail(fmt::format("\"{}\" holds {} in the model file; set {}it as a whole", path_,
                       node_->description(),
                       names_entry_ ? "a value of the entry of that name, or " : ""));
    }
    return node_->find(key);
  }

  void enter_record(const std::string& key) {
    const FieldShape* field = shape_->find(key);
    if (field == nullptr) {
      fail(fmt::format("unknown key \"{}\"{}.{}", key, path_.empty() ? "" : " in " + path_,
                       base::suggestion(key, shape_->keys())));
    }
    YamlNode* found = child(key);
    if (found == nullptr) found = &append(key);
    node_ = found;
    shape_ = &field->shape;
    example_ = field->note.example;
  }

  /// A new entry is added, unless its name looks like a typing error and only a part of it is
  /// given.
  void enter_named(const std::string& key, bool is_last) {
    YamlNode* found = child(key);
    if (found == nullptr) {
      std::vector<std::string> known;
      for (const YamlEntry& entry : node_->entries) known.push_back(entry.key);
      const bool is_slip = !is_last && !base::nearest(key, known).empty();
      if (key.empty() || is_slip) {
        fail(fmt::format(
            "the model file has no \"{}\" in {}.{}{}", key, path_, base::suggestion(key, known),
            is_slip ? fmt::format(" To add it, set it as a whole: {}.{}={{...}}", path_, key)
                    : ""));
      }
      if (path_ == "parameters") added_parameter_ = key;
      found = &append(key);
    }
    node_ = found;
    shape_ = shape_->element.data();
  }

  YamlNode& append(const std::string& key) {
    const SourceLocation place{where_, 0, 0};
    YamlNode empty;
    empty.where = place;
    node_->entries.push_back({key, place, empty});
    return node_->entries.back().value;
  }

  void enter_list(const std::string& key) {
    if (!node_->is_list()) {
      const bool is_missing = node_->kind == YamlNode::Kind::null;
      fail(fmt::format("the model file has {} at \"{}\", not a list; set it as a whole{}",
                       is_missing ? "nothing" : node_->description(), path_,
                       example_.empty() ? "" : fmt::format(": {}={}", path_, example_)));
    }
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), index);
    const bool is_number = error == std::errc() && end == key.data() + key.size() && !key.empty();
    if (!is_number || index >= node_->items.size()) {
      fail(fmt::format("\"{}\" is not an item of {}; it has {} items, counted from 0", key, path_,
                       node_->items.size()));
    }
    node_ = &node_->items[index];
    shape_ = shape_->element.data();
  }

  YamlNode* node_;
  const Shape* shape_;
  std::string where_;
  std::string path_;
  std::string example_;  // of the field entered last
  std::string added_parameter_;
  bool names_entry_ = false;  // the value may be the name of an entry elsewhere
};

/// Whether any value holds the name as a word of its own.
bool uses_name(const YamlNode& node, const std::string& name) {
  const auto is_word = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
  };
  for (std::size_t at = node.text.find(name); at != std::string::npos;
       at = node.text.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    const bool begins = at == 0 || !is_word(node.text[at - 1]);
    if (begins && (end == node.text.size() || !is_word(node.text[end]))) return true;
  }
  const auto uses = [&](const YamlNode& inner) { return uses_name(inner, name); };
  return std::any_of(node.items.begin(), node.items.end(), uses) ||
         std::any_of(node.entries.begin(), node.entries.end(),
                     [&](const YamlEntry& entry) { return uses(entry.value); });
}

/// A new parameter that nothing uses changes nothing: most likely another one was meant.
void require_use(const YamlNode& root, const std::string& name) {
  if (name.empty() || uses_name(root, name)) return;
  std::vector<std::string> known;
  for (const YamlEntry& entry : root.find("parameters")->entries) {
    if (entry.key != name) known.push_back(entry.key);
  }
  throw InputError(
      {"--set parameters." + name, 0, 0},
      fmt::format("the model file has no \"{}\" in parameters, and no value uses it.{}", name,
                  base::suggestion(name, known)));
}

/// @return name of a parameter that it added, or empty
std::string apply_override(YamlNode& root, const std::string& assignment) {
  const std::size_t sign = assignment.find('=');
  if (sign == std::string::npos || sign == 0) {
    throw InputError(
        fmt::format("--set {}: write PATH=VALUE, for example "
                    "simulation.step=\"0.1 ms\"",
                    assignment));
  }
  const std::string path = assignment.substr(0, sign);
  const std::string where = "--set " + path;
  YamlNode value = parse_yaml(assignment.substr(sign + 1), where, true);
  if (value.kind == YamlNode::Kind::null) {
    throw InputError({where, 0, 0}, "the value after = is missing");
  }
  OverrideWalk walk(root, where);
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    walk.enter(path.substr(begin, end - begin), end == path.size());
    begin = end + 1;
  }
  walk.node() = std::move(value);
  return walk.added_parameter();
}

}  // namespace

void apply_overrides(YamlNode& root, const std::vector<std::string>& assignments) {
  std::vector<std::string> added;
  for (const std::string& assignment : assignments) {
    added.push_back(apply_override(root, assignment));
  }
  for (const std::string& name : added) require_use(root, name);
}

}  // namespace buckens::model_file
