// SPDX-License-Identifier: Apache-2.0
#include "buckens/mesh_io/matrix/body.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/mesh_io/label_index.h"
#include "buckens/mesh_io/matrix/file.h"
#include "buckens/mesh_io/matrix/node_table.h"

namespace buckens::mesh_io {

namespace {

// Shares of the largest entry by which two that should be equal may differ in a file: rounding of
// their last digit.
constexpr double kSymmetric = 1e-6;

constexpr const char* kVariables[] = {"ux", "uy", "uz", "rx", "ry", "rz"};

/// Puts matrices and table together.
class BodyReader {
 public:
  BodyReader(const fem::MatricesSpec& spec, const std::filesystem::path& directory)
      : length_(size_of(spec.length_unit)), mass_(size_of(spec.unit_of_mass())) {
    mass_file_ = read_matrix_file(directory / spec.mass);
    stiffness_file_ = read_matrix_file(directory / spec.stiffness);
    if (!spec.damping.empty()) damping_file_ = read_matrix_file(directory / spec.damping);
    table_ = read_matrix_node_table(directory / spec.nodes);
  }

  fem::BodyMatrices run() {
    index_nodes();
    find_dofs();
    out_.M = matrix(mass_file_);
    out_.K = matrix(stiffness_file_);
    if (!damping_file_.entries.empty()) out_.C = matrix(damping_file_);
    return std::move(out_);
  }

 private:
  void index_nodes() {
    std::int64_t largest = 0;
    for (const TableNode& node : table_.nodes) largest = std::max(largest, node.number);
    nodes_ = LabelIndex(table_.nodes.size(), largest);
    for (const TableNode& node : table_.nodes) {
      nodes_.add(node.number, static_cast<int>(out_.nodes.size()));
      out_.numbers.push_back(node.number);
      out_.nodes.push_back({fmt::format("n{}", node.number), length_ * node.position});
    }
  }

  /// Which variables each node has, and the order of the rows.
  void find_dofs() {
    has_.resize(out_.nodes.size());
    const MatrixFile* counted = file_that_counts();
    if (table_.has_rows) {
      for (std::size_t k = 0; k < has_.size(); ++k) {
        for (std::size_t v = 0; v < 6; ++v) has_[k][v] = table_.nodes[k].rows[v] > 0;
      }
    } else if (counted == nullptr) {
      take_labels(mass_file_);
      take_labels(stiffness_file_);
    } else {
      const auto count = static_cast<std::int64_t>(has_.size());
      const std::int64_t rows = counted->size;
      if (rows != 3 * count && rows != 6 * count) {
        throw InputError(
            {counted->file, 0, 0},
            fmt::format("the matrix has {} rows, the table {} nodes; without the "
                        "columns ux … rz in the table every node must have 3 or 6 rows",
                        rows, count));
      }
      for (auto& has : has_) std::fill_n(has.begin(), rows == 3 * count ? 3 : 6, true);
    }
    number_dofs();
    if (counted != nullptr) number_rows();
  }

  /// A file whose rows are counted; null if all go by nodes and variables.
  const MatrixFile* file_that_counts() const {
    for (const MatrixFile* file : {&stiffness_file_, &mass_file_, &damping_file_}) {
      if (!file->is_labelled && !file->entries.empty()) return file;
    }
    return nullptr;
  }

  void take_labels(const MatrixFile& file) {
    for (const MatrixEntry& entry : file.entries) {
      for (const auto& [label, variable] : {std::pair(entry.row, entry.row_variable),
                                            std::pair(entry.column, entry.column_variable)}) {
        const int node = nodes_.find(label);
        if (node < 0) {
          throw InputError(file.where(entry),
                           fmt::format("node {} is not in the table {}", label, table_.file));
        }
        has_[static_cast<std::size_t>(node)][static_cast<std::size_t>(variable)] = true;
      }
    }
  }

  void number_dofs() {
    out_.dofs.node_dofs.resize(has_.size());
    for (std::size_t k = 0; k < has_.size(); ++k) {
      const auto& has = has_[k];
      const auto turns = std::count(has.begin() + 3, has.end(), true);
      if (!(has[0] && has[1] && has[2]) || (turns != 0 && turns != 3)) {
        std::string known;
        for (std::size_t v = 0; v < 6; ++v)
          known += has[v] ? fmt::format(" {}", kVariables[v]) : "";
        throw InputError(
            table_.where(table_.nodes[k]),
            fmt::format("node {} has the variables{}; it needs ux, uy, uz, and rx, ry, "
                        "rz either all or not at all",
                        table_.nodes[k].number, known.empty() ? " none" : known));
      }
      for (std::size_t v = 0; v < 6; ++v) {
        out_.dofs.node_dofs[k][v] = has[v] ? out_.dofs.num_dofs++ : -1;
      }
    }
  }

