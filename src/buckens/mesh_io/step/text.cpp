// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/step/text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace buckens::mesh_io {

namespace {

// Steps of the linear scale; a name is a number of three digits to this base.
constexpr int kLevels = 32;
constexpr int kStep = 256 / kLevels;
constexpr std::size_t kMostNames = std::size_t{kLevels} * kLevels * kLevels;

/// One entity "#12 = TYPE(...);" of the data section.
struct Entity {
  std::string number;      // "#12"
  std::string type;        // of simple entities
  std::size_t begin, end;  // of what stands between the outer brackets
};

/// sRGB from linear, both 0 … 1.
double shown(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

std::size_t skip_blanks(const std::string& text, std::size_t at) {
  while (at < text.size() && std::isspace(static_cast<unsigned char>(text[at])) != 0) ++at;
  return at;
}

/// Place of the first of these characters outside strings, or npos.
std::size_t find_outside(const std::string& text, std::size_t at, char wanted) {
  for (bool in_string = false; at < text.size(); ++at) {
    if (text[at] == '\'') in_string = !in_string;  // a doubled quote switches twice
    if (!in_string && text[at] == wanted) return at;
  }
  return std::string::npos;
}

/// Calls `visit` for each simple entity.
template <class Visit>
void for_each_entity(const std::string& text, Visit visit) {
  std::size_t at = text.find("DATA;");
  if (at == std::string::npos) return;
  for (at += 5; at < text.size();) {
    const std::size_t end = find_outside(text, at, ';');
    if (end == std::string::npos) return;
    const std::size_t begin = skip_blanks(text, at);
    at = end + 1;
    if (text[begin] != '#') continue;
    const std::string_view own = std::string_view(text).substr(0, end);
    const std::size_t equals = own.find('=', begin);
    const std::size_t open = own.find('(', begin);
    if (equals == std::string_view::npos || open == std::string_view::npos) continue;
    Entity entity;
    std::size_t number_end = equals;
    while (number_end > begin && text[number_end - 1] == ' ') --number_end;
    entity.number = text.substr(begin, number_end - begin);
    for (std::size_t i = skip_blanks(text, equals + 1); i < open; ++i) {
      if (std::isspace(static_cast<unsigned char>(text[i])) == 0) entity.type += text[i];
    }
    entity.begin = open + 1;
    entity.end = end;
    visit(entity);
  }
}

/// The string with which the parameters begin, without its quotes.
std::string first_string(const std::string& text, const Entity& entity) {
  std::size_t at = skip_blanks(text, entity.begin);
  if (at >= text.size() || text[at] != '\'') return {};
  std::string out;
  for (++at; at < entity.end; ++at) {
    if (text[at] == '\'') {
      if (text[at + 1] != '\'') return out;
      ++at;
    }
    if (text[at] != '\n' && text[at] != '\r') out += text[at];  // long strings are wrapped
  }
  return out;
}

/// Appends a character in UTF-8.
void append_utf8(std::string& out, unsigned code) {
  const auto add = [&out](unsigned byte) { out += static_cast<char>(byte); };
  if (code < 0x80) return add(code);
  if (code < 0x800) {
    add(0xC0 | code >> 6);
  } else if (code < 0x10000) {
    add(0xE0 | code >> 12);
    add(0x80 | (code >> 6 & 0x3F));
  } else {
    add(0xF0 | (code >> 18 & 0x07));
    add(0x80 | (code >> 12 & 0x3F));
    add(0x80 | (code >> 6 & 0x3F));
  }
  add(0x80 | (code & 0x3F));
}

/// The number of so many hexadecimal digits; empty where others stand.
std::optional<unsigned> hexadecimal(const std::string& text, std::size_t at, std::size_t digits) {
  unsigned out = 0;
  if (at + digits > text.size()) return std::nullopt;
  const auto result = std::from_chars(text.data() + at, text.data() + at + digits, out, 16);
  if (result.ec != std::errc() || result.ptr != text.data() + at + digits) return std::nullopt;
  return out;
}

/// Characters beyond ASCII as the standard writes them: \X\E4, \S\d, \X2\00E4\X0\, \X4\...\X0\.
std::string decoded(const std::string& text) {
  std::string out;
  std::size_t digits = 0;  // of each character inside \X2\ or \X4\.
  for (std::size_t at = 0; at < text.size();) {
    const std::string_view rest = std::string_view(text).substr(at);
    if (rest.starts_with("\\X2\\") || rest.starts_with("\\X4\\")) {
      digits = rest[2] == '2' ? 4 : 8;
      at += 4;
    } else if (rest.starts_with("\\X0\\")) {
      digits = 0;
      at += 4;
    } else if (const auto code = hexadecimal(text, at, digits); digits > 0 && code) {
      append_utf8(out, *code);
      at += digits;
    } else if (const auto byte = hexadecimal(text, at + 3, 2); rest.starts_with("\\X\\") && byte) {
      append_utf8(out, *byte);
      at += 5;
    } else if (rest.starts_with("\\S\\") && rest.size() > 3) {
      append_utf8(out, static_cast<unsigned char>(rest[3]) + 128U);
      at += 4;
    } else {
      out += text[at++];
    }
  }
  return out;
}

std::string last_reference(const std::string& text, const Entity& entity) {
  const std::size_t at = text.rfind('#', entity.end);
  if (at == std::string::npos || at < entity.begin) return {};
  std::size_t end = at + 1;
  while (std::isdigit(static_cast<unsigned char>(text[end])) != 0) ++end;
  return text.substr(at, end - at);
}

struct NamedFace {
  std::string number;
  std::size_t name;
};

std::string style_of(const NamedFace& face, std::size_t& next) {
  std::array<double, 3> rgb;
  std::size_t digits = face.name;
  for (double& part : rgb) {
    const double linear = (static_cast<double>(digits % kLevels) + 0.5) * kStep;
    part = shown(linear / 255.0);
    digits /= kLevels;
  }
  const std::size_t n = next;
  next += 8;
  return fmt::format(
      "#{}=COLOUR_RGB('',{:.9f},{:.9f},{:.9f});\n#{}=FILL_AREA_STYLE_COLOUR('',#{});\n"
      "#{}=FILL_AREA_STYLE('',(#{}));\n#{}=SURFACE_STYLE_FILL_AREA(#{});\n"
      "#{}=SURFACE_SIDE_STYLE('',(#{}));\n#{}=SURFACE_STYLE_USAGE(.BOTH.,#{});\n"
      "#{}=PRESENTATION_STYLE_ASSIGNMENT((#{}));\n#{}=STYLED_ITEM('',(#{}),{});\n",
      n, rgb[0], rgb[1], rgb[2], n + 1, n, n + 2, n + 1, n + 3, n + 2, n + 4, n + 3, n + 5, n + 4,
      n + 6, n + 5, n + 7, n + 6, face.number);
}

// Of equal length: moving the rest of a large file for each of them would take minutes.
constexpr std::string_view kStyled = "STYLED_ITEM", kIgnored = "IGNORED_ONE";
static_assert(kStyled.size() == kIgnored.size());

void ignore_styles(std::string& text) {
  for (std::size_t at = text.find(kStyled); at != std::string::npos; at = text.find(kStyled, at)) {
    text.replace(at, kStyled.size(), kIgnored);
  }
}

}  // namespace

double linear_color(double value) {
  const double x = value / 255.0;
  return 255.0 * (x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4));
}

