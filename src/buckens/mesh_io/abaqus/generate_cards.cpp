// SPDX-License-Identifier: Apache-2.0
// Nodes and elements that a deck does not list but describes: *NGEN, *NFILL, *NCOPY, *ELGEN,
// *ELCOPY.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/files/deck_number.h"
#include "buckens/mesh_io/abaqus/cards.h"

namespace buckens::mesh_io {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr std::int64_t kMostMade = 50'000'000;
constexpr int kDeepestCopied = 100;
constexpr std::int64_t kLargestCopy = 999'999'999;

/// Refuses, with the remedy common to all keywords.
[[noreturn]] void refuse_generator(AbaqusReading& in, const DeckKeyword& keyword,
                                   const std::string& what) {
  in.lines.fail(keyword.place, fmt::format("{} {}{}", keyword.written, what,
                                           SkipList::remedy(keyword.written.substr(1))));
}

void check_label(AbaqusReading& in, std::int64_t label, DeckPlace place) {
  if (label >= 1 && label <= kLargestCopy) return;
  in.lines.fail(place, fmt::format("{} would be generated, which is not a number from 1 to {}",
                                   label, kLargestCopy));
}

/// Counts what all generating keywords make.
void count_generated(AbaqusReading& in, std::int64_t more, DeckPlace place) {
  in.num_generated += more;
  if (in.num_generated <= kMostMade) return;
  in.lines.fail(place, fmt::format("more than {} nodes and elements would be generated; is a digit "
                                   "too many here?",
                                   kMostMade));
}

/// Products of shifts and counts must stay integers.
bool is_sensible(std::int64_t value) { return std::abs(value) <= kLargestCopy; }

/// An integer of a row, or what an empty cell means.
std::int64_t integer_or(AbaqusReading& in, const DeckRow& row, std::size_t i, std::int64_t usual,
                        const char* what) {
  if (row.cell(i).empty()) return usual;
  const auto value = files::deck_integer(row.cell(i));
  if (value && is_sensible(*value)) return *value;
  in.lines.fail(row.place, fmt::format("{}: \"{}\" is not an integer of nine digits", what,
                                       std::string(row.cell(i).substr(0, 40))));
}

/// A whole number that a parameter gives.
std::int64_t shift_of(AbaqusReading& in, const DeckKeyword& keyword, const char* key) {
  const std::string& text = in.parameter(keyword, key);
  const auto value = files::deck_integer(text);
  if (value && is_sensible(*value)) return *value;
  in.lines.fail(keyword.place,
                fmt::format("{}={} is not an integer of nine digits", key, text.substr(0, 40)));
}

/// Nodes by their numbers, up to the last one read.
class KnownNodes {
 public:
  explicit KnownNodes(AbaqusReading& in) : in_(in), nodes_(in.scope->nodes) {
    std::int64_t largest = 0;
    for (const std::int64_t id : nodes_.ids) largest = std::max(largest, id);
    index_ = LabelIndex(nodes_.ids.size(), largest);
    for (std::size_t k = 0; k < nodes_.ids.size(); ++k) {
      index_.add(nodes_.ids[k], static_cast<int>(k));
    }
  }

  Vector3d at(std::int64_t id, DeckPlace place) const {
    const int found = index_.find(id);
    if (found >= 0) return nodes_.positions[static_cast<std::size_t>(found)];
    in_.lines.fail(place, fmt::format("node {} is not defined above this line", id));
  }
  bool has(std::int64_t id) const { return index_.find(id) >= 0; }

  void add(std::int64_t id, const Vector3d& position, DeckPlace place) {
    check_label(in_, id, place);
    index_.add(id, static_cast<int>(nodes_.ids.size()));
    nodes_.ids.push_back(id);
    nodes_.positions.push_back(position);
    nodes_.places.push_back(place);
  }

