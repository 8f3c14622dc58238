// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/mesh_io/gmsh/elements.h"
#include "buckens/mesh_io/gmsh/mesh.h"
#include "buckens/mesh_io/tagged_mesh.h"

namespace buckens::mesh_io {

namespace {

/// Numbers as text, one line per record, or as bytes.
class NumberWriter {
 public:
  explicit NumberWriter(bool is_binary) : is_binary_(is_binary) {}

  bool is_binary() const { return is_binary_; }
  void text(const std::string& line) { out_ += line + '\n'; }
  void int32(std::int64_t value) { add(static_cast<std::int32_t>(value)); }
  void size(std::int64_t value) { add(static_cast<std::uint64_t>(value)); }
  void real(double value) {
    if (is_binary_) return add(value);
    begin_number();
    fmt::format_to(std::back_inserter(out_), "{}", value);  // the shortest that reads back the same
  }
  void end_record() {
    if (!is_binary_) out_ += '\n';
  }
  void end_section(const char* name) {
    out_ += fmt::format("{}$End{}\n", is_binary_ ? "\n" : "", name);
  }
  std::string finished() && { return std::move(out_); }

 private:
  void begin_number() {
    if (out_.back() != '\n') out_ += ' ';
  }
  template <class T>
  void add(T value) {
    if (!is_binary_) {
      begin_number();
      fmt::format_to(std::back_inserter(out_), "{}", value);
      return;
    }
    std::array<char, sizeof value> bytes;
    std::memcpy(bytes.data(), &value, sizeof value);
    out_.append(bytes.data(), bytes.size());
  }

  bool is_binary_;
  std::string out_;
};

class GmshWriter {
 public:
  GmshWriter(const TaggedMesh& mesh, GmshFormat format)
      : mesh_(mesh),
        out_(format == GmshFormat::binary_2_2 || format == GmshFormat::binary_4_1),
        is_4_(format == GmshFormat::ascii_4_1 || format == GmshFormat::binary_4_1) {}

  std::string written() && {
    head();
    if (is_4_) {
      entities_4();
      nodes_4();
      elements_4();
    } else {
      nodes_2();
      elements_2();
    }
    return std::move(out_).finished();
  }

 private:
  void head();
  void entities_4();
  void nodes_4();
  void elements_4();
  void nodes_2();
  void elements_2();
  void nodes_of(const TaggedCells& cells, std::size_t element);
  std::int64_t tag(int group) const { return mesh_.groups[static_cast<std::size_t>(group)].tag; }

  const TaggedMesh& mesh_;
  NumberWriter out_;
  bool is_4_;
};

void GmshWriter::head() {
  out_.text("$MeshFormat");
  out_.text(fmt::format("{} {} 8", is_4_ ? "4.1" : "2.2", out_.is_binary() ? 1 : 0));
  if (out_.is_binary()) out_.int32(1);
  out_.end_section("MeshFormat");
  if (mesh_.groups.empty()) return;
  out_.text("$PhysicalNames");
  out_.text(fmt::format("{}", mesh_.groups.size()));
  for (const CellGroup& group : mesh_.groups) {
    out_.text(fmt::format("{} {} \"{}\"", group.dimension, group.tag, group.name));
  }
  out_.text("$EndPhysicalNames");
}

void GmshWriter::nodes_of(const TaggedCells& cells, std::size_t element) {
  const GmshElement& written = gmsh_element(cells.kind);
  std::array<int, 20> nodes{};
  const auto count = static_cast<std::size_t>(written.num_nodes);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t place =
        written.places.empty() ? k : static_cast<std::size_t>(written.places[k]);
    nodes[place] = cells.nodes[element * count + k];
  }
  for (std::size_t k = 0; k < count; ++k) {
    const std::int64_t id = mesh_.node_ids[static_cast<std::size_t>(nodes[k])];
    if (is_4_) {
      out_.size(id);
    } else {
      out_.int32(id);
    }
  }
}

/// One entity for the elements of each shape and combination of groups, numbered from 1.
void GmshWriter::entities_4() {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& position : mesh_.positions) box.extend(position);
  out_.text("$Entities");
  for (int dimension = 0; dimension < 4; ++dimension) {
    std::int64_t count = 0;
    for (const TaggedCells& cells : mesh_.cells) {
      count += fem::dimension_of(cells.kind) == dimension ? 1 : 0;
    }
    out_.size(count);
  }
  out_.end_record();
  for (int dimension = 0; dimension < 4; ++dimension) {
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      const TaggedCells& cells = mesh_.cells[c];
      if (fem::dimension_of(cells.kind) != dimension) continue;
      out_.int32(static_cast<std::int64_t>(c) + 1);
      for (const double x : box.min()) out_.real(x);
      for (int k = 0; dimension > 0 && k < 3; ++k) out_.real(box.max()[k]);
      out_.size(static_cast<std::int64_t>(cells.groups.size()));
      for (const int group : cells.groups) out_.int32(tag(group));
      if (dimension > 0) out_.size(0);
      out_.end_record();
    }
  }
  out_.end_section("Entities");
}

