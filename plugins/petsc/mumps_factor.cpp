// SPDX-License-Identifier: Apache-2.0
#include "mumps_factor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <string>

#include "factor_room.h"
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
constexpr int kNarrowArray = -9;
constexpr int kRelaxation = 20;  // what MUMPS adds to its predictions [%]
// Added to predictions without it for the first try, in the order of what lacked in cubes of solids
// on four processes, 0.3 to 2 % of an array.
constexpr double kAddedAtFirst = 0.02;
// Share of the predicted fronts for which the first try has room on two processes; what has no room
// there goes elsewhere. On four, half was too little for 292 008 variables.
constexpr double kShareOfTwo = 0.5;

template <int count>
bool is_among(int code, const int (&codes)[count]) {
  return std::find(codes, codes + count, code) != codes + count;
}

// Short beside a factorisation that needs the memory, and long beside letting pages go. Entries
// are read once; columns of the factor are not read again until it is made, but fronts are: their
// pages come back when they are needed next. So those of the room go only when this share of it is
// in memory, which is soon looked up, since a front can grow fast.
constexpr std::chrono::milliseconds kEntriesGo{50}, kRoomIsLookedAt{5};
constexpr std::size_t kShareInMemory = 4;

constexpr const char* kNegativePivot = "the matrix is not positive definite";
constexpr int kNarrowFront = 2;
// Subtrees of the elimination that one process works on alone may differ in work by so much [%].
// With more of a difference they are larger, and so are their fronts, of which one process has all.
// On two processes that makes their largest part larger.
constexpr int kEvenSubtrees = 100;
constexpr double kMillion = 1e6;
/// Numbers that MUMPS gives in millions where they are large.
double number(int value) { return value < 0 ? -kMillion * value : value; }

std::size_t bytes_of(double numbers) { return static_cast<std::size_t>(numbers) * sizeof(double); }

struct Triplets {
  double* values;
  int *rows, *columns;
};
/// One after the other.
Triplets triplets(char* from, std::size_t count) {
  auto* values = reinterpret_cast<double*>(from);
  auto* rows = reinterpret_cast<int*>(values + count);
  return {values, rows, rows + count};
}

}  // namespace

MumpsFactor::MumpsFactor(MPI_Comm comm) : comm_(comm) {
  prepare_blas();
  begin(comm);
}

/// An instance on processes in an order that need not be theirs.
void MumpsFactor::begin(MPI_Comm comm) {
  mumps_ = {};
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

MumpsFactor::~MumpsFactor() {
  (void)run(kEnd);
  if (reordered_ != MPI_COMM_NULL) MPI_Comm_free(&reordered_);
}

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
    is_indefinite_ = true;
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
  size_ = part.size;
  entries_ = part.count > 0 ? part.starts[part.count] - part.starts[0] : 0;
  // MUMPS asks for an address of nothing, too.
  const auto room = static_cast<std::size_t>(std::max(1L, entries_));
  if (!pages_.set_aside(room * (sizeof(double) + 2 * sizeof(int)))) return false;
  const Triplets to = triplets(pages_.data(), room);
  long at = 0;
  for (int k = 0; k < part.count; ++k) {
    for (int e = part.starts[k]; e < part.starts[k + 1]; ++e, ++at) {
      to.values[at] = part.values[e];
      to.rows[at] = part.rows[e] + 1;
      to.columns[at] = part.first + k + 1;
    }
  }
  if (order == nullptr) return true;
  places_.resize(static_cast<std::size_t>(size_));
  for (int k = 0; k < size_; ++k) places_[static_cast<std::size_t>(order[k])] = k + 1;
  return true;
} catch (const std::bad_alloc&) {
  return false;
}

bool MumpsFactor::analyse_entries() {
  const Triplets entries =
      triplets(pages_.data(), static_cast<std::size_t>(std::max(1L, entries_)));
  mumps_.n = size_;
  mumps_.nnz_loc = entries_;
  mumps_.irn_loc = entries.rows;
  mumps_.jcn_loc = entries.columns;
  mumps_.a_loc = entries.values;
  mumps_.perm_in = places_.data();
  return run(kAnalyse);
}

/// The place among the processes that the first should have.
int MumpsFactor::place_of_first() const {
  const double here = numbers_at_first();
  std::vector<double> all(static_cast<std::size_t>(number_of_processes()));
  MPI_Allgather(&here, 1, MPI_DOUBLE, all.data(), 1, MPI_DOUBLE, comm_);
  return lightest_place(all);
}