 private:
  AbaqusReading& in_;
  AbaqusNodes& nodes_;
  LabelIndex index_;
};

/// Members of a set as it is so far, in the order of the deck.
template <class Has>
void collect(AbaqusReading& in, const std::map<std::string, AbaqusSet>& sets,
             const std::string& name, DeckPlace place, int depth, const Has& has,
             std::vector<std::int64_t>& out) {
  const auto found = sets.find(upper(name));
  if (found == sets.end() || depth > kDeepestCopied) {
    in.lines.fail(place, fmt::format("there is no set \"{}\" above this line", name));
  }
  for (const AbaqusSetPart& part : found->second.parts) {
    out.insert(out.end(), part.ids.begin(), part.ids.end());
    for (const AbaqusSetPart::Range& range : part.ranges) {
      count_generated(in, (range.last - range.first) / range.step, place);
      for (std::int64_t id = range.first; id <= range.last; id += range.step) {
        if (has(id)) out.push_back(id);
      }
    }
    for (const std::string& other : part.names) {
      collect(in, sets, other, place, depth + 1, has, out);
      count_generated(in, static_cast<std::int64_t>(out.size()), place);
    }
  }
}

/// The part of a set to which generated members go; null without a name.
AbaqusSetPart* open_set(AbaqusReading& in, const DeckKeyword& keyword, const char* key,
                        std::map<std::string, AbaqusSet>& sets) {
  const std::string name = in.optional_parameter(keyword, key);
  if (name.empty()) return nullptr;
  AbaqusSetPart& part = set_called(sets, name).parts.emplace_back();
  part.place = keyword.place;
  return &part;
}

/// Points from one end to the other on a circle about a centre, the shorter way.
class Arc {
 public:
  Arc(AbaqusReading& in, const DeckRow& row, const Vector3d& from, const Vector3d& to,
      const Vector3d& centre)
      : centre_(centre), x_(from - centre) {
    const Vector3d other = to - centre;
    Vector3d normal = read_vector(in.lines, row, 7, "normal of the circle");
    if (normal.norm() == 0.0) normal = x_.cross(other);
    if (!(normal.norm() > 1e-9 * x_.norm() * other.norm())) {
      in.lines.fail(row.place,
                    "the ends and the centre of the circle lie on a line; give the "
                    "normal of its plane");
    }
    normal.normalize();
    y_ = normal.cross(x_);
    angle_ = std::atan2(other.dot(y_) / y_.norm(), other.dot(x_) / x_.norm());
    if (angle_ < 0) angle_ += 2.0 * std::numbers::pi;
  }

  Vector3d at(double share) const {
    return centre_ + std::cos(share * angle_) * x_ + std::sin(share * angle_) * y_;
  }

 private:
  Vector3d centre_, x_, y_;
  double angle_ = 0;
};

}  // namespace

void read_ngen(AbaqusReading& in, const DeckKeyword& keyword) {
  const std::string line = upper(in.optional_parameter(keyword, "LINE"));
  if ((!line.empty() && line != "C") || keyword.has("SYSTEM")) {
    refuse_generator(in, keyword,
                     "along parabolas or in a separate coordinate system is not supported");
  }
  KnownNodes known(in);
  AbaqusSetPart* set = open_set(in, keyword, "NSET", in.scope->node_sets);
  DeckRow row;
  while (in.lines.next_row(row)) {
    const std::int64_t first = in.lines.label(row.cell(0), row.place, "first node");
    const std::int64_t last = in.lines.label(row.cell(1), row.place, "last node");
    const std::int64_t step = integer_or(in, row, 2, 1, "increment of the numbers");
    const std::int64_t intervals = step == 0 ? 0 : (last - first) / step;
    if (intervals < 1 || first + intervals * step != last) {
      in.lines.fail(row.place, fmt::format("steps of {} do not lead from node {} to node {}", step,
                                           first, last));
    }
    count_generated(in, intervals, row.place);
    const Vector3d a = known.at(first, row.place), b = known.at(last, row.place);
    std::optional<Arc> arc;
    if (line == "C") {
      const Vector3d centre =
          row.cell(3).empty() || row.cell(3) == "0"
              ? Vector3d(in.system_axes * read_vector(in.lines, row, 4, "centre of the circle") +
                         in.system_origin)
              : known.at(in.lines.label(row.cell(3), row.place, "centre"), row.place);
      arc.emplace(in, row, a, b, centre);
    }
    if (set != nullptr) set->ids.push_back(first);
    for (std::int64_t k = 1; k < intervals; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(intervals);
      known.add(first + k * step, arc ? arc->at(share) : Vector3d(a + share * (b - a)), row.place);
      if (set != nullptr) set->ids.push_back(first + k * step);
    }
    if (set != nullptr) set->ids.push_back(last);
  }
}

