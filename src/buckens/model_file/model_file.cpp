// SPDX-License-Identifier: Apache-2.0
#include "buckens/model_file/model_file.h"

#include <algorithm>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/timed_phase.h"
#include "buckens/files/text_file.h"
#include "buckens/files/text_lines.h"
#include "buckens/model/spec/description_member.h"
#include "buckens/model_file/doubts.h"
#include "buckens/model_file/effective_text.h"
#include "buckens/model_file/fields.h"
#include "buckens/model_file/overrides.h"
#include "buckens/model_file/step_mesh_cache.h"
#include "buckens/model_file/table_ranges.h"
#include "buckens/model_file/yaml_tree.h"

namespace buckens::model_file {

namespace {

constexpr char kChanges[] = " was read with these changes:\n";
constexpr char kFiles[] = "# Files read with it, and the hash of their contents:\n";

/// The overrides as a comment. What they say is in the text, too.
std::string comment_on(const std::string& name, const std::vector<std::string>& overrides) {
  if (overrides.empty()) return {};
  std::string out = "# " + name + kChanges;
  for (std::string line : overrides) {
    for (char& c : line) {
      if (c == '\n' || c == '\r') c = ' ';
    }
    out += "#   --set " + line + "\n";
  }
  return out;
}

/// Takes away a comment of an earlier run on its files.
std::string without_old_files(const std::string& text) {
  if (!text.starts_with(kFiles)) return text;
  std::size_t end = sizeof kFiles - 1;
  while (text.compare(end, 4, "#   ") == 0)
    end = std::min(text.find('\n', end), text.size() - 1) + 1;
  return text.substr(end);
}

/// The files that a model names and those that they include, as a comment: a run directory tells
/// which meshes and tables it belongs to, and a sweep that one has changed.
std::string comment_on(const files::FilesRead& files, const std::filesystem::path& directory) {
  if (files.hashes().empty()) return {};
  std::string out = kFiles;
  for (const auto& [path, hash] : files.hashes()) {
    const std::filesystem::path near = path.lexically_relative(directory);
    std::string name = (near.empty() ? path : near).string();
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return c < ' '; }, '?');
    out += fmt::format("#   {} {:016x}\n", name, hash);
  }
  return out;
}

/// Where the files of a model lie.
std::filesystem::path directory_of(const YamlNode& root, const std::filesystem::path& file) {
  const YamlNode* base = root.find("base");
  const std::filesystem::path beside = file.parent_path();
  return base != nullptr && base->is_scalar() ? beside / base->text : beside;
}

bool needs_files(const model::ModelDescription& model, const files::FilesRead& files) {
  return !model.base.empty() || !files.hashes().empty() ||
         std::any_of(model.bodies.begin(), model.bodies.end(),
                     [](const body::BodySpec& body) { return !body.reduction.file.empty(); });
}

/// Lets a text find its files from anywhere.
void fix_base(YamlNode& root, const std::filesystem::path& directory) {
  YamlNode base;
  base.kind = YamlNode::Kind::scalar;
  // The directory of a file in it, since that of the current one has no name.
  base.text = std::filesystem::absolute(directory / "x").lexically_normal().parent_path().string();
  base.is_quoted = true;
  if (YamlNode* old = root.find("base")) {
    *old = std::move(base);
  } else {
    root.entries.push_back({"base", root.where, std::move(base)});
  }
}

/// Names of all signals, since formulas may use those that come later.
/// @throws InputError where one cannot be used in formulas
std::vector<std::string> signal_names(const YamlNode& root) {
  std::vector<std::string> out;
  const YamlNode* signals = root.find("signals");
  if (signals == nullptr || !signals->is_map()) return out;
  const YamlNode* parameters = root.find("parameters");
  const auto& reserved = base::reserved_names();
  for (const YamlEntry& entry : signals->entries) {
    const std::string path = "signals." + entry.key;
    if (!base::is_identifier(entry.key)) {
      throw InputError(entry.where, fmt::format("{}: \"{}\" cannot be used in expressions; use "
                                                "letters, digits and _",
                                                path, entry.key));
    }
    const bool is_parameter = parameters != nullptr && parameters->find(entry.key) != nullptr;
    if (is_parameter || std::find(reserved.begin(), reserved.end(), entry.key) != reserved.end()) {
      throw InputError(entry.where,
                       fmt::format("{}: \"{}\" already has a meaning in expressions{}; "
                                   "choose another name",
                                   path, entry.key, is_parameter ? ", that of a parameter" : ""));
    }
    out.push_back(entry.key);
  }
  return out;
}

}  // namespace

model::ModelDescription read_model_text(const std::string& text, const std::string& name,
                                        const std::vector<std::string>& overrides,
                                        StepMeshCache& meshes) {
  base::take_phases();  // of another model, if nobody has asked for them
  const base::TimedPhase phase("model");
  YamlNode root = parse_yaml(text, name);
  if (root.kind == YamlNode::Kind::null) {
    throw InputError({name, 0, 0}, "the model file is empty; it begins with \"buckens: 1\"");
  }
  if (!root.is_map()) {
    throw InputError(root.where,
                     fmt::format("expected a map of keys such as buckens, bodies, joints, found {}",
                                 root.description()));
  }
  const YamlNode as_written = root;
  apply_overrides(root, overrides);

  files::FilesRead files;
  model::ModelDescription out;
  ReadContext context;
  context.directory = directory_of(root, name);
  context.model = &out;
  context.step_meshes = &meshes;
  // A signal may look at those below it, too.
  context.signals = signal_names(root);
  read_record({root, ""}, context, model::description_member(out));
  check_table_ranges(out);
  out.warnings = doubt_warnings(root, model::doubtful_values(out));
  out.where = {name, 0, 0};
  out.directory = context.directory.string();
  if (needs_files(out, files)) fix_base(root, context.directory);
  out.source =
      comment_on(files, context.directory) + comment_on(name, overrides) +
      without_old_files(effective_text(files::without_byte_order_mark(text), as_written, root));
  return out;
}

model::ModelDescription read_model_text(const std::string& text, const std::string& name,
                                        const std::vector<std::string>& overrides) {
  StepMeshCache meshes;
  return read_model_text(text, name, overrides, meshes);
}

model::ModelDescription read_model_file(const std::filesystem::path& path,
                                        const std::vector<std::string>& overrides) {
  StepMeshCache meshes;
  return read_model_file(path, overrides, meshes);
}

model::ModelDescription read_model_file(const std::filesystem::path& path,
                                        const std::vector<std::string>& overrides,
                                        StepMeshCache& meshes) {
  return read_model_text(files::read_text_file(path, "model file"), path.string(), overrides,
                         meshes);
}

}  // namespace buckens::model_file