int shown_color(int linear) { return static_cast<int>(std::lround(255.0 * shown(linear / 255.0))); }

int name_of_color(const std::array<int, 3>& linear, std::size_t num_names) {
  std::size_t out = 0;
  for (std::size_t k = 3; k-- > 0;) {
    out = out * kLevels + static_cast<std::size_t>(std::clamp(linear[k], 0, 255) / kStep);
  }
  return out < num_names ? static_cast<int>(out) : -1;
}

ColoredStep color_named_faces(const std::string& step) {
  ColoredStep out;
  std::vector<NamedFace> faces;
  std::unordered_map<std::string, std::size_t> places;
  std::string context;
  std::size_t largest = 0;
  for_each_entity(step, [&](const Entity& entity) {
    largest = std::max<std::size_t>(largest, std::strtoull(entity.number.c_str() + 1, nullptr, 10));
    if (entity.type.ends_with("SHAPE_REPRESENTATION") &&
        entity.type != "CONTEXT_DEPENDENT_SHAPE_REPRESENTATION") {
      context = last_reference(step, entity);
    }
    if (entity.type != "ADVANCED_FACE" && entity.type != "FACE_SURFACE") return;
    const std::string name = decoded(first_string(step, entity));
    if (name.empty() || name == "NONE" || name == " ") return;
    auto found = places.find(name);
    if (found == places.end()) {
      if (out.names.size() == kMostNames) return;
      found = places.emplace(name, out.names.size()).first;
      out.names.push_back(name);
    }
    faces.push_back({entity.number, found->second});
  });
  const std::size_t end = step.rfind("ENDSEC;");
  if (faces.empty() || context.empty() || end == std::string::npos) return {};
  out.text = step.substr(0, end);
  // The colours of the file itself would take precedence over those of names.
  ignore_styles(out.text);
  std::size_t next = largest + 1;
  std::string items;
  for (const NamedFace& face : faces) {
    out.text += style_of(face, next);
    items += fmt::format("{}#{}", items.empty() ? "" : ",", next - 1);
  }
  out.text +=
      fmt::format("#{}=MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',({}),{});\n",
                  next, items, context);
  out.text += step.substr(end);
  return out;
}

std::string missing_entities(const std::string& step) {
  std::vector<std::pair<std::uint64_t, std::size_t>> used;  // number and place
  std::vector<std::uint64_t> defined;
  bool in_string = false;
  for (std::size_t at = 0; at < step.size(); ++at) {
    if (step[at] == '\'') in_string = !in_string;  // a doubled quote switches twice
    if (!in_string && step.compare(at, 2, "/*") == 0) {
      at = step.find("*/", at + 2);
      if (at == std::string::npos) break;
    }
    if (in_string || step[at] != '#') continue;
    std::uint64_t number = 0;
    const auto [end, error] =
        std::from_chars(step.data() + at + 1, step.data() + step.size(), number);
    if (error != std::errc()) continue;
    const std::size_t next = skip_blanks(step, static_cast<std::size_t>(end - step.data()));
    if (next < step.size() && step[next] == '=') {
      defined.push_back(number);
    } else {
      used.emplace_back(number, at);
    }
  }
  std::sort(defined.begin(), defined.end());
  std::erase_if(used, [&](const auto& entry) {
    return std::binary_search(defined.begin(), defined.end(), entry.first);
  });
  if (used.empty()) return {};
  const auto [number, place] = used.front();
  const auto lines =
      std::count(step.begin(), step.begin() + static_cast<std::ptrdiff_t>(place), '\n');
  return fmt::format(
      "entities are missing from the file ({} references to them, the first to #{} in line {}): it "
      "is truncated or damaged; export it again",
      used.size(), number, lines + 1);
}

}  // namespace buckens::mesh_io