void read_nfill(AbaqusReading& in, const DeckKeyword& keyword) {
  for (const char* key : {"SINGULAR", "TWOSTEP", "BIAS"}) {
    if (keyword.has(key))
      refuse_generator(in, keyword, fmt::format("with {} is not supported", key));
  }
  KnownNodes known(in);
  const auto has = [&known](std::int64_t id) { return known.has(id); };
  AbaqusSetPart* set = open_set(in, keyword, "NSET", in.scope->node_sets);
  DeckRow row;
  while (in.lines.next_row(row)) {
    std::vector<std::int64_t> from, to;
    const auto& sets = in.scope->node_sets;
    collect(in, sets, std::string(row.cell(0)), row.place, 0, has, from);
    collect(in, sets, std::string(row.cell(1)), row.place, 0, has, to);
    const std::int64_t intervals = integer_or(in, row, 2, 1, "number of intervals");
    const std::int64_t step = integer_or(in, row, 3, 1, "increment of the numbers");
    if (from.size() != to.size() || intervals < 1) {
      in.lines.fail(row.place,
                    fmt::format("the sets have {} and {} nodes and {} intervals; they must have "
                                "equally many nodes, and at least one interval",
                                from.size(), to.size(), intervals));
    }
    count_generated(in, intervals, row.place);
    count_generated(in, intervals * static_cast<std::int64_t>(from.size()), row.place);
    for (std::size_t i = 0; i < from.size(); ++i) {
      const Vector3d a = known.at(from[i], row.place), b = known.at(to[i], row.place);
      if (set != nullptr) set->ids.push_back(from[i]);
      for (std::int64_t k = 1; k < intervals; ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(intervals);
        known.add(from[i] + k * step, a + share * (b - a), row.place);
        if (set != nullptr) set->ids.push_back(from[i] + k * step);
      }
      if (set != nullptr) set->ids.push_back(to[i]);
    }
  }
}

namespace {

/// How one copy follows from the one before: x → turn x + shift.
struct Motion {
  Matrix3d turn = Matrix3d::Identity();
  Vector3d shift = Vector3d::Zero();
};

Motion read_motion(AbaqusReading& in, const DeckKeyword& keyword) {
  const auto point = [&in](const DeckRow& row, std::size_t first) {
    return Vector3d(in.system_axes * read_vector(in.lines, row, first, "coordinate") +
                    in.system_origin);
  };
  Motion out;
  DeckRow row;
  const bool has_row = in.lines.next_row(row);
  const std::string reflection = upper(in.optional_parameter(keyword, "REFLECT"));
  if (!reflection.empty() && !has_row) refuse_generator(in, keyword, "lacks the points of REFLECT");
  if (reflection == "POINT") {
    out.turn = -Matrix3d::Identity();
    out.shift = 2.0 * point(row, 0);
  } else if (reflection == "LINE" || reflection == "MIRROR") {
    const Vector3d a = point(row, 0), b = point(row, 3);
    Vector3d axis = b - a;
    DeckRow second;
    if (reflection == "MIRROR") {
      if (!in.lines.next_row(second))
        refuse_generator(in, keyword, "lacks the third point of the mirror");
      axis = axis.cross(point(second, 0) - a);
    }
    if (axis.norm() == 0.0)
      in.lines.fail(row.place, "the points of REFLECT coincide or lie on one line");
    axis.normalize();
    const Matrix3d along = 2.0 * axis * axis.transpose();
    out.turn = reflection == "LINE" ? Matrix3d(along - Matrix3d::Identity())
                                    : Matrix3d(Matrix3d::Identity() - along);
    out.shift = a - out.turn * a;
  } else if (keyword.has("SHIFT")) {
    const Vector3d move =
        has_row ? Vector3d(in.system_axes * read_vector(in.lines, row, 0, "translation"))
                : Vector3d(0, 0, 0);
    DeckRow second;
    Vector3d centre = Vector3d::Zero();
    if (has_row && in.lines.next_row(second) && !second.cell(6).empty()) {
      const Vector3d axis = point(second, 3) - point(second, 0);
      if (axis.norm() == 0.0) in.lines.fail(second.place, "the points of the axis are the same");
      const double angle =
          in.lines.number(second, 6, "angle of the rotation") * std::numbers::pi / 180.0;
      out.turn = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
      centre = point(second, 0);
    }
    out.shift = out.turn * (move - centre) + centre;
  } else {
    refuse_generator(in, keyword, "is supported with SHIFT and with REFLECT=LINE, MIRROR or POINT");
  }
  return out;
}

}  // namespace

void read_ncopy(AbaqusReading& in, const DeckKeyword& keyword) {
  const std::int64_t shift = shift_of(in, keyword, "CHANGENUMBER");
  const std::string times = in.optional_parameter(keyword, "MULTIPLE");
  const std::int64_t copies = times.empty() ? 1 : shift_of(in, keyword, "MULTIPLE");
  const std::string old_set = in.parameter(keyword, "OLDSET");
  KnownNodes known(in);
  std::vector<std::int64_t> ids;
  collect(
      in, in.scope->node_sets, old_set, keyword.place, 0,
      [&known](std::int64_t id) { return known.has(id); }, ids);
  AbaqusSetPart* set = open_set(in, keyword, "NEWSET", in.scope->node_sets);
  const Motion motion = read_motion(in, keyword);
  if (copies < 1 || shift == 0) in.lines.fail(keyword.place, "there is nothing to copy");
  count_generated(in, copies, keyword.place);
  count_generated(in, copies * static_cast<std::int64_t>(ids.size()), keyword.place);
  for (const std::int64_t id : ids) {
    Vector3d x = known.at(id, keyword.place);
    for (std::int64_t k = 1; k <= copies; ++k) {
      x = motion.turn * x + motion.shift;
      known.add(id + k * shift, x, keyword.place);
      if (set != nullptr) set->ids.push_back(id + k * shift);
    }
  }
}

