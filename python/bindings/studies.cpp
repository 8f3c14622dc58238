// SPDX-License-Identifier: Apache-2.0
#include "bindings/studies.h"

#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "buckens/base/errors.h"
#include "buckens/base/units.h"
#include "buckens/files/output_file.h"
#include "buckens/files/text_file.h"
#include "buckens/sweep/shards.h"
#include "buckens/sweep/summary.h"
#include "buckens/sweep/variant_rows.h"

namespace py = pybind11;
using namespace py::literals;

namespace buckens::python {

namespace {

using Unlocked = py::call_guard<py::gil_scoped_release>;
using Names = std::vector<std::string>;
/// Name and values of variants.
using Variants = std::vector<std::pair<std::string, Names>>;
/// The paths of a table and its variants.
using Table = std::pair<Names, Variants>;

std::vector<sweep::Variant> from_python(const Variants& variants) {
  std::vector<sweep::Variant> out;
  for (const auto& [name, values] : variants) out.push_back({name, values});
  return out;
}

Table to_python(const sweep::SweepTable& table) {
  Table out{table.paths, {}};
  for (const sweep::Variant& variant : table.variants) {
    out.second.emplace_back(variant.name, variant.values);
  }
  return out;
}

Table read_table(const std::string& file) { return to_python(sweep::read_sweep_table(file)); }
Table combinations(const Names& ranges) { return to_python(sweep::combinations(ranges)); }

std::vector<int> matrix_groups(const std::string& model, const Names& overrides, const Names& paths,
                               const Variants& variants) {
  return sweep::matrix_groups(model, overrides, {paths, from_python(variants)});
}

/// "10 mm": number, unit as written, size of the unit in SI units, dimension.
std::tuple<double, std::string, double, std::string> quantity(const std::string& text) {
  const base::QuantityText parts = base::split_quantity(text);
  const auto number = base::parse_number(parts.formula);
  const auto unit = parts.unit.empty() ? std::optional(base::Unit{}) : base::parse_unit(parts.unit);
  if (!number || !unit) {
    throw InputError(fmt::format(
        "\"{}\" is not a quantity; write a number and a unit, for instance 10 mm", text));
  }
  return {*number, parts.unit, unit->factor, base::si_unit(unit->dimension)};
}

std::string text_of(std::uint64_t content) { return fmt::format("{:016x}", content); }

/// Hash of a file as files::FilesRead has it; empty if it cannot be read.
std::string file_content(const std::string& path) {
  const files::FilesRead read;
  try {
    (void)files::read_text_file(path, "file", std::numeric_limits<std::size_t>::max());
  } catch (const IoError&) {
    return {};
  }
  return text_of(read.hashes().begin()->second);
}

/// Rows of variants: cells, and contents of files by their paths.
using Rows = std::vector<std::pair<sweep::SummaryCells, std::map<std::string, std::string>>>;

Rows run_variants(sweep::VariantRows& worker, const Variants& variants) {
  Rows out;
  for (sweep::VariantRow& row : worker.run(from_python(variants))) {
    auto& [cells, files] = out.emplace_back(std::move(row.cells), Rows::value_type::second_type{});
    for (const auto& [path, content] : row.files) files[path.string()] = text_of(content);
  }
  return out;
}

void write_table(const std::string& directory, const std::vector<sweep::SummaryCells>& rows) {
  sweep::SummaryTable table;
  for (const sweep::SummaryCells& row : rows) table.add_row(row);
  const std::filesystem::path out = directory;
  files::replace_text_file(out / sweep::kSweepName, table.csv());
  table.write_hdf5(out / sweep::kSweepHdf5Name);
}

}  // namespace

void define_studies(py::module_& core) {
  core.def("read_table", &read_table, "file"_a, Unlocked());
  core.def("combinations", &combinations, "ranges"_a, Unlocked());
  core.def("matrix_groups", &matrix_groups, "model"_a, "overrides"_a, "paths"_a, "variants"_a,
           Unlocked());
  core.def("quantity", &quantity, "text"_a);
  core.def("write_table", &write_table, "directory"_a, "rows"_a, Unlocked());
  core.def("file_content", &file_content, "path"_a, Unlocked());
  using Worker = sweep::VariantRows;
  py::class_<Worker, std::shared_ptr<Worker>>(core, "VariantRows")
      .def(py::init<std::string, Names, Names>(), "model"_a, "overrides"_a, "paths"_a, Unlocked())
      .def_property_readonly("source", &Worker::source)
      .def_property_readonly("num_factorisations", &Worker::num_factorisations)
      .def("run", &run_variants, "variants"_a, Unlocked())
      .def("forget_factors", &Worker::forget_factors, Unlocked());
}

}  // namespace buckens::python