/// Puts the first process there for MUMPS, and the one that was there first.
/// @return whether there was enough memory
bool MumpsFactor::exchange_places(int place) {
  int rank = 0;
  MPI_Comm_rank(comm_, &rank);
  const bool exchanges = rank == 0 || rank == place;
  int has_memory = 1;
  try {
    if (exchanges) places_.resize(static_cast<std::size_t>(size_));
  } catch (const std::bad_alloc&) {
    has_memory = 0;
  }
  MPI_Allreduce(MPI_IN_PLACE, &has_memory, 1, MPI_INT, MPI_MIN, comm_);
  if (has_memory == 0) {
    set_reason("there is too little memory for the order of elimination");
    return false;
  }
  if (rank == 0) MPI_Send(places_.data(), size_, MPI_INT, place, 0, comm_);
  if (rank == place) MPI_Recv(places_.data(), size_, MPI_INT, 0, 0, comm_, MPI_STATUS_IGNORE);
  MPI_Comm_split(comm_, 0, exchanges ? place - rank : rank, &reordered_);
  (void)run(kEnd);
  begin(reordered_);
  return true;
}

/// The first process has everything else of a body, too: it gets the smallest part.
bool MumpsFactor::analyse() {
  if (!analyse_entries()) return false;
  const int place = place_of_first();
  return place == 0 || (exchange_places(place) && analyse_entries());
}

bool MumpsFactor::make() {
  bool is_made = false;
  {
    const LettingGo entries(pages_, kEntriesGo);
    is_made = analyse() && factorise() && is_positive_definite() && find_variables();
  }
  mumps_.irn_loc = mumps_.jcn_loc = mumps_.perm_in = nullptr;
  mumps_.a_loc = nullptr;
  (void)pages_.set_aside(0);
  std::vector<int>().swap(places_);
  return is_made;
}

/// Room for the factor and for fronts that wait. MUMPS itself would keep all of it.
bool MumpsFactor::set_aside(double numbers) {
  const double millions = std::ceil(numbers / kMillion);
  constexpr double kMost = std::numeric_limits<int>::max();
  int is_there = millions < kMost && room_.set_aside(bytes_of(numbers));
  MPI_Allreduce(MPI_IN_PLACE, &is_there, 1, MPI_INT, MPI_MIN, comm_);
  if (is_there == 0) {
    set_reason("there is too little memory for the factor");
    return false;
  }
  mumps_.wk_user = reinterpret_cast<double*>(room_.data());
  mumps_.lwk_user = static_cast<int>(numbers <= kMost ? numbers : -std::floor(numbers / kMillion));
  return true;
}

/// Of room in memory. Fronts that wait grow down from its end, the factor up from its beginning,
/// and the end is what waits no longer: so the less there is, the less of it was ever written to.
/// MUMPS moves fronts without room elsewhere, but needs it for the one that it works on.
double MumpsFactor::numbers_at_first() const {
  const double share = number_of_processes() == 2 ? kShareOfTwo : 1.0;
  constexpr double kAdded = 1.0 + kRelaxation / 100.0;
  const double all = number(mumps_.info[8 - 1]) / kAdded;
  const double fronts = number(mumps_.info[20 - 1]) / kAdded;
  const double least = std::min(all, number(mumps_.info[3 - 1]) + share * fronts);
  return std::ceil((1.0 + kAddedAtFirst) * least + kMillion / 8);
}

bool MumpsFactor::factorise() {
  give_memory_back();  // of the analysis and of what came before
  const double predicted = number(mumps_.info[8 - 1]);
  // Room that is not used costs nothing on a disk.
  const bool is_ample = room_.set_aside(bytes_of(predicted)) && room_.is_on_disk();
  FactorRoom room(is_ample ? predicted : numbers_at_first(), predicted);
  for (;;) {
    if (!set_aside(room.numbers())) return false;
    const LettingGo factor(room_, kRoomIsLookedAt, room_.bytes() / kShareInMemory);
    if (run(kFactorise)) break;
    const int code = mumps_.infog[0];
    if (!is_among(code, kNarrow)) return false;
    const double lacking = code == kNarrowArray ? number(mumps_.infog[1]) : 0.0;
    if (!room.grow(lacking)) return false;
  }
  // Where the factor ends: KEEP8(31). Its solves need hardly more.
  room_.bring_back(bytes_of(static_cast<double>(mumps_.keep8[31 - 1])));
  return true;
}

/// It does not stop at negative pivots, but counts them: INFOG(12).
bool MumpsFactor::is_positive_definite() {
  if (mumps_.infog[12 - 1] == 0) return true;
  is_indefinite_ = true;
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
