// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "buckens/base/saved_values.h"
#include "buckens/base/task_pool.h"
#include "buckens/linalg/kept_pairs.h"
#include "buckens/linalg/matrix_types.h"
#include "buckens/linalg/row_parts.h"
#include "buckens/linalg/row_program.h"

namespace buckens::linalg {

/// Answers x = A⁻¹ f to loads that lie in a small space, by combining answers made before.
///
/// It keeps pairs (cᵢ, xᵢ = A⁻¹ cᵢ), the cᵢ orthonormal in ‖f‖² = Σ fⱼ²/Aⱼⱼ. A load is projected on
/// them, f = Σ αᵢ cᵢ + r. If ‖r‖ is small, the answer is Σ αᵢ xᵢ; if not, r is solved for and, with
/// its answer, becomes a pair. Where no place is left, the pair least used lately goes.
///
/// Pairs are kept in single precision: cᵢ is rounded before it is solved for, so that only the
/// answer is rounded, to 6e-8 of the change that it describes. Arithmetic with them is in double
/// precision: other rounding, of several processes for instance, makes the same pairs and answers
/// but for 1e-16 of the load, unless a number is just between two of single precision.
///
/// A store that cannot answer half of what it is asked sleeps for a while. It changes by learn()
/// only, so that what was asked in vain leaves no trace. All results, and what is kept, are bitwise
/// the same with any number of threads.
///
/// Cost with m pairs: 3 m n numbers of four bytes read; 5 m n if r is solved for (6 m n of divided
/// loads).
class RecycledSolves {
 public:
  /// One load on its way to its answer.
  struct Request {
    Vector remainder;  ///< r/√A of the diagonal, later its share of a new pair
    Vector answer;     ///< √A of the diagonal times A⁻¹ r
    Vector weights;    ///< αᵢ
    enum class Fate { not_tried, answered, solved } fate = Fate::not_tried;
    /// In place of remainder and answer where other processes have the rows of the load; null:
    /// here.
    DividedVectors* of = nullptr;
    DividedVector remainder_there, answer_there;
  };
  /// A load of which other processes have the rows.
  struct DividedLoad {
    DividedVectors* of;
    DividedVector* load;
    const DividedVector* scale;  ///< 1/√Aⱼⱼ
  };

  /// @param inverse_diagonal 1/Aⱼⱼ, n
  /// @param most largest number of pairs; 0: nothing is kept
  /// @param order of the rows that other processes have
  RecycledSolves(const Vector& inverse_diagonal, int most, SharedRowOrder order = {});

  /// f ← A⁻¹ (f − r) with ‖r‖ ≤ limit and true, or f ← what is to be solved for and false: then
  /// complete() is to follow.
  bool answer(Vector& f, double limit, Request& request, TaskPool* pool = nullptr);
  bool answer(const DividedLoad& f, double limit, Request& request);
  /// x ← A⁻¹ f. @param x the answer to what answer() left
  void complete(Request& request, Vector& x, TaskPool* pool = nullptr) const;
  void complete(Request& request, const DividedLoad& x) const;
  /// Takes note of requests that were answered or completed, in this order, and keeps their pairs.
  void learn(std::span<Request* const> requests, TaskPool* pool = nullptr);
  /// As if nothing had ever been asked.
  void forget();

  int most() const { return most_; }
  /// Whether answer() tries at all.
  bool may_answer() const { return most_ > 0 && asleep_for_ == 0; }
  int num_pairs() const { return static_cast<int>(scores_.size()); }
  bool is_asleep() const { return asleep_for_ > 0; }

  /// Saves or restores the pairs and what decides on them.
  /// @throws InputError if they do not fit
  void visit_saved(const base::SaveVisit& visit);

 private:
  Eigen::Index rows() const { return scale_.size(); }
  void begin(const Vector& f, Request& request, TaskPool* pool);
  /// Takes from the remainder what lies along the pairs. @return ‖r‖
  double project(Request& request, TaskPool* pool);
  void note_use(const Request& request);
  void note_outcome(bool is_answered);
  void keep(Request& request, TaskPool* pool);
  void separate(int pair, Request& request, TaskPool* pool);
  void put(int pair, double scale, const Request& request, TaskPool* pool);
  // Of divided loads.
  RowProgram::Pairs pairs_there(int first, int count) const {
    return {pairs_->number(), first, count};
  }
  void project_divided(Request& request, RowProgram& program, const Vector& products) const;
  double norm_of_divided(const Request& request) const;
  void separate_divided(int pair, Request& request) const;
  void put_divided(int pair, double scale, const Request& request) const;
  double norm(const Request& request, TaskPool* pool);
  int free_pair();
  void visit_pair(const base::SaveVisit& visit, int pair);

  RowParts parts_;
  int most_;
  Eigen::VectorXf scale_;             // 1/√Aⱼⱼ
  std::unique_ptr<KeptPairs> pairs_;  // scaled by 1/√Aⱼⱼ and √Aⱼⱼ
  std::vector<double> scores_;        // of the pairs: use, fading
  std::vector<double> squares_;       // per part of the rows
  Vector along_;                      // of one projection
  std::vector<int> made_;             // pairs made in one call of learn()
  long tried_ = 0, answered_ = 0, asleep_for_ = 0;
};

}  // namespace buckens::linalg
