// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/gmsh/mesh.h"

#include <algorithm>
#include <cctype>
#include <set>

#include <fmt/format.h>

#include "buckens/files/text_file.h"
#include "buckens/mesh_io/gmsh/reader.h"
#include "buckens/mesh_io/universal/file.h"

namespace buckens::mesh_io {

namespace {

constexpr std::size_t kLargestMesh = std::size_t{2} << 30;

struct MshVersion {
  int major = 1;
  bool is_4_0 = false;
  bool is_binary = false;

  const char* name() const {
    return major == 1 ? "1.0" : major == 2 ? "2.2" : is_4_0 ? "4.0" : "4.1";
  }
};

/// Comments may stand before the head. Version 1 has none.
MshVersion read_version(MeshText& text) {
  while (!text.at_end() && text.peek_line().empty()) text.next_line("$MeshFormat");
  if (text.at_end()) text.fail("the file is empty; a Gmsh mesh begins with $MeshFormat");
  if (text.peek_line() == "$NOD") return {};
  const std::string_view head = text.next_line("$MeshFormat");
  if (head == "$Comments" && text.skip_to("$EndComments")) return read_version(text);
  if (head != "$MeshFormat") {
    text.fail("this is not a Gmsh mesh: it does not begin with $MeshFormat");
  }
  MshVersion out;
  const std::string version(text.word("the version"));
  if (version == "4.1" || version == "4" || version == "4.0") {
    out.major = 4;
    out.is_4_0 = version != "4.1";
  } else if (version == "2" || version.starts_with("2.")) {
    out.major = 2;
  } else {
    text.fail(
        fmt::format("version {:.20} of the Gmsh format cannot be read; 1, 2, 4.0 and 4.1 can (in "
                    "Gmsh: File > Export, or `gmsh -format msh41`)",
                    version));
  }
  out.is_binary = text.integer("the mode of the file, 0 or 1", 0, 1) == 1;
  if (text.integer("the size of numbers") != 8) text.fail("numbers must have 8 bytes");
  text.next_line("$EndMeshFormat");
  if (out.is_binary && text.binary<std::int32_t>("the number one") != 1) {
    text.fail("the byte order is that of another machine; save the mesh as text");
  }
  return out;
}

bool is_universal_name(std::string_view file) {
  constexpr std::string_view kEnding = ".unv";
  if (file.size() < kEnding.size()) return false;
  const std::string_view ending = file.substr(file.size() - kEnding.size());
  return std::equal(ending.begin(), ending.end(), kEnding.begin(), [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == b;
  });
}

TaggedMesh read_msh(MeshText& text, const std::string& file, const std::string& surface) {
  TaggedMesh mesh;
  mesh.file = file;
  const MshVersion version = read_version(text);
  mesh.format = fmt::format("Gmsh {} {}", version.name(), version.is_binary ? "binary" : "text");
  mesh.repeats_elements = version.major != 4;
  GmshReader reader(text, mesh, version.is_binary);
  if (version.major != 1) reader.expect_end("$MeshFormat");
  GmshSections4 sections(reader, version.is_4_0, surface);
  std::set<std::string> seen;
  const std::string nodes = version.major == 1 ? "$NOD" : "$Nodes";
  const std::string elements = version.major == 1 ? "$ELM" : "$Elements";
  while (!text.at_end()) {
    const std::string section(text.next_line("a section"));
    if (section.empty()) continue;
    if (!section.starts_with('$') || section.size() > 60) {
      text.fail("expected the head of a section, such as $Nodes");
    }
    bool known = section == "$PhysicalNames";
    if (known) reader.read_physical_names();
    if (section == elements && seen.count(nodes) == 0) {
      text.fail(fmt::format("the section {} comes before {}", elements, nodes));
    }
    known = known || (version.major == 4   ? sections.read(section)
                      : version.major == 2 ? read_section_2(reader, section)
                                           : read_section_1(reader, section));
    if (known && !seen.insert(section).second) {
      text.fail(fmt::format("the section {} appears twice", section));
    }
    if (known) {
      reader.expect_end(section);
      if (!text.at_end()) text.next_line(section);
    } else if (!text.skip_to("$End" + section.substr(1), version.is_binary)) {
      text.fail(fmt::format("the section {} has no end; the file seems to be truncated", section));
    } else if (section != "$Comments" && section != "$Periodic") {
      mesh.notes.push_back({fmt::format("the section {} is ignored", section), text.line(), 1});
    }
  }
  for (const std::string& needed : {nodes, elements}) {
    if (seen.count(needed) == 0) text.fail(fmt::format("the file has no section {}", needed));
  }
  reader.name_groups();
  return mesh;
}

}  // namespace

fem::ImportedMesh read_gmsh_bytes(std::string_view bytes, const std::string& file,
                                  const std::vector<std::string>& members,
                                  const std::string& surface) {
  MeshText text(bytes, file);
  TaggedMesh mesh =
      is_universal_name(file) ? read_universal_file(text, file) : read_msh(text, file, surface);
  fem::ImportedMesh out = mesh_of_groups(std::move(mesh), members);
  if (out.num_elements() == 0) text.fail("the mesh has no elements");
  return out;
}

fem::ImportedMesh read_gmsh_mesh(const std::filesystem::path& path,
                                 const std::vector<std::string>& members,
                                 const std::string& surface) {
  return read_gmsh_bytes(files::read_text_file(path, "mesh", kLargestMesh), path.string(), members,
                         surface);
}

}  // namespace buckens::mesh_io
