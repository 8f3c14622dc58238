// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What a plug-in with a multigrid solver offers: C types only, so that its libraries stay outside
/// of everything else. The source of such a plug-in includes this header and nothing else of
/// Buckens.
extern "C" {

/// Rises with every change of what stands here.
enum { kBuckensGridVersion = 13 };

/// Products that one order may ask for.
enum { kBuckensMostProducts = 8 };

/// Some columns of a matrix.
struct BuckensGridColumns {
  const int* starts;  ///< one more than columns, from 0
  const int* rows;    ///< ascending within a column
  const double* values;
};

/// A symmetric positive definite matrix by columns: whole, or some columns at a time.
struct BuckensGridMatrix {
  int size;
  /// All columns. They must live as long as the solver if one process has it. Not read if `give`
  /// is set.
  BuckensGridColumns all;
  /// Null, or gives columns `first` to `end` − 1, which live until the next call; null for them
  /// gives the memory back. Only for solvers that several processes share.
  void (*give)(void* source, int first, int end, BuckensGridColumns* columns);
  void* source;
  int block;              ///< variables per node, 1 where it varies
  int num_motions;        ///< rigid motions
  const double* motions;  ///< size × num_motions, by columns
  const char* options;    ///< of the library, in its own words; null or empty: none
  /// Null, or the variable at each place of an order of elimination. Then a factor is made, for
  /// which `give` gives the lower triangle only, and neither motions nor options are read. Only for
  /// solvers that several processes share.
  const int* order;
  /// Numbers and weights of divided matrices of which this one is the sum; null: columns are given.
  /// Only for factors.
  const int* terms;
  const double* weights;
  int num_terms;
  /// Null, or gets whether no factor was made because the matrix is not positive definite.
  int* is_indefinite;
};

/// When an iteration may stop: ‖r‖ ≤ clamp(absolute, least ‖r₀‖, most ‖r₀‖), in the norm of the
/// preconditioner, which is about the energy of the error.
struct BuckensGridLimits {
  double absolute, least, most;
  int most_iterations;
};

struct BuckensGridOutcome {
  int iterations;
  double first, last;  ///< ‖r₀‖, ‖r‖
  int has_converged;
};

/// What the first process has sent to the others and received from them, without what the library
/// exchanges while it makes a solver or solves.
struct BuckensGridTraffic {
  long messages;
  double bytes;
};

/// What there is to know of a divided symmetric matrix without its entries.
struct BuckensGridFacts {
  long entries;        ///< of both triangles
  double square_norm;  ///< the sum of the squares of all entries
  unsigned long long content[2];
};

/// Says what columns `first` to `end` - 1 of a matrix are made of, in bytes that live until the
/// next call. @return not zero if memory is too small
struct BuckensGridDescription {
  int (*describe)(void* source, int first, int end, const void** bytes, long* count);
  void* source;
};

/// Which rows of matrices and vectors the processes other than the first have, and which variables
/// these are.
struct BuckensGridRows {
  const int* first;      ///< rows of these processes, and the end; null: runs of equal length
  const int* variables;  ///< of each row; null: the same numbers
};

/// The elements of a mesh by their nodes.
struct BuckensGridMesh {
  int num_nodes;
  const int* weights;  ///< of the nodes
  long num_elements;
  const long* starts;  ///< one more than elements, from 0
  const int* nodes;
};

/// How a process that has rows of vectors reaches the others that have some.
struct BuckensGridPeers {
  /// Gives numbers to each of these processes and takes some from each, one after the other, itself
  /// included.
  void (*exchange)(void* context, const int* out_counts, const double* out, const int* in_counts,
                   double* in);
  /// y = A x of a divided symmetric matrix, given and returned by the rows of each; all call it
  /// together. @return not zero if memory is too small
  int (*multiply)(void* context, int matrix, const double* x, double* y);
  /// y = A x of the rows here of a matrix of rows, by those of a vector of the body `number`; all
  /// call it together. `y` lives until the next product.
  /// @param is_new whether they have not multiplied vectors of this body by it before; then, and
  /// only then, `rows` is read: rows of the vector for the columns of A; null: the same numbers
  /// @return not zero if memory is too small
  int (*multiply_rows)(void* context, int matrix, int number, int is_new, const int* rows,
                       const double* x, const double** y, int* count);
  /// The rows here of pairs that make_pairs() has made room for, each one behind the other.
  void (*pairs)(void* context, int number, float** loads, float** answers);
  void* context;
};

/// What the program does in the processes other than the first.
struct BuckensGridMaker {
  /// Columns `first` to `end` - 1 of a matrix, of a symmetric one from the diagonal on, of what
  /// describe() says; they live until the next call. Null for them gives the memory back.
  int (*make)(const void* bytes, long count, int first, int end, BuckensGridColumns* columns,
              char* error, int error_size);
  /// Adds a number for these entries of one triangle to `content`. The order of sums does not
  /// count, nor which triangle they are of. @param variables of the columns, and of what `rows`
  /// count
  void (*add_content)(int count, const BuckensGridColumns* columns, const int* variables,
                      unsigned long long* content);
  /// Takes note of what belongs to its rows of the vectors of a body, as described.
  int (*begin_rows)(int number, const void* bytes, long count, char* error, int error_size);
  void (*end_rows)(int number);
  /// Does what a program of the first process says. `sums` live until the next call.
  int (*work_rows)(const void* program, long count, const BuckensGridPeers* peers,
                   const double** sums, long* num_sums, char* error, int error_size);
  /// Where its rows of a vector are, which gets room if it has none; null if memory is too small.
  double* (*rows)(int number, int vector);
};

/// The lowest pairs of K x = lambda M x, as the largest theta = 1 / (lambda + shift) of
/// M x = theta A x with A = K + shift M, of which there is a factor.
struct BuckensGridModes {
  int stiffness, mass;  ///< numbers of divided matrices
  double shift;
  /// Of an answer ||A^-1 M x - theta x||_M / theta at most, which is about the error of x.
  double tolerance;
  int count;
  int num_motions;        ///< rigid motions, which are left out
  const double* motions;  ///< size x num_motions, by columns, M-orthonormal
  double* theta;          ///< gets `found` numbers, largest first
  double* shapes;         ///< size x count, by columns; gets `found` ones, M-orthonormal
  int found;              ///< fewer than `count` if the iteration did not converge
  int restarts;
  long solves;
};

/// Functions that fail return null or not zero and write why into `error`.
struct BuckensGridPlugin {
  int version;
  const char* (*name)();
  void* (*make)(const BuckensGridMatrix* matrix, char* error, int error_size);
  /// x: an estimate, then the answer.
  int (*solve)(void* solver, const double* b, double* x, const BuckensGridLimits* limits,
               BuckensGridOutcome* outcome, char* error, int error_size);
  /// Bytes held by the solver, without the arrays of its matrix.
  double (*bytes)(void* solver);
  void (*release)(void* solver);
  /// Begins MPI and tells which of how many processes this one is. From then on solvers are shared
  /// by all.
  void (*join)(int* rank, int* count);
  /// Of all processes but the first: takes part in its solves, until it leaves.
  void (*serve)(const BuckensGridMaker* maker);
  /// Of the first: ends the others and MPI, when no solver is left.
  void (*leave)();
  /// Of the first: zeros where nothing is shared.
  void (*traffic)(BuckensGridTraffic* traffic);
  /// Of the first: gives all columns of a symmetric matrix to the other processes, which multiply
  /// by them from then on. Only where there are others. @return its number, -1 after an error
  /// @param all in the order of `of`
  int (*divide)(int size, const BuckensGridRows* of, const BuckensGridColumns* all,
                BuckensGridFacts* facts, char* error, int error_size);
  /// The same of a matrix of any shape: `all` are its rows, with columns in place of `rows`. It
  /// cannot be gathered, nor be a term of a sum.
  int (*divide_rows)(int rows, int columns, const BuckensGridColumns* all, char* error,
                     int error_size);
  /// The same of a matrix whose rows the other processes make: columns for the maker.
  /// @param runs of the rows
  int (*make_rows)(int rows, int columns, const BuckensGridRows* runs,
                   const BuckensGridDescription* of, char* error, int error_size);
  /// As divide(), of a symmetric matrix whose columns the other processes make.
  int (*make_columns)(int size, const BuckensGridRows* rows, const BuckensGridDescription* of,
                      BuckensGridFacts* facts, char* error, int error_size);
  /// As divide(), of a sum of divided matrices of the same rows.
  int (*add_up)(int count, const int* terms, const double* weights, const BuckensGridRows* rows,
                BuckensGridFacts* facts, char* error, int error_size);
  /// y_k = A_k x_k of divided matrices by one order, at most kBuckensMostProducts.
  void (*multiply)(int count, const int* matrices, const double* const* x, double* const* y);
  /// The sum of the products of all entries of two sums of divided matrices.
  double (*inner_product)(int count, const int* terms, const double* a, const double* b);
  void (*diagonal)(int matrix, double* values);
  /// Of each column of a symmetric matrix so many entries from the diagonal on, column after
  /// column; zeros where there are none.
  void (*near_diagonal)(int matrix, const int* lengths, double* values);
  /// A number for the rows that have an entry, of each column of a sum of divided matrices: the
  /// same for columns with the same rows, and hardly ever otherwise.
  int (*marks)(int count, const int* terms, unsigned long long* marks, char* error, int error_size);
  /// Of such a sum the pairs of different vertices that an entry joins, given the vertex of each
  /// column; each at least once. They live until the next call, and null for them gives the memory
  /// back.
  int (*edges)(int count, const int* terms, const int* vertex, long* num_edges, const int** pairs,
               char* error, int error_size);
  /// Brings all columns back into arrays of their length; the processes keep theirs.
  void (*gather)(int matrix, int* starts, int* rows, double* values);
  /// The others give the memory of a divided matrix, of pairs, or of rows of vectors back.
  void (*forget)(int number);
  /// Of the first: room for `most` pairs of vectors, a load and an answer, of which the other
  /// processes have the rows. Only where there are others. @return its number, -1 after an error
  int (*make_pairs)(int size, const BuckensGridRows* rows, int most, char* error, int error_size);
  /// along_i = c_i r and r = r - sum of along_i c_i, over the loads c_i of the first pairs; r is
  /// then rounded to single precision.
  /// @return the square of the norm of r
  double (*project)(int number, int pairs, double* r, double* along);
  /// The sum of weights_i x_i over the answers x_i of the first pairs.
  void (*combine)(int number, int pairs, const double* weights, double* sum);
  void (*put_pair)(int number, int pair, const float* load, const float* answer);
  void (*take_pair)(int number, int pair, float* load, float* answer);
  /// First rows of the other processes, and the end, where they have runs of equal length: as many
  /// numbers as there are processes.
  void (*runs)(int size, int* first);
  /// Of the first: what belongs to the rows of each process of the vectors of a body.
  /// @return its number, -1 after an error; forget() ends it
  int (*begin_rows)(int size, const BuckensGridRows* rows, const BuckensGridDescription* of,
                    char* error, int error_size);
  /// Has the others work on their rows. @param sums of each, one process after the other
  int (*work_rows)(const void* program, long count, int sums_each, double* sums, char* error,
                   int error_size);
  int (*put_rows)(int number, int vector, const double* values, char* error, int error_size);
  void (*take_rows)(int number, int vector, double* values);
  /// x = A^-1 b by a solver that make() made of a factor, b and x vectors of the others.
  int (*solve_rows)(void* solver, int number, int b, int x, char* error, int error_size);
  /// Of the first: divides the nodes of a mesh among the other processes, so that few elements have
  /// nodes of several. @param part gets the place of one of these processes, from 0, for each node
  int (*partition)(const BuckensGridMesh* mesh, int* part, char* error, int error_size);
  /// By a solver that make() made of a factor of K + shift M. The others have all vectors.
  int (*find_modes)(void* solver, BuckensGridModes* modes, char* error, int error_size);
};

/// The one function that a plug-in exports.
typedef const BuckensGridPlugin* (*BuckensFindGridPlugin)();
}