namespace {

/// An element that is there, to be copied with other numbers.
struct Pattern {
  AbaqusElements* block = nullptr;
  std::size_t at = 0;
};

std::map<std::int64_t, Pattern> all_elements(AbaqusScope& scope) {
  std::map<std::int64_t, Pattern> out;
  for (AbaqusElements& block : scope.elements) {
    for (std::size_t k = 0; k < block.ids.size(); ++k) out[block.ids[k]] = {&block, k};
  }
  return out;
}

void add_copy(AbaqusReading& in, const Pattern& pattern, std::int64_t id_shift,
              std::int64_t node_shift, DeckPlace place) {
  AbaqusElements& block = *pattern.block;
  const std::int64_t id = block.ids[pattern.at] + id_shift;
  check_label(in, id, place);
  block.ids.push_back(id);
  block.places.push_back(place);
  if (!block.direction_nodes.empty()) {
    const std::int64_t direction = block.direction_nodes[pattern.at];
    block.direction_nodes.push_back(direction);
  }
  const auto stride = static_cast<std::size_t>(std::max(0, block.type->num_nodes));
  for (std::size_t i = pattern.at * stride; i < (pattern.at + 1) * stride; ++i) {
    const std::int64_t node = block.nodes[i] + node_shift;
    block.nodes.push_back(node);
  }
}

}  // namespace

void read_elgen(AbaqusReading& in, const DeckKeyword& keyword) {
  AbaqusSetPart* set = open_set(in, keyword, "ELSET", in.scope->element_sets);
  const auto known = all_elements(*in.scope);
  DeckRow row;
  while (in.lines.next_row(row)) {
    const std::int64_t master = in.lines.label(row.cell(0), row.place, "element to copy");
    const auto found = known.find(master);
    if (found == known.end()) {
      in.lines.fail(row.place, fmt::format("element {} is not defined above this line", master));
    }
    // Rows, columns and layers: how many, and by how much the numbers of nodes and elements grow.
    std::array<std::array<std::int64_t, 3>, 3> grid;
    std::int64_t total = 1;
    for (std::size_t d = 0; d < 3; ++d) {
      for (std::size_t k = 0; k < 3; ++k) {
        grid[d][k] = integer_or(in, row, 1 + 3 * d + k, 1, "number of *ELGEN");
      }
      if (grid[d][0] < 1 || grid[d][0] > kMostMade) {
        in.lines.fail(row.place, fmt::format("{} elements in a row cannot be", grid[d][0]));
      }
      total *= grid[d][0];
      count_generated(in, total, row.place);
    }
    for (std::int64_t k = 0; k < grid[2][0]; ++k) {
      for (std::int64_t j = 0; j < grid[1][0]; ++j) {
        for (std::int64_t i = 0; i < grid[0][0]; ++i) {
          const std::int64_t nodes = i * grid[0][1] + j * grid[1][1] + k * grid[2][1];
          const std::int64_t ids = i * grid[0][2] + j * grid[1][2] + k * grid[2][2];
          if (i + j + k > 0) add_copy(in, found->second, ids, nodes, row.place);
          if (set != nullptr) set->ids.push_back(master + ids);
        }
      }
    }
  }
}

void read_elcopy(AbaqusReading& in, const DeckKeyword& keyword) {
  if (keyword.has("REFLECT")) refuse_generator(in, keyword, "with REFLECT is not supported");
  const std::int64_t elements = shift_of(in, keyword, "ELEMENTSHIFT");
  const std::int64_t nodes = shift_of(in, keyword, "SHIFTNODES");
  const std::string old_set = in.parameter(keyword, "OLDSET");
  const auto known = all_elements(*in.scope);
  std::vector<std::int64_t> ids;
  collect(
      in, in.scope->element_sets, old_set, keyword.place, 0,
      [&known](std::int64_t id) { return known.contains(id); }, ids);
  AbaqusSetPart* set = open_set(in, keyword, "NEWSET", in.scope->element_sets);
  count_generated(in, static_cast<std::int64_t>(ids.size()), keyword.place);
  for (const std::int64_t id : ids) {
    const auto found = known.find(id);
    if (found == known.end()) {
      in.lines.fail(keyword.place, fmt::format("element {} is not defined above this line", id));
    }
    add_copy(in, found->second, elements, nodes, keyword.place);
    if (set != nullptr) set->ids.push_back(id + elements);
  }
}

}  // namespace buckens::mesh_io
