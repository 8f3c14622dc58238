// SPDX-License-Identifier: Apache-2.0
// What the parts of a march save, so that steps go on from it to the last bit.
#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <utility>

#include "buckens/model/saved_state.h"
#include "buckens/stepping/time_march.h"

namespace buckens::stepping {

namespace {

constexpr long kMostCounted = 1L << 60;

/// Entries of λ in rising order, every one once.
void visit_rows(const base::SaveVisit& visit, const std::string& name, const model::Model& model,
                std::vector<int>& rows) {
  visit.counts(name, rows, 0, model.num_constraint_rows() - 1);
  if (std::adjacent_find(rows.begin(), rows.end(), std::greater_equal<>()) == rows.end()) return;
  visit.refuse(name, "its rows are not in rising order");
}

void visit_poses(const base::SaveVisit& visit, std::size_t count,
                 std::vector<spatial::Pose>& poses) {
  poses.resize(count);
  for (std::size_t b = 0; b < count; ++b) {
    visit.inside(b).fixed("p", poses[b].p);
    visit.inside(b).rotation("q", poses[b].q);
  }
}

void visit_vectors(const base::SaveVisit& visit, std::size_t count,
                   std::vector<Eigen::Vector3d>& values) {
  values.resize(count);
  for (std::size_t b = 0; b < count; ++b) visit.fixed(std::to_string(b), values[b]);
}

void visit_nodal(const base::SaveVisit& visit, const model::Model& model,
                 std::vector<linalg::NodalVector>& values) {
  values.resize(model.bodies.size());
  for (std::size_t b = 0; b < values.size(); ++b) {
    if (!model.bodies[b].is_flexible()) continue;
    model::visit_nodal(visit, std::to_string(b), model.bodies[b].num_dofs(), false, values[b]);
  }
}

}  // namespace

void RowWatch::visit_saved(const base::SaveVisit& visit) {
  visit.number("largest_gap", largest_gap_);
  visit.flag("has_open_rows", has_open_rows_);
}

void SmallNewton::visit_saved(const base::SaveVisit& visit) {
  visit_rows(visit, "rows_in_use", model_, rows_in_use_);
  visit.counts("dependent", dependent_, 0, model_.num_constraint_rows() - 1);
  visit.flag("gave_up_rows", gave_up_rows_);
  std::vector<int> released(released_.begin(), released_.end());
  visit.counts("released", released, 0, 1);
  if (released.size() != 0 && released.size() != model_.joints.size()) {
    visit.refuse("released", "it does not belong to these joints");
  }
  released_.assign(released.begin(), released.end());
  visit.number("trusted_pivots", trusted_pivots_);
  watch_.visit_saved(visit.inside("watch"));
  visit.count("num_selections", num_selections_, 0, 1 << 30);
  std::vector<double> pivoted = condensation_ ? condensation_->pivoted_values() : pivoted_;
  visit.any_numbers("pivoted", pivoted);
  if (!visit.is_restoring()) return;
  pivoted_ = std::move(pivoted);
  number_rows_in_use();
  condensation_.reset();
}

void Stepper::visit_saved(const base::SaveVisit& visit) {
  newton_->visit_saved(visit);
  // What the last step has taught is kept now rather than at the start of the next one.
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    if (has_lesson_) groups_[g].learn(pool_);
    groups_[g].visit_saved(visit.inside("kept_solves").inside(g));
  }
  has_lesson_ = false;
  for (std::size_t b = 0; b < flexible_.size(); ++b) {
    if (!flexible_[b]) continue;
    body::FrameMotion& frame = flexible_[b]->frame_at_end;
    const base::SaveVisit one = visit.inside("frames_at_end").inside(b);
    one.fixed("p", frame.X_WB.p);
    one.rotation("q", frame.X_WB.q);
    one.fixed("v", frame.v);
    one.fixed("w", frame.w);
  }
}

