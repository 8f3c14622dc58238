// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <mpi.h>

#include "buckens/linalg/grid_plugin.h"

namespace buckens_petsc {

enum class Task : int;
class MumpsFactor;
struct SomeElements;
struct MeshShare;
struct ModeProblem;

/// The processes that mpirun started, of which the first simulates and the others serve its solves:
/// they hold runs of rows of each matrix and of its factor, and wait for work.
///
/// The first process says what is to be done (Order), then all do it together.
class Ranks {
 public:
  /// Begins MPI. Once, before anything else of PETSc.
  static Ranks& join();
  /// The one that join() made; null before.
  static Ranks* joined();

  int rank() const { return rank_; }
  int count() const { return count_; }

  /// Of the others: does what the first says until that leaves.
  void serve(const BuckensGridMaker& maker);
  /// Of the first: lets the others end, and ends MPI.
  void leave();

  /// Of the first: a solver that all have a part of.
  /// @return number of the solver, −1 after an error, which take_reason() tells
  int make(const BuckensGridMatrix& matrix);
  /// @return whether it was possible; otherwise take_reason() tells why not
  bool solve(int number, const double* b, double* x, const BuckensGridLimits& limits,
             BuckensGridOutcome& outcome);
  double bytes(int number);
  void release(int number);
  /// Of the first: gives a matrix to the others. @return its number, −1 as make()
  int divide(int size, const BuckensGridRows& of, const BuckensGridColumns& all,
             BuckensGridFacts& facts);
  /// The same of one that the others make.
  int make_columns(int size, const BuckensGridRows& rows, const BuckensGridDescription& of,
                   BuckensGridFacts& facts);
  /// The same of a sum of such matrices.
  int add_up(int count, const int* terms, const double* weights, const BuckensGridRows& rows,
             BuckensGridFacts& facts);
  /// The same of a matrix of any shape, given by rows.
  int divide_rows(int rows, int columns, const BuckensGridColumns& all);
  /// The same of one whose rows the others make.
  int make_rows(int rows, int columns, const BuckensGridRows& runs,
                const BuckensGridDescription& of);
  /// y_k = A_k x_k
  void multiply(int count, const int* matrices, const double* const* x, double* const* y);
  /// Of the first: see BuckensGridPlugin.
  double inner_product(int count, const int* terms, const double* a, const double* b);
  void diagonal(int matrix, double* values);
  void near_diagonal(int matrix, const int* lengths, double* values);
  bool marks(int count, const int* terms, unsigned long long* marks);
  /// @return pairs, which live until the next call; null after an error
  const std::vector<int>* edges(int count, const int* terms, const int* vertex);
  void forget_edges();
  void gather(int matrix, int* starts, int* rows, double* values);
  void forget(int matrix);
  /// Of the first: room for pairs of vectors of so many rows. @return its number, −1 as make()
  int make_pairs(int size, const BuckensGridRows& rows, int most);
  /// @return ‖r‖²
  double project(int number, int pairs, double* r, double* along);
  void combine(int number, int pairs, const double* weights, double* sum);
  void put_pair(int number, int pair, const float* load, const float* answer);
  void take_pair(int number, int pair, float* load, float* answer);
  /// First rows of the others, and the end.
  void runs(int size, int* first) const;
  /// Of the first: see BuckensGridPlugin.
  int begin_rows(int size, const BuckensGridRows& rows, const BuckensGridDescription& of);
  bool work_rows(const void* program, long count, int sums_each, double* sums);
  bool put_rows(int number, int vector, const double* values);
  void take_rows(int number, int vector, double* values);
  bool solve_rows(int solver, int number, int b, int x);
  /// Of the first: see BuckensGridPlugin.
  bool partition(const BuckensGridMesh& mesh, int* part);
  bool find_modes(int solver, BuckensGridModes& modes);
  /// Of the first: so far.
  BuckensGridTraffic traffic() const { return traffic_; }

 private:
  struct Order;
  struct Part;
  struct Shared;
  struct OwnRows;
  struct Divided;
  struct Pairs;
  struct Way;
  struct Runs;

