// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "buckens/analysis/simulation/settings.h"
#include "buckens/base/errors.h"
#include "buckens/linalg/content_hash.h"
#include "buckens/model/build/build_model.h"
#include "buckens/model_file/model_file.h"
#include "buckens/model_file/step_mesh_cache.h"
#include "buckens/run_store/basis_files.h"
#include "buckens/sweep/shards.h"

namespace buckens::sweep {

namespace {

void add_matrix(linalg::ContentHash& hash, const linalg::SymmetricMatrix& A) {
  hash.add(static_cast<std::uint64_t>(A.rows()));
  hash.add(static_cast<std::uint64_t>(A.nonZeros()));
  for (const std::uint64_t number : A.content()) hash.add(number);
}

void add_number(linalg::ContentHash& hash, double value) { hash.add(&value, sizeof value); }

/// Everything that the step matrices K̂ = m M + c C + k K consist of.
std::string matrix_content(model::ModelDescription description) {
  // Bases follow from the meshes; making them is what the variants do.
  for (body::BodySpec& spec : description.bodies) spec.reduction = {};
  const std::filesystem::path directory = description.directory;
  linalg::ContentHash hash;
  if (description.simulation) {
    const auto settings = analysis::step_settings(*description.simulation);
    const auto march = analysis::march_settings(*description.simulation);
    hash.add(static_cast<std::uint64_t>(settings.method));
    add_number(hash, settings.method_parameter());
    add_number(hash, stepping::longest_step_of(march));
    hash.add(static_cast<std::uint64_t>(march.tolerance.has_value()));
  }
  run_store::BasisFiles bases(directory, run_store::BasisFiles::Others::leave);
  const auto built = model::build_model(std::move(description), &bases);
  for (const body::Body& body : built->model.bodies) {
    if (!body.is_flexible()) continue;
    add_matrix(hash, body.flexible->fe.M);
    add_matrix(hash, body.flexible->fe.K);
    add_matrix(hash, body.flexible->C);
  }
  return hash.text();
}

/// The columns whose values change a matrix.
class MatrixColumns {
 public:
  MatrixColumns(const std::filesystem::path& model, const std::vector<std::string>& overrides,
                const SweepTable& table)
      : model_(model), overrides_(overrides), table_(table) {}

  std::vector<std::size_t> find() {
    std::vector<std::size_t> out;
    std::optional<std::string> first;
    for (std::size_t k = 0; k < table_.paths.size(); ++k) {
      Variant changed = table_.variants.front();
      for (const Variant& variant : table_.variants) {
        if (variant.values[k] != changed.values[k]) {
          changed.values[k] = variant.values[k];
          break;
        }
      }
      if (changed.values[k] == table_.variants.front().values[k]) continue;
      if (!first) first = content(table_.variants.front());
      if (content(changed) != *first) out.push_back(k);
    }
    return out;
  }

 private:
  /// Empty for a variant that cannot be built: that is told when it is run.
  std::string content(const Variant& variant) {
    std::vector<std::string> overrides = overrides_;
    for (std::string& text : table_.overrides(variant)) overrides.push_back(std::move(text));
    try {
      return matrix_content(model_file::read_model_file(model_, overrides, step_meshes_));
    } catch (const Error&) {
      return {};
    }
  }

  const std::filesystem::path& model_;
  const std::vector<std::string>& overrides_;
  const SweepTable& table_;
  model_file::StepMeshCache step_meshes_;
};

}  // namespace

std::vector<int> matrix_groups(const std::filesystem::path& model,
                               const std::vector<std::string>& overrides, const SweepTable& table) {
  std::vector<int> out;
  if (table.variants.empty()) return out;
  const std::vector<std::size_t> columns = MatrixColumns(model, overrides, table).find();
  std::map<std::vector<std::string>, int> known;
  for (const Variant& variant : table.variants) {
    std::vector<std::string> values;
    for (const std::size_t k : columns) values.push_back(variant.values[k]);
    out.push_back(known.emplace(std::move(values), static_cast<int>(known.size())).first->second);
  }
  return out;
}

}  // namespace buckens::sweep
