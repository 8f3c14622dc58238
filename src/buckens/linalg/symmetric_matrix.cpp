// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/symmetric_matrix.h"

#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "buckens/linalg/column_content.h"
#include "buckens/linalg/divided_matrix.h"
#include "buckens/linalg/node_blocks.h"
#include "buckens/linalg/node_matrix.h"
#include "buckens/linalg/row_order.h"
#include "buckens/linalg/same_bits.h"

namespace buckens::linalg {

namespace {

Matrix weighted_product_of(double weight, const NodeBlocks& A, const Matrix& X) {
  Matrix out = Matrix::Zero(X.rows(), X.cols());
  for (Eigen::Index column = 0; column < A.size(); ++column) {
    for (NodeBlocks::Column it(A, column); it; ++it) {
      const double entry = weight * it.value();
      for (Eigen::Index k = 0; k < X.cols(); ++k) out(it.row(), k) += entry * X(column, k);
    }
  }
  return out;
}

}  // namespace

SymmetricMatrix::SymmetricMatrix(std::shared_ptr<const DividedMatrix> rows)
    : size_(rows->size()), divided_(std::move(rows)) {}

SymmetricMatrix SymmetricMatrix::by_node(std::shared_ptr<const SparseMatrix> nodes) {
  SymmetricMatrix out;
  out.size_ = 3 * nodes->rows();
  out.nodes_ = std::move(nodes);
  return out;
}

SymmetricMatrix SymmetricMatrix::in_blocks(SparseMatrix&& A, TaskPool* pool) {
  SymmetricMatrix out(std::move(A));
  out.here_.makeCompressed();
  if (out.cols() < NodeBlocks::kFewestVariables) return out;
  std::shared_ptr<const NodeBlocks> blocks = NodeBlocks::of(out.here_, pool);
  if (!blocks) return out;
  out.drop();
  out.blocks_ = std::move(blocks);
  return out;
}

Eigen::Index SymmetricMatrix::nonZeros() const {
  if (blocks_) return blocks_->nonZeros();
  if (nodes_) return 3 * nodes_->nonZeros();
  return divided_ ? divided_->entries() : here_.nonZeros();
}

Vector SymmetricMatrix::diagonal() const {
  if (blocks_) return blocks_->diagonal();
  if (nodes_) return of_variables(nodes_->diagonal());
  return divided_ ? divided_->diagonal() : Vector(here_.diagonal());
}

Vector SymmetricMatrix::near_diagonal(std::span<const int> lengths) const {
  if (divided_) return divided_->near_diagonal(lengths);
  Vector out(std::accumulate(lengths.begin(), lengths.end(), Eigen::Index{0}));
  Eigen::Index next = 0;
  for (Eigen::Index column = 0; column < size_; ++column) {
    for (int k = 0; k < lengths[static_cast<std::size_t>(column)]; ++k) {
      const Eigen::Index row = column + k;
      if (blocks_) {
        out[next++] = blocks_->coeff(row, column);
      } else if (!nodes_) {
        out[next++] = here_.coeff(row, column);
      } else {
        out[next++] = k % 3 == 0 ? nodes_->coeff(row / 3, column / 3) : 0.0;
      }
    }
  }
  return out;
}

double SymmetricMatrix::norm() const {
  if (blocks_) return blocks_->norm();
  if (nodes_) return std::sqrt(3.0) * nodes_->norm();
  return divided_ ? divided_->norm() : here_.norm();
}

const SparseMatrix& SymmetricMatrix::whole() const {
  if (divided_) {
    SparseMatrix A = divided_->gathered();
    here_.swap(A);
    order_ = divided_->row_order();
    divided_.reset();
  }
  if (!is_formed()) {
    SparseMatrix A = copied();
    here_.swap(A);
  }
  return here_;
}

SparseMatrix SymmetricMatrix::copied() const {
  if (is_divided() || is_formed()) return whole();
  return blocks_ ? blocks_->whole() : of_variables(*nodes_);
}

bool SymmetricMatrix::operator==(const SymmetricMatrix& other) const {
  if (nodes_ && other.nodes_)
    return nodes_ == other.nodes_ || have_same_bits(*nodes_, *other.nodes_);
  if (blocks_ && other.blocks_) return blocks_ == other.blocks_ || *blocks_ == *other.blocks_;
  const auto is_whole = [](const SymmetricMatrix& A) {
    return !A.divided_ && !A.nodes_ && !A.blocks_;
  };
  if (is_whole(*this) && is_whole(other)) return have_same_bits(here_, other.here_);
  if (rows() != other.rows() || nonZeros() != other.nonZeros()) return false;
  return (divided_ && divided_ == other.divided_) || content() == other.content();
}

std::array<std::uint64_t, 2> SymmetricMatrix::content() const {
  if (blocks_) return blocks_->content();
  if (nodes_ && !is_formed()) return symmetric_content(of_variables(*nodes_));
  return divided_ ? divided_->content() : symmetric_content(here_);
}

SharedRowOrder SymmetricMatrix::row_order() const {
  return divided_ ? divided_->row_order() : order_;
}

const DividedMatrix& SymmetricMatrix::divide(const SharedRowOrder& order) const {
  if (divided_ && !is_same_order(divided_->row_order(), order)) (void)whole();
  if (!divided_) {
    divided_ = std::make_shared<const DividedMatrix>(whole(), order);
    drop();
  }
  return *divided_;
}

void SymmetricMatrix::share(const SymmetricMatrix& equal) const {
  if (!equal.divided_ || divided_ == equal.divided_) return;
  divided_ = equal.divided_;
  drop();
}

void SymmetricMatrix::drop() const {
  SparseMatrix nothing;
  here_.swap(nothing);
  nodes_.reset();
  blocks_.reset();
}

void SymmetricMatrix::add_product(const Vector& x, Vector& y) const {
  if (blocks_) {
    blocks_->add_product(x.data(), y.data());
  } else if (divided_ || nodes_) {
    y += *this * x;
  } else {
    y.noalias() += here_ * x;
  }
}

void SymmetricMatrix::multiply(const double* x, double* y) const {
  if (blocks_) return blocks_->multiply(x, y);
  if (nodes_) return multiply_by_node(*nodes_, x, y);
  const DividedMatrix::Product product{divided_.get(), x, y};
  DividedMatrix::multiply({&product, 1});
}

Matrix weighted_product(double weight, const SymmetricMatrix& A, const Matrix& X) {
  if (A.blocks() != nullptr) return weighted_product_of(weight, *A.blocks(), X);
  if (A.is_divided() || A.nodes() != nullptr) return weight * Matrix(A * X);
  return weight * (A.whole() * X);
}

void multiply(std::initializer_list<MatrixProduct> products, TaskPool* pool) {
  std::vector<DividedMatrix::Product> elsewhere;
  for (const MatrixProduct& product : products) {
    product.y->resize(product.A->rows());
    if (!product.A->is_divided()) continue;
    elsewhere.push_back({&product.A->divide(), product.x->data(), product.y->data()});
  }
  run_tasks(pool, static_cast<int>(products.size()), [&](int k) {
    const MatrixProduct& product = products.begin()[k];
    if (product.A->is_divided()) return;
    if (product.A->blocks() != nullptr) {
      product.A->blocks()->multiply(product.x->data(), product.y->data());
    } else if (product.A->nodes() != nullptr) {
      multiply_by_node(*product.A->nodes(), product.x->data(), product.y->data());
    } else {
      product.y->noalias() = product.A->whole() * *product.x;
    }
  });
  DividedMatrix::multiply(elsewhere);
}

}  // namespace buckens::linalg
