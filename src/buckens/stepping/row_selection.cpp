// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/row_selection.h"

#include <cmath>

#include <Eigen/IterativeLinearSolvers>

#include "buckens/body/body_lengths.h"

namespace buckens::stepping {

using Eigen::RowVectorXd;

namespace {

// Images of rows shrink with the square of a lever arm: 1e-9 here is an arm of 3e-5 of the body.
constexpr double kTolerance = 1e-9;
// Smaller shares of a combination are rounding of its coefficients, which messages do not need.
constexpr double kShareInMessage = 1e-3;

/// Motion of the body that a unit multiplier causes: frame coordinates, then interface values.
RowVectorXd image(const dynamics::BodyRow& row, const dynamics::BodyCompliance& compliance) {
  const Eigen::Index values = compliance.interface ? compliance.interface->rows() : 0;
  RowVectorXd out = RowVectorXd::Zero(6 + values);
  out.head<6>() = (compliance.frame * row.frame.transpose()).transpose();
  if (values == 0 || row.translation_row < 0) return out;
  out.tail(values) = row.interface.head<3>() *
                     compliance.interface->middleCols<3>(row.translation_row).transpose();
  if (row.rotation_row >= 0) {
    out.tail(values) +=
        row.interface.tail<3>() * compliance.interface->middleCols<3>(row.rotation_row).transpose();
  }
  return out;
}

/// What makes displacements of an image: rotations count by the length L.
RowVectorXd lengths_of(const body::Body& body, const dynamics::BodyCompliance& compliance,
                       double L) {
  const Eigen::Index values = compliance.interface ? compliance.interface->rows() : 0;
  RowVectorXd out = RowVectorXd::Ones(6 + values);
  out.head<3>().setConstant(L);
  if (values > 0) out.tail(values) = body::interface_lengths(body, L).head(values).transpose();
  return out;
}

/// Images of all rows, scaled to unit length.
linalg::SparseMatrix scaled_images(const model::Model& model,
                                   const std::vector<dynamics::SystemRow>& rows,
                                   const std::vector<dynamics::BodyCompliance>& compliance) {
  std::vector<int> first_column;
  int columns = 0;
  std::vector<RowVectorXd> lengths;
  for (std::size_t b = 0; b < compliance.size(); ++b) {
    first_column.push_back(columns);
    lengths.push_back(lengths_of(model.bodies[b], compliance[b], model.length));
    columns += static_cast<int>(lengths.back().size());
  }
  std::vector<linalg::Triplet> entries;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const std::size_t begin = entries.size();
    double square = 0;
    for (const dynamics::BodyRow* part : rows[r].parts()) {
      if (part->body == model::kGround) continue;
      const auto b = static_cast<std::size_t>(part->body);
      const RowVectorXd values = image(*part, compliance[b]).cwiseProduct(lengths[b]);
      square += values.squaredNorm();
      for (Eigen::Index c = 0; c < values.size(); ++c) {
        if (values[c] == 0.0) continue;
        entries.emplace_back(static_cast<int>(r), first_column[b] + static_cast<int>(c), values[c]);
      }
    }
    const double scale = square > 0.0 ? 1.0 / std::sqrt(square) : 0.0;
    for (std::size_t k = begin; k < entries.size(); ++k) {
      entries[k] = {entries[k].row(), entries[k].col(), scale * entries[k].value()};
    }
  }
  linalg::SparseMatrix J(static_cast<int>(rows.size()), columns);
  J.setFromTriplets(entries.begin(), entries.end());
  return J;
}

}  // namespace

linalg::RowRank select_rows(const model::Model& model, const std::vector<dynamics::SystemRow>& rows,
                            const std::vector<dynamics::BodyCompliance>& compliance) {
  return linalg::split_rows(scaled_images(model, rows, compliance), kTolerance);
}

std::vector<int> rows_behind(const model::Model& model,
                             const std::vector<dynamics::SystemRow>& rows,
                             const std::vector<dynamics::BodyCompliance>& compliance,
                             const std::vector<int>& independent, int row) {
  const linalg::SparseMatrix columns = scaled_images(model, rows, compliance).transpose();
  linalg::SparseMatrix chosen(columns.rows(), static_cast<Eigen::Index>(independent.size()));
  std::vector<linalg::Triplet> entries;
  for (std::size_t k = 0; k < independent.size(); ++k) {
    for (linalg::SparseMatrix::InnerIterator it(columns, independent[k]); it; ++it) {
      entries.emplace_back(static_cast<int>(it.row()), static_cast<int>(k), it.value());
    }
  }
  chosen.setFromTriplets(entries.begin(), entries.end());
  Eigen::LeastSquaresConjugateGradient<linalg::SparseMatrix> solver(chosen);
  const linalg::Vector share = solver.solve(linalg::Vector(columns.col(row)));
  std::vector<int> out;
  for (std::size_t k = 0; k < independent.size(); ++k) {
    const double own = std::abs(share[static_cast<Eigen::Index>(k)]);
    if (own > kShareInMessage * share.cwiseAbs().maxCoeff()) out.push_back(independent[k]);
  }
  return out;
}

}  // namespace buckens::stepping