  /// The variable of each row of files that count them.
  void number_rows() {
    dof_of_row_.assign(static_cast<std::size_t>(out_.dofs.num_dofs), -1);
    for (std::size_t k = 0; k < has_.size(); ++k) {
      for (std::size_t v = 0; v < 6; ++v) {
        const int dof = out_.dofs.node_dofs[k][v];
        if (dof < 0) continue;
        const std::int64_t row = table_.has_rows ? table_.nodes[k].rows[v] : dof + 1;
        if (row < 1 || row > out_.dofs.num_dofs) {
          throw InputError(
              table_.where(table_.nodes[k]),
              fmt::format("{} of node {} is row {}; rows are counted from 1 to {}", kVariables[v],
                          table_.nodes[k].number, row, out_.dofs.num_dofs));
        }
        int& entry = dof_of_row_[static_cast<std::size_t>(row - 1)];
        if (entry >= 0) {
          throw InputError(table_.where(table_.nodes[k]),
                           fmt::format("row {} is named twice in the table", row));
        }
        entry = dof;
      }
    }
  }

  int dof(const MatrixFile& file, const MatrixEntry& entry, std::int64_t label,
          signed char variable) const {
    if (!file.is_labelled) {
      if (label <= out_.dofs.num_dofs) return dof_of_row_[static_cast<std::size_t>(label - 1)];
      throw InputError(file.where(entry), fmt::format("row or column {}: the table of nodes has {} "
                                                      "rows",
                                                      label, out_.dofs.num_dofs));
    }
    const int node = nodes_.find(label);
    if (node < 0) {
      throw InputError(file.where(entry),
                       fmt::format("node {} is not in the table {}", label, table_.file));
    }
    const int found = node < 0 ? -1
                               : out_.dofs.node_dofs[static_cast<std::size_t>(node)]
                                                    [static_cast<std::size_t>(variable)];
    if (found >= 0) return found;
    throw InputError(file.where(entry), fmt::format("{} of node {} is not among the variables of "
                                                    "the other matrices and the table",
                                                    kVariables[variable], label));
  }

  /// Both triangles, in SI units: kg or N/m times a length for each rotation.
  linalg::SparseMatrix matrix(const MatrixFile& file) const {
    const int n = out_.dofs.num_dofs;
    if (!file.is_labelled && file.size != n) {
      throw InputError({file.file, 0, 0}, fmt::format("the matrix has {} rows, the nodes of the "
                                                      "table have {} variables",
                                                      file.size, n));
    }
    std::vector<double> scale(static_cast<std::size_t>(n), 1.0);
    for (const auto& node : out_.dofs.node_dofs) {
      for (std::size_t v = 3; v < 6; ++v) {
        if (node[v] >= 0) scale[static_cast<std::size_t>(node[v])] = length_;
      }
    }
    std::vector<linalg::Triplet> entries;
    entries.reserve((file.is_triangle ? 2 : 1) * file.entries.size());
    for (const MatrixEntry& entry : file.entries) {
      const int i = dof(file, entry, entry.row, entry.row_variable);
      const int j = dof(file, entry, entry.column, entry.column_variable);
      const double value = mass_ * scale[static_cast<std::size_t>(i)] *
                           scale[static_cast<std::size_t>(j)] * entry.value;
      entries.emplace_back(i, j, value);
      if (file.is_triangle && i != j) entries.emplace_back(j, i, value);
    }
    linalg::SparseMatrix out(n, n);
    out.setFromTriplets(entries.begin(), entries.end());
    return symmetric(file, out);
  }

  linalg::SparseMatrix symmetric(const MatrixFile& file, const linalg::SparseMatrix& A) const {
    const linalg::SparseMatrix T = A.transpose();
    const linalg::SparseMatrix rest = A - T;
    double largest = 0.0;
    for (Eigen::Index k = 0; k < A.nonZeros(); ++k) {
      largest = std::max(largest, std::abs(A.valuePtr()[k]));
    }
    for (int column = 0; column < rest.outerSize(); ++column) {
      for (linalg::SparseMatrix::InnerIterator it(rest, column); it; ++it) {
        if (std::abs(it.value()) <= kSymmetric * largest) continue;
        throw InputError(
            {file.file, 0, 0},
            fmt::format("the matrix is not symmetric: {:g} and {:g} are mirror entries",
                        A.coeff(it.row(), column), A.coeff(column, it.row())));
      }
    }
    return 0.5 * (A + T);
  }

  double length_;
  double mass_;
  MatrixFile mass_file_, stiffness_file_, damping_file_;
  MatrixNodeTable table_;
  LabelIndex nodes_;
  std::vector<std::array<bool, 6>> has_;
  std::vector<int> dof_of_row_;
  fem::BodyMatrices out_;
};

}  // namespace

std::shared_ptr<const fem::BodyMatrices> read_body_matrices(
    const fem::MatricesSpec& spec, const std::filesystem::path& directory) {
  return std::make_shared<const fem::BodyMatrices>(BodyReader(spec, directory).run());
}

}  // namespace buckens::mesh_io
