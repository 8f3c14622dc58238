// SPDX-License-Identifier: Apache-2.0
// How a matrix comes to the processes, and what they make of it together.
#include <algorithm>
#include <string>

#include "arrays_aside.h"
#include "process_memory.h"
#include "ranks_messages.h"
#include "ranks_parts.h"
#include "reasons.h"

namespace buckens_petsc {

/// Of the first process: gives the others their rows, one after the other, and finds its own last,
/// so that it never holds those of two.
bool Ranks::send_rows(const Part& part, const BuckensGridMatrix& matrix, OwnRows& own) {
  bool has_memory = true;
  for (int k = count_ - 1; k >= 0; --k) {
    const int from = part.first[k];
    const int rows = part.counts[k];
    BuckensGridColumns columns{};
    if (matrix.give != nullptr) {
      matrix.give(matrix.source, from, from + rows, &columns);
    } else {
      columns = matrix.all;
      columns.starts += from;
    }
    has_memory = has_memory && columns.starts != nullptr;
    if (k == 0) {
      own.columns = columns;
      break;
    }
    const int first = has_memory ? columns.starts[0] : 0;
    const int entries = has_memory ? columns.starts[rows] - first : -1;
    send_counted(&entries, 1, k);
    if (has_memory) {
      send_counted(columns.starts, static_cast<std::size_t>(rows) + 1, k);
      send_counted(columns.rows + first, static_cast<std::size_t>(entries), k);
      send_counted(columns.values + first, static_cast<std::size_t>(entries), k);
    }
    for (int m = 0; m < std::min(matrix.num_motions, kMostMotions); ++m) {
      send_counted(matrix.motions + static_cast<std::size_t>(m) * matrix.size + from,
                   static_cast<std::size_t>(rows), k);
    }
  }
  return has_memory;
}

/// Of the others: what send_rows() sends.
bool Ranks::receive_rows(int count, int num_motions, OwnRows& own) {
  int entries = 0;
  receive(&entries, 1, 0, work_);
  if (entries >= 0) {
    own.starts.resize(static_cast<std::size_t>(count) + 1);
    own.rows.resize(static_cast<std::size_t>(entries));
    own.values.resize(own.rows.size());
    receive(own.starts.data(), own.starts.size(), 0, work_);
    receive(own.rows.data(), own.rows.size(), 0, work_);
    receive(own.values.data(), own.values.size(), 0, work_);
    for (std::size_t k = own.starts.size(); k-- > 0;) own.starts[k] -= own.starts[0];
    own.columns = {own.starts.data(), own.rows.data(), own.values.data()};
  }
  own.motions.resize(static_cast<std::size_t>(count) * num_motions);
  for (int m = 0; m < num_motions; ++m) {
    receive(own.motions.data() + static_cast<std::size_t>(m) * count,
            static_cast<std::size_t>(count), 0, work_);
  }
  return entries >= 0;
}

/// Which rows are whose: equal runs of nodes.
std::unique_ptr<Ranks::Part> Ranks::divide(const Order& order) const {
  auto part = std::make_unique<Part>();
  const int nodes = order.size / order.block;
  for (int k = 0; k <= count_; ++k) {
    part->first.push_back(static_cast<int>(static_cast<long>(nodes) * k / count_) * order.block);
  }
  part->first.back() = order.size;
  for (int k = 0; k < count_; ++k) part->counts.push_back(part->first[k + 1] - part->first[k]);
  return part;
}

bool Ranks::make_together(const Order& order, const BuckensGridMatrix* matrix) {
  const SolverLibrary* library = solver_library();
  // PETSc begins on all processes or on none.
  if (has_failed_somewhere(library == nullptr)) return false;
  std::unique_ptr<Part> part = divide(order);
  const int count = part->counts[rank_];
  std::string options(static_cast<std::size_t>(order.options), ' ');
  if (matrix != nullptr && matrix->options != nullptr) options = matrix->options;
  MPI_Bcast(options.data(), order.options, MPI_CHAR, 0, work_);
  OwnRows own;
  const bool is_complete = matrix != nullptr ? send_rows(*part, *matrix, own)
                                             : receive_rows(count, order.num_motions, own);
  if (!is_complete) set_reason("there is too little memory for the rows of the matrix");
  if (has_failed_somewhere(!is_complete)) return false;
  Rows rows;
  rows.size = order.size;
  rows.count = count;
  rows.block = order.block;
  rows.num_motions = order.num_motions;
  rows.options = options.c_str();
  rows.starts = own.columns.starts;
  rows.columns = own.columns.rows;
  rows.values = own.columns.values;
  rows.motions = matrix != nullptr ? matrix->motions : own.motions.data();
  rows.stride = matrix != nullptr ? order.size : count;
  rows.release = [&own, matrix] {
    own = OwnRows();
    if (matrix != nullptr && matrix->give != nullptr) matrix->give(matrix->source, 0, 0, nullptr);
  };
  std::string reason;
  part->solver.reset(library->make(&work_, rows, reason));
  if (part->solver == nullptr) set_reason(reason);
  if (has_failed_somewhere(part->solver == nullptr)) return false;
  part->b.resize(static_cast<std::size_t>(count));
  part->x.resize(static_cast<std::size_t>(count));
  shared_->parts[order.number] = std::move(part);
  return true;
}

bool Ranks::factorise_together(const Order& order, const BuckensGridMatrix* matrix) {
  std::unique_ptr<Part> part = divide(order);
  OwnRows own;
  bool is_complete = false;
  if (order.num_matrices() > 0) {
    const Divided& term = *shared_->matrices.at(order.of.front());
    part->first = term.first;
    part->counts = term.counts;
    is_complete = sum_terms(order, matrix != nullptr ? matrix->weights : nullptr, own);
  } else {
    is_complete = matrix != nullptr ? send_rows(*part, *matrix, own)
                                    : receive_rows(part->counts[rank_], 0, own);
  }
  part->factor = std::make_unique<MumpsFactor>(work_);
  const TrianglePart triangle{order.size,         part->first[rank_], part->counts[rank_],
                              own.columns.starts, own.columns.rows,   own.columns.values};
  const bool is_prepared =
      is_complete && part->factor->prepare(triangle, matrix != nullptr ? matrix->order : nullptr);
  if (!is_prepared) set_reason("there is too little memory for the rows of the matrix");
  if (has_failed_somewhere(!is_prepared)) return false;
  own = {};
  if (matrix != nullptr && matrix->give != nullptr) matrix->give(matrix->source, 0, 0, nullptr);
  const bool is_made = make_with_room(*part->factor);
  if (matrix != nullptr && matrix->is_indefinite != nullptr) {
    *matrix->is_indefinite = part->factor->is_indefinite() ? 1 : 0;
  }
  give_memory_back();
  if (has_failed_somewhere(!is_made)) return false;
  find_places(order.size, *part);
  shared_->parts[order.number] = std::move(part);
  return true;
}

/// Fronts need most memory of all, and while there are some, nothing needs M and K.
bool Ranks::make_with_room(MumpsFactor& factor) {
  ArraysAside aside;
  for (auto& [number, matrix] : shared_->matrices) {
    matrix->columns.put(aside);
  }
  const bool is_made = factor.make();
  give_memory_back();
  bool is_back = true;
  const bool has_room = has_memory_for([&] { is_back = aside.bring_back(); });
  if (has_room && is_back) return is_made;
  if (has_room) set_reason("the disk has lost the rows of M and K, which it had meanwhile");
  for (auto& [number, matrix] : shared_->matrices) {
    matrix->columns.lose();  // no product reads what is lost
  }
  return false;
}

/// Which variables are where in a factor.
void Ranks::find_places(int size, Part& part) {
  const std::vector<int>& here = part.factor->variables();
  const int count = static_cast<int>(here.size());
  MPI_Allgather(&count, 1, MPI_INT, part.counts.data(), 1, MPI_INT, work_);
  for (int k = 0; k < count_; ++k) part.first[k + 1] = part.first[k] + part.counts[k];
  if (rank_ == 0) part.variables.resize(static_cast<std::size_t>(part.first[count_]));
  MPI_Gatherv(here.data(), count, MPI_INT, part.variables.data(), part.counts.data(),
              part.first.data(), MPI_INT, 0, work_);
  if (rank_ == 0) part.whole.resize(static_cast<std::size_t>(size));
  part.b.resize(static_cast<std::size_t>(std::max(1, count)));
  part.x.resize(part.b.size());
}

}  // namespace buckens_petsc
