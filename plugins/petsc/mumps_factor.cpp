// SPDX-License-Identifier: Apache-2.0
#include "mumps_factor.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <new>
#include <string>

#include <sys/mman.h>
#include <unistd.h>

#include "process_memory.h"
#include "reasons.h"

namespace buckens_petsc {

namespace {

enum Job : int { kBegin = -1, kEnd = -2, kAnalyse = 1, kFactorise = 2, kSolve = 3, kPlaces = 9 };

// INFOG(1): not enough of what it has set aside; buffers too small; allocations that failed; a
// pivot that is zero or negative.
constexpr int kNarrow[] = {-8, -9, -14, -15, -17, -20};
constexpr int kNoMemory[] = {-7, -13, -19, -23};
constexpr int kNotDefinite[] = {-10, -40};
// What MUMPS adds to its predictions [%], and how much of them is set aside if the first try fails,
// and the next ones. Processes get fronts as they have time for them, so that the first may fail on
// a busy machine only.
constexpr int kRelaxation = 20;
constexpr double kMargins[] = {1.0, 1.3, 2.6, 5.2, 10.4};
// Share of the predicted fronts for which the first try has room on two processes; what has no room
// there goes elsewhere. On four, half was too little for 292 008 variables.
constexpr double kShareOfTwo = 0.5;

template <int count>
bool is_among(int code, const int (&codes)[count]) {
  return std::find(codes, codes + count, code) != codes + count;
}

constexpr const char* kNegativePivot = "the matrix is not positive definite";
constexpr int kNarrowFront = 2;
// Subtrees of the elimination that one process works on alone may differ in work by so much [%].
// With more of a difference they are larger, and so are their fronts, of which one process has all.
// On two processes that makes their largest part larger.
constexpr int kEvenSubtrees = 100;
constexpr double kMillion = 1e6;
/// Numbers that MUMPS gives in millions where they are large.
double number(int value) { return value < 0 ? -kMillion * value : value; }

}  // namespace

bool Workspace::set_aside(std::size_t numbers) {
  if (data_ != nullptr) ::munmap(data_, bytes_);
  data_ = nullptr;
  bytes_ = numbers * sizeof(double);
  if (numbers == 0) return true;
  void* found = ::mmap(nullptr, bytes_, PROT_READ | PROT_WRITE,
                       MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (found == MAP_FAILED) return false;
  data_ = static_cast<double*>(found);
  return true;
}

void Workspace::keep(std::size_t numbers) {
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  const std::size_t end = (numbers * sizeof(double) + page - 1) / page * page;
  if (data_ == nullptr || end >= bytes_) return;
  (void)::madvise(reinterpret_cast<char*>(data_) + end, bytes_ - end, MADV_DONTNEED);
}

MumpsFactor::MumpsFactor(MPI_Comm comm) : comm_(comm) {
  prepare_blas();
  mumps_.comm_fortran = MPI_Comm_c2f(comm);
  mumps_.par = 1;  // the first process has a part of it, too
  mumps_.sym = 1;  // positive definite
  (void)run(kBegin);
  // It merges fronts with few variables to eliminate, by KEEP(1), of which its guide says nothing.
  // With the value that it takes for itself the factor of a cube has a tenth more entries.
  mumps_.keep[1 - 1] = kNarrowFront;
  if (number_of_processes() > 2) mumps_.keep[102 - 1] = kEvenSubtrees;
  int* control = mumps_.icntl - 1;  // numbered as in its guide
  control[1] = control[2] = control[3] = -1;
  control[4] = 0;  // says nothing
  control[6] = 0;  // exchanges no columns,
  control[8] = 0;  // scales none,
  control[7] = 1;  // and takes our order
  control[14] = kRelaxation;
  control[13] = 1;   // the last front is divided like others, not kept square
  control[18] = 3;   // entries are where they are
  control[20] = 10;  // so are right-hand sides
  control[21] = 1;   // and answers
  control[28] = 1;   // one process analyses
}

MumpsFactor::~MumpsFactor() { (void)run(kEnd); }

int MumpsFactor::number_of_processes() const {
  int count = 1;
  MPI_Comm_size(comm_, &count);
  return count;
}

/// Whether it went well; otherwise the reason is set.
bool MumpsFactor::run(int job) {
  mumps_.job = job;
  dmumps_c(&mumps_);
  const int code = mumps_.infog[0];
  if (code >= 0) return true;
  if (is_among(code, kNotDefinite)) {
    set_reason(kNegativePivot);
  } else if (is_among(code, kNoMemory) || is_among(code, kNarrow)) {
    set_reason("there is too little memory (MUMPS: INFOG(1) = " + std::to_string(code) +
               ", INFOG(2) = " + std::to_string(mumps_.infog[1]) + ")");
  } else {
    set_reason("MUMPS ended with INFOG(1) = " + std::to_string(code) +
               ", INFOG(2) = " + std::to_string(mumps_.infog[1]));
  }
  return false;
}

bool MumpsFactor::prepare(const TrianglePart& part, const int* order) try {
  const int entries = part.count > 0 ? part.starts[part.count] - part.starts[0] : 0;
  rows_.reserve(static_cast<std::size_t>(entries) +
                1);  // MUMPS asks for an address of nothing, too
  columns_.reserve(rows_.capacity());
  for (int k = 0; k < part.count; ++k) {
    for (int e = part.starts[k]; e < part.starts[k + 1]; ++e) {
      rows_.push_back(part.rows[e] + 1);
      columns_.push_back(part.first + k + 1);
    }
  }
  if (order != nullptr) {
    places_.resize(static_cast<std::size_t>(part.size));
    for (int k = 0; k < part.size; ++k) places_[static_cast<std::size_t>(order[k])] = k + 1;
  }
  mumps_.n = part.size;
  mumps_.nnz_loc = entries;
  mumps_.irn_loc = rows_.data();
  mumps_.jcn_loc = columns_.data();
  // It only reads them.
  mumps_.a_loc = part.count > 0 ? const_cast<double*>(part.values) + part.starts[0] : nullptr;
  mumps_.perm_in = places_.data();
  return true;
} catch (const std::bad_alloc&) {
  return false;
}

bool MumpsFactor::make() {
  const bool is_made = run(kAnalyse) && factorise() && is_positive_definite() && find_variables();
  mumps_.irn_loc = mumps_.jcn_loc = mumps_.perm_in = nullptr;
  mumps_.a_loc = nullptr;
  for (std::vector<int>* list : {&rows_, &columns_, &places_}) std::vector<int>().swap(*list);
  return is_made;
}

/// Room for the factor and for fronts that wait. MUMPS itself would keep all of it.
bool MumpsFactor::set_aside(double numbers) {
  const double millions = std::ceil(numbers / kMillion);
  constexpr double kMost = std::numeric_limits<int>::max();
  int is_there = millions < kMost && workspace_.set_aside(static_cast<std::size_t>(numbers));
  MPI_Allreduce(MPI_IN_PLACE, &is_there, 1, MPI_INT, MPI_MIN, comm_);
  if (is_there == 0) {
    set_reason("there is too little memory for the factor");
    return false;
  }
  mumps_.wk_user = workspace_.data();
  mumps_.lwk_user = static_cast<int>(numbers <= kMost ? numbers : -std::floor(numbers / kMillion));
  return true;
}

/// Fronts that wait grow down from the end of what was set aside, the factor up from its beginning,
/// and the end is what waits no longer: so the less there is, the less of it was ever written to.
/// MUMPS moves fronts without room elsewhere, but needs it for the one that it works on.
double MumpsFactor::numbers_at_first() const {
  const double share = number_of_processes() == 2 ? kShareOfTwo : 1.0;
  constexpr double kAdded = 1.0 + kRelaxation / 100.0;
  const double all = number(mumps_.info[8 - 1]) / kAdded;
  const double fronts = number(mumps_.info[20 - 1]) / kAdded;
  return std::ceil(std::min(all, number(mumps_.info[3 - 1]) + share * fronts) + kMillion / 8);
}

bool MumpsFactor::factorise() {
  give_memory_back();  // of the analysis and of what came before
  const double predicted = number(mumps_.info[8 - 1]);
  double numbers = numbers_at_first();
  for (const double* margin = kMargins;; ++margin) {
    if (!set_aside(numbers)) return false;
    if (run(kFactorise)) break;
    if (!is_among(mumps_.infog[0], kNarrow) || margin == std::end(kMargins)) return false;
    numbers = std::ceil(*margin * predicted) + kMillion;
  }
  // Where the factor ends: KEEP8(31). Its solves need hardly more.
  workspace_.keep(static_cast<std::size_t>(mumps_.keep8[31 - 1]));
  return true;
}

/// It does not stop at negative pivots, but counts them: INFOG(12).
bool MumpsFactor::is_positive_definite() {
  if (mumps_.infog[12 - 1] == 0) return true;
  set_reason(kNegativePivot);
  return false;
}

/// Right-hand sides go where their rows of the factor are, so that MUMPS need not send them on.
bool MumpsFactor::find_variables() {
  const int count = mumps_.info[23 - 1];
  right_.resize(static_cast<std::size_t>(std::max(1, count)));
  answer_.resize(right_.size());
  mumps_.nrhs = 1;
  mumps_.nloc_rhs = mumps_.lrhs_loc = mumps_.lsol_loc = count;
  mumps_.irhs_loc = right_.data();
  mumps_.isol_loc = answer_.data();
  if (!run(kPlaces)) return false;
  variables_.assign(right_.begin(), right_.begin() + count);
  for (int& variable : variables_) --variable;
  return true;
}

bool MumpsFactor::solve(const double* b, double* x) {
  mumps_.rhs_loc = const_cast<double*>(b);  // it only reads them
  mumps_.sol_loc = x;
  if (!run(kSolve)) return false;
  if (std::equal(variables_.begin(), variables_.end(), answer_.begin(),
                 [](int a, int b_) { return a + 1 == b_; })) {
    return true;
  }
  set_reason("MUMPS has given the answer in another order than that of the right-hand side");
  return false;
}

double MumpsFactor::entries() const { return number(mumps_.infog[29 - 1]); }

}  // namespace buckens_petsc
