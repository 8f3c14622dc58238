// SPDX-License-Identifier: Apache-2.0
#include "buckens/model_file/effective_text.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::model_file {

namespace {

constexpr std::size_t kIndent = 2;

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < 0x20) {
      out += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string key_text(const std::string& key) {
  const bool is_plain = !key.empty() && key != "~" && key != "null" &&
                        std::all_of(key.begin(), key.end(), [](unsigned char c) {
                          return std::isalnum(c) != 0 || c == '_' || c == '-' || c >= 0x80;
                        });
  return is_plain && key[0] != '-' ? key : quoted(key);
}

/// A value on one line; empty if a plain text in it would end early between brackets.
std::string flow_text(const YamlNode& node) {
  std::string out;
  switch (node.kind) {
    case YamlNode::Kind::null:
      return "~";
    case YamlNode::Kind::scalar:
      if (node.is_quoted) return quoted(node.text);
      return node.text.find_first_of(",[]{}:#\n") == std::string::npos ? node.text : "";
    case YamlNode::Kind::list:
      for (const YamlNode& item : node.items) {
        const std::string text = flow_text(item);
        if (text.empty()) return "";
        out += (out.empty() ? "" : ", ") + text;
      }
      return '[' + out + ']';
    case YamlNode::Kind::map:
      break;
  }
  for (const YamlEntry& entry : node.entries) {
    const std::string text = flow_text(entry.value);
    if (text.empty()) return "";
    out += fmt::format("{}{}: {}", out.empty() ? "" : ", ", key_text(entry.key), text);
  }
  return '{' + out + '}';
}

std::string entry_text(const YamlEntry& entry, std::size_t indent);

/// What follows "key:" or "-", from the blank or line break on.
std::string value_text(const YamlNode& node, std::size_t indent) {
  const bool is_line = node.text.find('\n') == std::string::npos;
  if (node.is_scalar() && !node.is_quoted && is_line) return ' ' + node.text + '\n';
  if (node.is_scalar() && !is_line) return ' ' + quoted(node.text) + '\n';
  const std::string flow = flow_text(node);
  if (!flow.empty()) return ' ' + flow + '\n';
  std::string out = "\n";
  for (const YamlEntry& entry : node.entries) out += entry_text(entry, indent + kIndent);
  for (const YamlNode& item : node.items) {
    out += std::string(indent + kIndent, ' ') + '-' + value_text(item, indent + kIndent);
  }
  return out;
}

std::string entry_text(const YamlEntry& entry, std::size_t indent) {
  return std::string(indent, ' ') + key_text(entry.key) + ':' + value_text(entry.value, indent);
}

/// Writes a text anew, line by line.
class TextChange {
 public:
  explicit TextChange(const std::string& text) {
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
      lines_.emplace_back(text.substr(begin, end - begin));
      begin = end;
    }
    if (!lines_.empty() && lines_.back().back() != '\n') lines_.back() += '\n';
  }

  std::string run(const YamlNode& before, const YamlNode& after) {
    change_map(before, after, 0, lines_.size());
    return std::move(out_);
  }

  /// Whether each entry of a map begins a line of its own, as far as the places tell.
  bool is_block(const YamlNode& map, std::size_t begin, std::size_t end) const {
    if (!map.is_map() || map.entries.empty()) return false;
    std::size_t next = begin;
    const std::size_t column = indent_of(line_of(map.entries.front()));
    for (const YamlEntry& entry : map.entries) {
      const std::size_t line = line_of(entry);
      if (line < next || line >= end || indent_of(line) != column) return false;
      next = line + 1;
    }
    const char first = lines_[line_of(map.entries.front())][column];
    return first != '{' && first != '[' && first != '-';
  }

 private:
  static std::size_t line_of(const YamlEntry& entry) {
    return static_cast<std::size_t>(std::max(entry.where.line, 1)) - 1;
  }

  /// Blanks before the first other character of a line.
  std::size_t indent_of(std::size_t line) const {
    if (line >= lines_.size()) return 0;
    return std::min(lines_[line].find_first_not_of(' '), lines_[line].size() - 1);
  }

  bool is_comment(std::size_t line) const {
    const std::size_t first = lines_[line].find_first_not_of(" \t\r\n");
    return first == std::string::npos || lines_[line][first] == '#';
  }

  void copy(std::size_t begin, std::size_t end) {
    for (std::size_t line = begin; line < end; ++line) out_ += lines_[line];
  }

  void change_map(const YamlNode& before, const YamlNode& after, std::size_t begin,
                  std::size_t end) {
    const std::size_t indent = indent_of(line_of(before.entries.front()));
    copy(begin, line_of(before.entries.front()));
    for (std::size_t k = 0; k < before.entries.size(); ++k) {
      const bool is_last = k + 1 == before.entries.size();
      const std::size_t next = is_last ? end : line_of(before.entries[k + 1]);
      const auto now =
          std::find_if(after.entries.begin(), after.entries.end(),
                       [&](const YamlEntry& entry) { return entry.key == before.entries[k].key; });
      if (now != after.entries.end()) change_entry(before.entries[k], *now, indent, next);
    }
    for (const YamlEntry& entry : after.entries) {
      if (before.find(entry.key) == nullptr) out_ += entry_text(entry, indent);
    }
  }

  void change_entry(const YamlEntry& before, const YamlEntry& after, std::size_t indent,
                    std::size_t end) {
    const std::size_t begin = line_of(before);
    if (same_content(before.value, after.value)) return copy(begin, end);
    if (after.value.is_map() && is_block(before.value, begin + 1, end)) {
      return change_map(before.value, after.value, begin, end);
    }
    out_ += entry_text(after, indent);
    std::size_t rest = end;
    while (rest > begin + 1 && is_comment(rest - 1)) --rest;
    copy(rest, end);
  }

  std::vector<std::string> lines_;
  std::string out_;
};

bool is_read_as(const std::string& text, const YamlNode& wanted) {
  try {
    return same_content(parse_yaml(text, "effective model"), wanted);
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

bool same_content(const YamlNode& a, const YamlNode& b) {
  return a.kind == b.kind && a.text == b.text && a.is_quoted == b.is_quoted &&
         std::equal(a.items.begin(), a.items.end(), b.items.begin(), b.items.end(), same_content) &&
         std::equal(a.entries.begin(), a.entries.end(), b.entries.begin(), b.entries.end(),
                    [](const YamlEntry& one, const YamlEntry& other) {
                      return one.key == other.key && same_content(one.value, other.value);
                    });
}

std::string yaml_text(const YamlNode& root) {
  std::string out;
  for (const YamlEntry& entry : root.entries) out += entry_text(entry, 0);
  return out;
}

std::string effective_text(const std::string& text, const YamlNode& before, const YamlNode& after) {
  if (same_content(before, after)) return text;
  TextChange change(text);
  if (change.is_block(before, 0, static_cast<std::size_t>(-1))) {
    std::string out = change.run(before, after);
    if (is_read_as(out, after)) return out;
  }
  // Texts like JSON, which have no entries line by line.
  return yaml_text(after);
}

}  // namespace buckens::model_file
