// SPDX-License-Identifier: Apache-2.0
#include "buckens/model_file/overrides.h"

#include <algorithm>
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

  void enter(const std::string& key) {
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
      shape_ = &shape_->shorthand()->shape;
      enter(key);
      return;
    }
    switch (shape_->kind) {
      case Shape::Kind::record:
        enter_record(key);
        break;
      case Shape::Kind::named:
        enter_named(key);
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
    if (found == nullptr) {
      const SourceLocation place{where_, 0, 0};
      YamlNode empty;
      empty.where = place;
      node_->entries.push_back({key, place, empty});
      found = &node_->entries.back().value;
    }
    node_ = found;
    shape_ = &field->shape;
    example_ = field->note.example;
  }

  void enter_named(const std::string& key) {
    YamlNode* found = child(key);
    if (found == nullptr) {
      std::vector<std::string> known;
      for (const YamlEntry& entry : node_->entries) known.push_back(entry.key);
      fail(fmt::format("the model file has no \"{}\" in {}.{}", key, path_,
                       base::suggestion(key, known)));
    }
    node_ = found;
    shape_ = shape_->element.data();
  }

  void enter_list(const std::string& key) {
    if (!node_->is_list()) {
      const bool is_missing = node_->kind == YamlNode::Kind::null;
      fail(fmt::format("the model file has {} at \"{}\", no list; set it as a whole{}",
                       is_missing ? "nothing" : node_->description(), path_,
                       example_.empty() ? "" : fmt::format(": {}={}", path_, example_)));
    }
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), index);
    const bool is_number = error == std::errc() && end == key.data() + key.size() && !key.empty();
    if (!is_number || index >= node_->items.size()) {
      fail(fmt::format("\"{}\" is no item of {}; it has {} items, counted from 0", key, path_,
                       node_->items.size()));
    }
    node_ = &node_->items[index];
    shape_ = shape_->element.data();
  }

  YamlNode* node_;
  const Shape* shape_;
  std::string where_;
  std::string path_;
  std::string example_;       // of the field entered last
  bool names_entry_ = false;  // the value may be the name of an entry elsewhere
};

}  // namespace

void apply_override(YamlNode& root, const std::string& assignment) {
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
    walk.enter(path.substr(begin, end - begin));
    begin = end + 1;
  }
  walk.node() = std::move(value);
}

}  // namespace buckens::model_file
