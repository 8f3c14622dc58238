// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/row_service.h"

#include <new>

#include "buckens/linalg/row_worker.h"
#include "buckens/linalg/told_errors.h"

namespace buckens::linalg {

namespace {

RowWorker& worker() {
  static RowWorker own;
  return own;
}

class Peers final : public RowPeers {
 public:
  explicit Peers(const BuckensGridPeers& peers) : peers_(&peers) {}
  void exchange(std::span<const int> out_counts, const double* out, std::span<const int> in_counts,
                double* in) override {
    peers_->exchange(peers_->context, out_counts.data(), out, in_counts.data(), in);
  }
  void multiply(int matrix, const double* x, double* y) override {
    if (peers_->multiply(peers_->context, matrix, x, y) != 0) throw std::bad_alloc();
  }
  std::span<const double> multiply(const RowsOfBody& A, const double* x) override {
    const double* y = nullptr;
    int count = 0;
    const int* rows = A.rows.empty() ? nullptr : A.rows.data();
    if (peers_->multiply_rows(peers_->context, A.matrix, A.space, A.is_new, rows, x, &y, &count)) {
      throw std::bad_alloc();
    }
    return {y, static_cast<std::size_t>(count)};
  }
  Pairs pairs(int number) override {
    Pairs out{};
    peers_->pairs(peers_->context, number, &out.loads, &out.answers);
    return out;
  }

 private:
  const BuckensGridPeers* peers_;
};

constexpr char kLittleMemory[] = "there is too little memory for the rows of vectors";

std::span<const std::byte> as_bytes(const void* bytes, long count) {
  return {static_cast<const std::byte*>(bytes), static_cast<std::size_t>(count)};
}

int begin_rows(int number, const void* bytes, long count, char* error, int error_size) {
  return told_errors(error, error_size, kLittleMemory, [&] {
    base::BytesFrom take(as_bytes(bytes, count));
    worker().add(number, described_rows(take));
  });
}

void end_rows(int number) { worker().remove(number); }

int work_rows(const void* program, long count, const BuckensGridPeers* peers, const double** sums,
              long* num_sums, char* error, int error_size) {
  return told_errors(error, error_size, kLittleMemory, [&] {
    Peers others(*peers);
    const std::span<const double> found = worker().work(as_bytes(program, count), others);
    *sums = found.data();
    *num_sums = static_cast<long>(found.size());
  });
}

double* rows(int number, int vector) try {
  return worker().rows(number, vector).data();
} catch (const std::bad_alloc&) {
  return nullptr;
}

}  // namespace

void serve_rows(BuckensGridMaker& maker) {
  maker.begin_rows = begin_rows;
  maker.end_rows = end_rows;
  maker.work_rows = work_rows;
  maker.rows = rows;
}

}  // namespace buckens::linalg
