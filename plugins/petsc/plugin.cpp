// SPDX-License-Identifier: Apache-2.0
// What Buckens asks of this plug-in, in C.
//
// MPI and MUMPS come with it, and PETSc by a library of its own: so it is loaded by those runs only
// that ask for it, and nothing else links it.
#include <cstdio>
#include <memory>
#include <string>

#include <petscversion.h>

#include "ranks.h"
#include "reasons.h"
#include "solver_library.h"

namespace {

using namespace buckens_petsc;

/// A solver of this process, or the number of one that all processes share.
struct Handle {
  std::unique_ptr<LoadedSolver> own;
  int number = -1;
};

/// Null in a process by itself.
Ranks* ranks() {
  Ranks* joined = Ranks::joined();
  return joined != nullptr && joined->count() > 1 ? joined : nullptr;
}

const char* plugin_name() {
  static char text[64];
  std::snprintf(text, sizeof text, "PETSc %d.%d.%d", PETSC_VERSION_MAJOR, PETSC_VERSION_MINOR,
                PETSC_VERSION_SUBMINOR);
  return text;
}

bool make(const BuckensGridMatrix& matrix, Handle& handle) {
  if (ranks() != nullptr) {
    handle.number = ranks()->make(matrix);
    return handle.number >= 0;
  }
  const SolverLibrary* library = solver_library();
  if (library == nullptr) return false;
  Rows rows;
  rows.size = rows.count = rows.stride = matrix.size;
  rows.starts = matrix.all.starts;
  rows.columns = matrix.all.rows;
  rows.values = matrix.all.values;
  rows.block = matrix.block;
  rows.num_motions = matrix.num_motions;
  rows.motions = matrix.motions;
  rows.options = matrix.options;
  std::string reason;
  handle.own.reset(library->make(nullptr, rows, reason));
  if (handle.own == nullptr) set_reason(reason);
  return handle.own != nullptr;
}

void* plugin_make(const BuckensGridMatrix* matrix, char* error, int error_size) {
  auto* handle = new Handle;
  if (make(*matrix, *handle)) return handle;
  fail(error, error_size);
  delete handle;
  return nullptr;
}

int plugin_solve(void* solver, const double* b, double* x, const BuckensGridLimits* limits,
                 BuckensGridOutcome* outcome, char* error, int error_size) {
  auto& handle = *static_cast<Handle*>(solver);
  if (handle.number >= 0) {
    const bool is_solved = ranks()->solve(handle.number, b, x, *limits, *outcome);
    return is_solved ? 0 : fail(error, error_size);
  }
  std::string reason;
  if (handle.own->solve(b, x, *limits, *outcome, reason)) return 0;
  set_reason(reason);
  return fail(error, error_size);
}

double plugin_bytes(void* solver) {
  const auto& handle = *static_cast<Handle*>(solver);
  return handle.number >= 0 ? ranks()->bytes(handle.number) : handle.own->bytes();
}

void plugin_release(void* solver) {
  auto* handle = static_cast<Handle*>(solver);
  if (handle->number >= 0 && ranks() != nullptr) ranks()->release(handle->number);
  delete handle;
}

void plugin_join(int* rank, int* count) {
  *rank = Ranks::join().rank();
  *count = Ranks::join().count();
}

void plugin_serve(const BuckensGridMaker* maker) { Ranks::join().serve(*maker); }

void plugin_leave() { Ranks::join().leave(); }

void plugin_traffic(BuckensGridTraffic* traffic) {
  *traffic = ranks() != nullptr ? ranks()->traffic() : BuckensGridTraffic{};
}

/// A matrix of the others. @param make (ranks) → its number
template <class Make>
int number_of(char* error, int error_size, Make&& make) {
  if (ranks() == nullptr) set_reason("there are no other processes");
  const int number = ranks() != nullptr ? make(*ranks()) : -1;
  if (number < 0) fail(error, error_size);
  return number;
}

int plugin_divide(int size, const BuckensGridRows* of, const BuckensGridColumns* all,
                  BuckensGridFacts* facts, char* error, int error_size) {
  return number_of(error, error_size,
                   [&](Ranks& all_of_them) { return all_of_them.divide(size, *of, *all, *facts); });
}

int plugin_divide_rows(int rows, int columns, const BuckensGridColumns* all, char* error,
                       int error_size) {
  return number_of(error, error_size, [&](Ranks& all_of_them) {
    return all_of_them.divide_rows(rows, columns, *all);
  });
}

int plugin_make_rows(int rows, int columns, const BuckensGridRows* runs,
                     const BuckensGridDescription* of, char* error, int error_size) {
  return number_of(error, error_size, [&](Ranks& all_of_them) {
    return all_of_them.make_rows(rows, columns, *runs, *of);
  });
}

int plugin_make_columns(int size, const BuckensGridRows* rows, const BuckensGridDescription* of,
                        BuckensGridFacts* facts, char* error, int error_size) {
  return number_of(error, error_size, [&](Ranks& all_of_them) {
    return all_of_them.make_columns(size, *rows, *of, *facts);
  });
}

int plugin_add_up(int count, const int* terms, const double* weights, const BuckensGridRows* rows,
                  BuckensGridFacts* facts, char* error, int error_size) {
  return number_of(error, error_size, [&](Ranks& all_of_them) {
    return all_of_them.add_up(count, terms, weights, *rows, *facts);
  });
}

double plugin_inner_product(int count, const int* terms, const double* a, const double* b) {
  return ranks()->inner_product(count, terms, a, b);
}

void plugin_diagonal(int matrix, double* values) { ranks()->diagonal(matrix, values); }

void plugin_near_diagonal(int matrix, const int* lengths, double* values) {
  ranks()->near_diagonal(matrix, lengths, values);
}

int plugin_marks(int count, const int* terms, unsigned long long* marks, char* error,
                 int error_size) {
  return ranks()->marks(count, terms, marks) ? 0 : fail(error, error_size);
}

int plugin_edges(int count, const int* terms, const int* vertex, long* num_edges, const int** pairs,
                 char* error, int error_size) {
  if (pairs == nullptr) {
    ranks()->forget_edges();
    return 0;
  }
  const std::vector<int>* found = ranks()->edges(count, terms, vertex);
  if (found == nullptr) return fail(error, error_size);
  *num_edges = static_cast<long>(found->size() / 2);
  *pairs = found->data();
  return 0;
}

void plugin_multiply(int count, const int* matrices, const double* const* x, double* const* y) {
  ranks()->multiply(count, matrices, x, y);
}

void plugin_gather(int matrix, int* starts, int* rows, double* values) {
  ranks()->gather(matrix, starts, rows, values);
}

void plugin_forget(int matrix) {
  if (ranks() != nullptr) ranks()->forget(matrix);
}

int plugin_make_pairs(int size, const BuckensGridRows* rows, int most, char* error,
                      int error_size) {
  return number_of(error, error_size,
                   [&](Ranks& all_of_them) { return all_of_them.make_pairs(size, *rows, most); });
}

double plugin_project(int number, int pairs, double* r, double* along) {
  return ranks()->project(number, pairs, r, along);
}

void plugin_combine(int number, int pairs, const double* weights, double* sum) {
  ranks()->combine(number, pairs, weights, sum);
}

void plugin_put_pair(int number, int pair, const float* load, const float* answer) {
  ranks()->put_pair(number, pair, load, answer);
}

void plugin_take_pair(int number, int pair, float* load, float* answer) {
  ranks()->take_pair(number, pair, load, answer);
}

void plugin_runs(int size, int* first) { ranks()->runs(size, first); }

int plugin_begin_rows(int size, const BuckensGridRows* rows, const BuckensGridDescription* of,
                      char* error, int error_size) {
  return number_of(error, error_size,
                   [&](Ranks& all_of_them) { return all_of_them.begin_rows(size, *rows, *of); });
}

int plugin_work_rows(const void* program, long count, int sums_each, double* sums, char* error,
                     int error_size) {
  return ranks()->work_rows(program, count, sums_each, sums) ? 0 : fail(error, error_size);
}

int plugin_put_rows(int number, int vector, const double* values, char* error, int error_size) {
  return ranks()->put_rows(number, vector, values) ? 0 : fail(error, error_size);
}

void plugin_take_rows(int number, int vector, double* values) {
  ranks()->take_rows(number, vector, values);
}

int plugin_solve_rows(void* solver, int number, int b, int x, char* error, int error_size) {
  const int of_solver = static_cast<Handle*>(solver)->number;
  return ranks()->solve_rows(of_solver, number, b, x) ? 0 : fail(error, error_size);
}

int plugin_partition(const BuckensGridMesh* mesh, int* part, char* error, int error_size) {
  return ranks()->partition(*mesh, part) ? 0 : fail(error, error_size);
}

int plugin_find_modes(void* solver, BuckensGridModes* modes, char* error, int error_size) {
  const int of_solver = static_cast<Handle*>(solver)->number;
  return ranks()->find_modes(of_solver, *modes) ? 0 : fail(error, error_size);
}

const BuckensGridPlugin plugin = {
    kBuckensGridVersion,  plugin_name,         plugin_make,          plugin_solve,
    plugin_bytes,         plugin_release,      plugin_join,          plugin_serve,
    plugin_leave,         plugin_traffic,      plugin_divide,        plugin_divide_rows,
    plugin_make_rows,     plugin_make_columns, plugin_add_up,        plugin_multiply,
    plugin_inner_product, plugin_diagonal,     plugin_near_diagonal, plugin_marks,
    plugin_edges,         plugin_gather,       plugin_forget,        plugin_make_pairs,
    plugin_project,       plugin_combine,      plugin_put_pair,      plugin_take_pair,
    plugin_runs,          plugin_begin_rows,   plugin_work_rows,     plugin_put_rows,
    plugin_take_rows,     plugin_solve_rows,   plugin_partition,     plugin_find_modes};

}  // namespace

extern "C" __attribute__((visibility("default"))) const BuckensGridPlugin* buckens_grid_plugin() {
  return &plugin;
}