void StepLadder::visit_saved(const base::SaveVisit& visit) {
  std::vector<int> rungs;
  std::vector<long> last_used;
  for (const Rung& rung : rungs_) {
    rungs.push_back(rung.k);
    last_used.push_back(rung.last_used);
  }
  visit.counts("rungs", rungs, 0, kMostRung);
  visit.counts("last_used", last_used, 0, kMostCounted);
  visit.count("uses", uses_, 0, kMostCounted);
  if (visit.is_restoring()) {
    const bool is_sound = !rungs.empty() && rungs.size() <= limits_.most_kept &&
                          rungs.size() == last_used.size() &&
                          std::set<int>(rungs.begin(), rungs.end()).size() == rungs.size();
    if (!is_sound) visit.refuse("rungs", "no such set of steps can be in use");
    take_rungs(rungs, last_used);
  }
  for (Rung& rung : rungs_) {
    rung.stepper->visit_saved(visit.inside("rung").inside(static_cast<std::size_t>(rung.k)));
  }
}

void StepLadder::take_rungs(const std::vector<int>& rungs, const std::vector<long>& last_used) {
  std::vector<Rung> known = std::move(rungs_);
  rungs_.clear();
  for (std::size_t i = 0; i < rungs.size(); ++i) {
    const auto same = std::find_if(known.begin(), known.end(),
                                   [&](const Rung& rung) { return rung.k == rungs[i]; });
    if (same != known.end()) {
      rungs_.push_back({same->k, last_used[i], std::move(same->stepper)});
    } else {
      rungs_.push_back({rungs[i], last_used[i], make_stepper(rungs[i])});
    }
  }
}

void LocalError::visit_saved(const base::SaveVisit& visit) {
  const std::size_t bodies = model_.bodies.size();
  int points = static_cast<int>(past_.size());
  visit.count("num_points", points, 0, 3);
  past_.resize(static_cast<std::size_t>(points));
  for (std::size_t k = 0; k < past_.size(); ++k) {
    const base::SaveVisit point = visit.inside("past").inside(k);
    point.number("t", past_[k].t);
    visit_poses(point.inside("poses"), bodies, past_[k].poses);
    visit_nodal(point.inside("d"), model_, past_[k].d);
  }
  if (points > 0) {
    const base::SaveVisit start = visit.inside("start");
    visit_vectors(start.inside("v"), bodies, start_.v);
    visit_vectors(start.inside("w"), bodies, start_.w);
    visit_vectors(start.inside("v_dot"), bodies, start_.v_dot);
    visit_vectors(start.inside("w_dot"), bodies, start_.w_dot);
    visit_nodal(start.inside("d_dot"), model_, start_.d_dot);
  }
  visit.list("largest", largest_, bodies);
  visit.list("expected", expected_, bodies);
  visit.flag("is_first_trial", is_first_trial_);
}

void TimeMarch::visit_saved(const base::SaveVisit& visit) {
  visit.count("ticks", ticks_, 0, end_);
  visit.count("rung", k_, 0, shortest());
  visit.number("spread", spread_);
  visit.flag("has_begun", has_begun_);
  visit.flag("has_restarted", has_restarted_);
  visit.count("accepted", report_.accepted, 0, kMostCounted);
  visit.count("rejected", report_.rejected, 0, kMostCounted);
  visit.count("failed", report_.failed, 0, kMostCounted);
  visit.counts("accepted_by_rung", accepted_, 0, kMostCounted);
  if (accepted_.size() != kShortestRung + 1) visit.refuse("accepted_by_rung", "its length");
  if (visit.is_restoring() && !fits(k_)) visit.refuse("rung", "no such step begins there");
  if (error_) {
    visit.number("estimate", estimate_.ratio);
    error_->visit_saved(visit.inside("error"));
    if (has_begun_ && !error_->has_begun()) visit.refuse("error", "its past is missing");
  }
  ladder_.visit_saved(visit.inside("ladder"));
}

}  // namespace buckens::stepping
