// SPDX-License-Identifier: Apache-2.0
#include "buckens/model_file/yaml_tree.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <unordered_map>

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include "buckens/base/errors.h"
#include "buckens/base/utf8.h"
#include "buckens/model_file/open_bracket.h"

namespace buckens::model_file {

namespace {

// A chain of 100 000 links has 26 MB; tables of numbers belong into CSV files.
constexpr std::size_t kLargestText = 64u << 20;
// A value takes some 250 bytes of memory. Models, with names, numbers and the space between them,
// have one for five bytes of their text or more; a text of nothing but commas has no such claim.
constexpr std::size_t kMostNodes = 500000;
constexpr std::size_t kBytesPerNode = 4;
constexpr std::size_t kDeepestTree = 60;

void check_encoding(const std::string& text, const std::string& name) {
  if (text.size() > kLargestText) {
    throw InputError(
        {name, 0, 0},
        fmt::format(
            "the text has {} bytes; a model file must not exceed {}. Move tables to CSV files",
            text.size(), kLargestText));
  }
  SourceLocation where{name, 1, 1};
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = base::utf8_length(text, i);
    if (length == 0) {
      throw InputError(where, fmt::format("byte 0x{:02X} is not UTF-8 text; is this a model file? "
                                          "Save it with UTF-8 encoding",
                                          static_cast<unsigned char>(text[i])));
    }
    where.column += 1;
    if (text[i] == '\n') {
      where.line += 1;
      where.column = 1;
    }
    i += length;
  }
}

/// Builds the tree from the parser's events.
class TreeBuilder final : public YAML::EventHandler {
 public:
  /// @param most_nodes keys and values that the text may have
  TreeBuilder(const std::string& name, bool single_line, std::size_t most_nodes)
      : name_(name), single_line_(single_line), most_nodes_(most_nodes) {}

  YamlNode take() { return std::move(root_); }

  SourceLocation place(const YAML::Mark& mark) const {
    if (single_line_ || mark.is_null()) return {name_, 0, 0};
    return {name_, mark.line + 1, mark.column + 1};
  }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    YamlNode node = make(YamlNode::Kind::null, mark, "", anchor);
    close(std::move(node));
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { refuse_anchor(mark); }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    YamlNode node = make(YamlNode::Kind::scalar, mark, tag, anchor);
    node.text = value;
    node.is_quoted = tag == "!";
    if (wants_key()) return take_key(node);
    close(std::move(node));
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(make(YamlNode::Kind::list, mark, tag, anchor));
  }
  void OnSequenceEnd() override { close_top(); }

  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(make(YamlNode::Kind::map, mark, tag, anchor));
  }
  void OnMapEnd() override { close_top(); }

 private:
  struct Level {
    YamlNode node;
    bool has_key = false;  // the last entry waits for its value
    std::unordered_map<std::string, SourceLocation> keys;
  };

  [[noreturn]] void refuse_anchor(const YAML::Mark& mark) const {
    throw InputError(place(mark),
                     "anchors and aliases (&name, *name) are not supported; use `parameters`, "
                     "`materials`, `sections` or `like`");
  }

  YamlNode make(YamlNode::Kind kind, const YAML::Mark& mark, const std::string& tag,
                YAML::anchor_t anchor) {
    if (anchor != YAML::NullAnchor) refuse_anchor(mark);
    if (!tag.empty() && tag != "?" && tag != "!") {
      throw InputError(place(mark), fmt::format("the YAML tag {} is not supported", tag));
    }
    if (++count_ > most_nodes_) {
      throw InputError(place(mark),
                       fmt::format("more than {} values; move tables to CSV files", most_nodes_));
    }
    YamlNode node;
    node.kind = kind;
    node.where = place(mark);
    return node;
  }

  bool wants_key() const {
    return !stack_.empty() && stack_.back().node.is_map() && !stack_.back().has_key;
  }

  void take_key(const YamlNode& key) {
    Level& level = stack_.back();
    if (key.text == "<<" && !key.is_quoted) {
      throw InputError(key.where,
                       "merge keys (<<) are not supported; use `like`, `materials` or "
                       "`sections`");
    }
    const auto [first, is_new] = level.keys.emplace(key.text, key.where);
    if (!is_new) {
      throw InputError(
          key.where,
          fmt::format("the key \"{}\" appears twice, first at {}; remove or rename one of them",
                      key.text, first->second.text()));
    }
    level.node.entries.push_back({key.text, key.where, {}});
    level.has_key = true;
  }

  void open(YamlNode node) {
    if (wants_key())
      throw InputError(node.where,
                       "a key must be a word, not a list or map (is a bracket not closed?)");
    if (stack_.size() >= kDeepestTree) {
      throw InputError(node.where, fmt::format("nested more than {} levels deep", kDeepestTree));
    }
    stack_.push_back({std::move(node), false, {}});
  }

  void close_top() {
    YamlNode node = std::move(stack_.back().node);
    stack_.pop_back();
    close(std::move(node));
  }

  void close(YamlNode node) {
    if (stack_.empty()) {
      root_ = std::move(node);
      return;
    }
    Level& level = stack_.back();
    if (level.node.is_list()) {
      level.node.items.push_back(std::move(node));
      return;
    }
    if (!level.has_key) throw InputError(node.where, "a key is missing before the colon");
    YamlEntry& entry = level.node.entries.back();
    // The parser puts a missing value where the next key is.
    const bool is_missing = node.kind == YamlNode::Kind::null;
    if (is_missing && node.where.line != entry.where.line) node.where = entry.where;
    entry.value = std::move(node);
    level.has_key = false;
  }

  std::string name_;
  bool single_line_;
  std::size_t most_nodes_;
  YamlNode root_;
  std::vector<Level> stack_;
  std::size_t count_ = 0;
};