  Ranks();
  void end_here();
  void give(const Order& order);
  void give(Task task, int number = 0);
  /// Gives an order to make something new, and returns it with its number.
  /// @param of which rows the others have; null: runs of equal length
  Order give_new(Task task, int rows, int columns = 0, const BuckensGridRows* of = nullptr);
  Order wait_for_order();
  void count_messages(int messages, double bytes_each);
  template <class T>
  void send_counted(const T* values, std::size_t count, int to);
  std::unique_ptr<Part> divide(const Order& order) const;
  bool send_rows(const Part& part, const BuckensGridMatrix& matrix, OwnRows& own);
  bool receive_rows(int count, int num_motions, OwnRows& own);
  bool make_together(const Order& order, const BuckensGridMatrix* matrix);
  bool factorise_together(const Order& order, const BuckensGridMatrix* matrix);
  bool make_with_room(MumpsFactor& factor);
  void find_places(int size, Part& part);
  bool sum_terms(const Order& order, const double* of_terms, OwnRows& own);
  std::vector<const Divided*> terms_of(const Order& order) const;
  std::vector<int> agreed_runs(const Order& order, const BuckensGridRows* of);
  std::unique_ptr<Divided> empty_division(const Order& order, const BuckensGridRows* of);
  bool agree_on_variables(const Order& order, const BuckensGridRows* of, const Divided& matrix,
                          std::vector<int>& own);
  bool divide_together(const Order& order, const BuckensGridRows* of, const BuckensGridColumns* all,
                       BuckensGridFacts& facts);
  bool make_columns_together(const Order& order, const BuckensGridRows* rows,
                             const BuckensGridDescription* of, BuckensGridFacts& facts);
  bool send_descriptions(const std::vector<int>& first, const BuckensGridDescription& of);
  bool receive_description(std::vector<char>& description);
  template <class Visitor>
  bool make_some(const std::vector<char>& description, int first, int end, Visitor&& visit);
  bool make_rows_of(const std::vector<char>& description, int columns, Divided& matrix);
  bool make_columns_of(const std::vector<char>& description, const Divided& matrix, OwnRows& made);
  bool add_up_together(const Order& order, const double* weights, const BuckensGridRows* of,
                       BuckensGridFacts& facts);
  bool keep(const Order& order, const BuckensGridRows* of, std::unique_ptr<Divided> matrix,
            OwnRows& own, BuckensGridFacts& facts);
  void sum_facts(const OwnRows& columns, const std::vector<int>& variables,
                 BuckensGridFacts& facts);
  double inner_product_together(const Order& order, const double* a, const double* b);
  void diagonal_together(const Order& order, double* values);
  void near_diagonal_together(const Order& order, const int* lengths, double* values);
  bool marks_together(const Order& order, unsigned long long* marks);
  bool edges_together(const Order& order, const int* vertex);
  void exchange_columns(const BuckensGridColumns* all, const Divided& matrix, OwnRows& own);
  void exchange_lists(Divided& matrix);
  void multiply_together(const Order& order, const double* const* x, double* const* y);
  void ask_for_products(const std::vector<const Divided*>& matrices, const double* const* x,
                        double* const* y);
  static void add_share(const std::vector<const Divided*>& matrices, int process,
                        const double* from, double* const* y);
  void form_products(const std::vector<const Divided*>& matrices);
  void put_triangles_together(const Divided& matrix, const std::vector<OwnRows>& parts, int* starts,
                              int* rows, double* values);
  void gather_together(const Order& order, int* starts, int* rows, double* values);
  bool solve_together(const Order& order, const double* b, double* x, BuckensGridOutcome& outcome);
  void serve_matrices(const Order& order);
  void give_pairs(Task task, int number, int count);
  void serve_pairs(const Order& order);
  bool make_pairs_together(const Order& order, const BuckensGridRows* of);
  template <class T>
  void scatter(const Pairs& pairs, const T* whole, T* here);
  template <class T>
  void gather(const Pairs& pairs, const T* here, T* whole);
  void sum_in_order(std::vector<double>& values);
  double project_together(Pairs& own, int pairs, double* r, double* along);
  void combine_together(Pairs& own, int pairs, const double* weights, double* sum);
  void put_pair_together(Pairs& own, int pair, const float* load, const float* answer);
  void take_pair_together(Pairs& own, int pair, float* load, float* answer);
  void forget_here(int number);
  void serve_rows(const Order& order);
  bool begin_rows_together(const Order& order, const BuckensGridRows* rows,
                           const BuckensGridDescription* of);
  bool work_rows_together(const Order& order, const void* program, double* sums);
  bool receive_sums(std::size_t each, double* sums);
  bool put_rows_together(const Order& order, const double* values);
  void take_rows_together(const Order& order, double* values);
  bool solve_rows_together(const Order& order);
  bool solve_by(Part& part, Way& way, const double* b, double* x);
  bool partition_together(const Order& order, const BuckensGridMesh* mesh, int* part);
  bool send_mesh(const BuckensGridMesh& mesh, const std::vector<int>& first);
  bool receive_mesh(int nodes, SomeElements& elements, MeshShare& own);
  bool share_mesh(const std::vector<int>& first, const SomeElements& elements, MeshShare& own);
  bool find_modes_together(const Order& order, BuckensGridModes* modes);
  bool have_all_failed();
  bool has_room_for_modes(const Order& order, const BuckensGridModes& modes);
  std::vector<double> share_motions(const Divided& M, const BuckensGridModes& modes,
                                    const double* all);
  void describe_modes(const Order& order, const BuckensGridModes& modes, Way& way,
                      std::vector<double>& inertia, ModeProblem& problem);
  void multiply_among_others(int matrix, const double* x, double* y);
  void multiply_rows_among_others(Divided& A, const double* x);
  static void exchange_numbers(void* context, const int* out_counts, const double* out,
                               const int* in_counts, double* in);
  static int multiply_here(void* context, int matrix, const double* x, double* y);
  static int multiply_rows_here(void* context, int matrix, int number, int is_new, const int* rows,
                                const double* x, const double** y, int* count);
  static void find_pairs(void* context, int number, float** loads, float** answers);
  bool has_failed_somewhere(bool has_failed);

  MPI_Comm orders_ = MPI_COMM_NULL, work_ = MPI_COMM_NULL;
  MPI_Comm others_ = MPI_COMM_NULL;  // of those who serve
  int rank_ = 0, count_ = 1;
  int next_ = 0;
  BuckensGridMaker maker_{};  // of the others
  BuckensGridTraffic traffic_{};
  std::unique_ptr<Shared> shared_;
};

}  // namespace buckens_petsc