void GmshWriter::nodes_4() {
  const auto count = static_cast<std::int64_t>(mesh_.node_ids.size());
  const auto [least, most] = std::minmax_element(mesh_.node_ids.begin(), mesh_.node_ids.end());
  out_.text("$Nodes");
  for (const std::int64_t value : {std::int64_t{1}, count, *least, *most}) out_.size(value);
  out_.end_record();
  const int dimension = fem::dimension_of(mesh_.cells.front().kind);
  for (const std::int64_t value : {std::int64_t{dimension}, std::int64_t{1}, std::int64_t{0}}) {
    out_.int32(value);
  }
  out_.size(count);
  out_.end_record();
  for (const std::int64_t id : mesh_.node_ids) {
    out_.size(id);
    out_.end_record();
  }
  for (const Eigen::Vector3d& position : mesh_.positions) {
    for (const double x : position) out_.real(x);
    out_.end_record();
  }
  out_.end_section("Nodes");
}

void GmshWriter::elements_4() {
  std::int64_t count = 0, least = std::numeric_limits<std::int64_t>::max(), most = 0;
  for (const TaggedCells& cells : mesh_.cells) {
    count += static_cast<std::int64_t>(cells.ids.size());
    for (const std::int64_t id : cells.ids) {
      least = std::min(least, id);
      most = std::max(most, id);
    }
  }
  out_.text("$Elements");
  const auto blocks = static_cast<std::int64_t>(mesh_.cells.size());
  for (const std::int64_t value : {blocks, count, least, most}) out_.size(value);
  out_.end_record();
  for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
    const TaggedCells& cells = mesh_.cells[c];
    out_.int32(fem::dimension_of(cells.kind));
    out_.int32(static_cast<std::int64_t>(c) + 1);
    out_.int32(gmsh_element(cells.kind).type);
    out_.size(static_cast<std::int64_t>(cells.ids.size()));
    out_.end_record();
    for (std::size_t e = 0; e < cells.ids.size(); ++e) {
      out_.size(cells.ids[e]);
      nodes_of(cells, e);
      out_.end_record();
    }
  }
  out_.end_section("Elements");
}

void GmshWriter::nodes_2() {
  out_.text("$Nodes");
  out_.text(fmt::format("{}", mesh_.node_ids.size()));
  for (std::size_t node = 0; node < mesh_.node_ids.size(); ++node) {
    out_.int32(mesh_.node_ids[node]);
    for (const double x : mesh_.positions[node]) out_.real(x);
    out_.end_record();
  }
  out_.end_section("Nodes");
}

/// An element in several groups is written once for each of them, as Gmsh does.
void GmshWriter::elements_2() {
  std::int64_t count = 0, last = 0;
  for (const TaggedCells& cells : mesh_.cells) {
    count +=
        static_cast<std::int64_t>(cells.ids.size() * std::max<std::size_t>(cells.groups.size(), 1));
    for (const std::int64_t id : cells.ids) last = std::max(last, id);
  }
  out_.text("$Elements");
  out_.text(fmt::format("{}", count));
  for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
    const TaggedCells& cells = mesh_.cells[c];
    const int type = gmsh_element(cells.kind).type;
    for (std::size_t g = 0; g < std::max<std::size_t>(cells.groups.size(), 1); ++g) {
      if (out_.is_binary()) {
        out_.int32(type);
        out_.int32(static_cast<std::int64_t>(cells.ids.size()));
        out_.int32(2);
      }
      for (std::size_t e = 0; e < cells.ids.size(); ++e) {
        out_.int32(g == 0 ? cells.ids[e] : ++last);
        if (!out_.is_binary()) {
          out_.int32(type);
          out_.int32(2);
        }
        out_.int32(cells.groups.empty() ? 0 : tag(cells.groups[g]));
        out_.int32(static_cast<std::int64_t>(c) + 1);
        nodes_of(cells, e);
        out_.end_record();
      }
    }
  }
  out_.end_section("Elements");
}

void check_numbers(const TaggedMesh& mesh) {
  constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
  const auto check = [&](const std::vector<std::int64_t>& ids) {
    for (const std::int64_t id : ids) {
      if (id <= kMost) continue;
      throw InputError({mesh.file, 0, 0}, fmt::format("the number {} is too large for version 2.2 "
                                                      "of Gmsh's format; choose 4.1",
                                                      id));
    }
  };
  check(mesh.node_ids);
  for (const TaggedCells& cells : mesh.cells) check(cells.ids);
}

}  // namespace

std::vector<fem::ImportNote> losses_in_gmsh(const fem::ImportedMesh& mesh) {
  return groups_of_mesh(mesh).notes;
}

std::string gmsh_bytes(const fem::ImportedMesh& mesh, GmshFormat format) {
  const TaggedMesh tagged = groups_of_mesh(mesh);
  if (tagged.cells.empty()) {
    throw InputError({mesh.file, 0, 0}, "the mesh has no elements that could be written");
  }
  if (format == GmshFormat::ascii_2_2 || format == GmshFormat::binary_2_2) check_numbers(tagged);
  return GmshWriter(tagged, format).written();
}

}  // namespace buckens::mesh_io