/// What is often wrong in a line that cannot be read.
std::string hint(const std::string& text, const YAML::Mark& mark) {
  if (mark.is_null()) return {};
  std::istringstream lines(text);
  std::string line;
  for (int k = 0; k <= mark.line && std::getline(lines, line); ++k) {
  }
  const std::size_t first = line.find_first_not_of(' ');
  const bool has_tab = first != std::string::npos && line[first] == '\t';
  return has_tab ? "; the line begins with a tab; indent with spaces" : "";
}

}  // namespace

const YamlNode* YamlNode::find(std::string_view key) const {
  for (const YamlEntry& entry : entries) {
    if (entry.key == key) return &entry.value;
  }
  return nullptr;
}

YamlNode* YamlNode::find(std::string_view key) {
  return const_cast<YamlNode*>(static_cast<const YamlNode*>(this)->find(key));
}

const YamlNode& YamlNode::deepest(const std::string& path) const {
  const YamlNode* node = this;
  std::istringstream stream(path);
  for (std::string key; std::getline(stream, key, '.');) {
    const YamlNode* next = node->find(key);
    if (node->is_list() && key.find_first_not_of("0123456789") == std::string::npos) {
      const std::size_t index = std::strtoul(key.c_str(), nullptr, 10);
      next = index < node->items.size() ? &node->items[index] : nullptr;
    }
    if (next == nullptr) break;
    node = next;
  }
  return *node;
}

std::string YamlNode::description() const {
  switch (kind) {
    case Kind::null:
      return "no value";
    case Kind::list:
      return "a list";
    case Kind::map:
      return "a map";
    case Kind::scalar:
      break;
  }
  return "\"" + shortened(text) + "\"";
}

std::string shortened(const std::string& text) {
  constexpr std::size_t kLongest = 60;
  if (text.size() <= kLongest) return text;
  std::size_t end = kLongest;
  while ((static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // not within a character
  return text.substr(0, end) + "...";
}

YamlNode parse_yaml(const std::string& text, const std::string& name, bool single_line) {
  check_encoding(text, name);
  const std::size_t most_nodes = std::max(kMostNodes, text.size() / kBytesPerNode);
  TreeBuilder builder(name, single_line, most_nodes);
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    parser.HandleNextDocument(builder);
    YamlNode root = builder.take();
    TreeBuilder rest(name, single_line, most_nodes);
    if (parser.HandleNextDocument(rest)) {
      throw InputError(rest.take().where, "a second document begins here; remove the line ---");
    }
    return root;
  } catch (const YAML::Exception& error) {
    // The parser tells of a missing bracket where it gives up, most often on the next line.
    if (!single_line && error.msg.find("flow") != std::string::npos) {
      if (const auto open = unclosed_bracket(text, error.mark.pos)) {
        throw InputError(
            {name, open->line, open->column},
            fmt::format("the bracket {} that opens here is not closed; add {} where its "
                        "content ends",
                        open->bracket, open->bracket == '[' ? ']' : '}'));
      }
    }
    throw InputError(builder.place(error.mark),
                     "YAML syntax: " + error.msg + hint(text, error.mark));
  }
}

}  // namespace buckens::model_file
