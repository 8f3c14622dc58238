// SPDX-License-Identifier: Apache-2.0
// What the statistics of a run save, so that a continued run reports all of it.
#include <string>

#include "buckens/analysis/simulation/coupling_watch.h"
#include "buckens/analysis/simulation/run_recording.h"
#include "buckens/analysis/simulation/run_statistics.h"
#include "buckens/analysis/simulation/work_account.h"
#include "buckens/model/saved_state.h"

namespace buckens::analysis {

namespace {

constexpr long kMostCounted = 1L << 60;

void visit_work(const base::SaveVisit& visit, results::WorkBalance& work) {
  visit.number("external", work.external);
  visit.number("dissipated", work.dissipated);
  visit.number("balance", work.balance);
  visit.vector("parts", work.parts, work.parts.size());
}

}  // namespace

void DampingWork::visit_saved(const base::SaveVisit& visit) {
  visit.number("power", power_);
  visit.number("t", t_);
  visit.number("last_step", last_step_);
  visit.count("products", products_, 0, kMostCounted);
  const Eigen::Index n = body_->num_dofs();
  if (is_direct_) return model::visit_nodal(visit, "rates", n, false, rates_);
  model::visit_nodal(visit, "d", n, false, d_);
  model::visit_nodal(visit, "elastic", n, false, elastic_);
  model::visit_nodal(visit, "elastic_before", n, true, elastic_before_);
}

void WorkAccount::visit_saved(const base::SaveVisit& visit) {
  const Eigen::Index rows = model_.num_constraint_rows();
  visit.number("active", before_.active);
  visit.number("damping", before_.damping);
  visit.vector("g_t", before_.g_t, before_.g_t.size());
  if (model_.may_have_rigid_rows()) visit.vector("laws", laws_before_, laws_before_.size());
  visit.number("t", t_);
  visit.vector("lambda_before", lambda_before_, rows);
  visit.vector("lambda_start", lambda_start_, rows);
  visit.number("lambda_time", lambda_time_);
  visit_work(visit.inside("work"), work_);
  visit_work(visit.inside("work_before"), work_before_);
  visit.number("turnover", turnover_);
  for (std::size_t k = 0; k < loads_before_.size(); ++k) {
    const base::SaveVisit load = visit.inside("loads").inside(k);
    load.number("supplied", loads_before_[k].supplied);
    load.number("lost", loads_before_[k].lost);
    load.number("rubbed", loads_before_[k].rubbed);
  }
  parameters_.visit_saved(visit.inside("parameters"));
  friction_->visit_saved(visit.inside("friction"));
  visit.vector("parts_start", parts_start_, parts_start_.size());
  const base::SaveVisit start = visit.inside("start");
  start.number("kinetic", start_.kinetic);
  start.number("strain", start_.strain);
  start.number("gravity", start_.gravity);
  start.number("springs", start_.springs);
  for (std::size_t k = 0; k < meshes_.size(); ++k) {
    meshes_[k].visit_saved(visit.inside("meshes").inside(k));
  }
}

void JointTrust::visit_saved(const base::SaveVisit& visit) {
  visit.number("opening", opening_);
  visit.number("opening_rate", opening_rate_);
  visit.count("most_open_row", most_open_row_, -1, model_.num_constraint_rows() - 1);
  visit.number("speed", speed_);
}

void EnergyTrust::visit_saved(const base::SaveVisit& visit) {
  for (std::size_t b = 0; b < leaves_out_.size(); ++b) {
    bool leaves_out = leaves_out_[b];
    visit.flag(std::to_string(b), leaves_out);
    leaves_out_[b] = leaves_out;
  }
}

void RunStatistics::visit_saved(const base::SaveVisit& visit) {
  visit.count("steps", steps_, 0, kMostCounted);
  visit.count("iterations", iterations_, 0, kMostCounted);
  visit.count("most_iterations", most_iterations_, 0, kMostCounted);
  visit.count("repeated_solves", repeated_solves_, 0, kMostCounted);
  visit.count("undecided_steps", undecided_steps_, 0, kMostCounted);
  visit.count("impacts", impacts_, 0, kMostCounted);
  visit.count("steps_with_near_impulses", steps_with_near_impulses_, 0, kMostCounted);
  visit.count("jammed_impacts", jammed_impacts_, 0, kMostCounted);
  visit.number("impact_loss", impact_loss_);
  visit.number("position_residual", residuals_.position);
  visit.number("velocity_residual", residuals_.velocity);
  visit.number("sieve_residual", residuals_.sieve);
  visit.flag("is_finite", is_finite_);
  visit.number("largest_balance", largest_balance_);
  visit.number("energy_scale", energy_scale_);
  visit.list("largest_spin", largest_spin_, largest_spin_.size());
  joints_.visit_saved(visit.inside("joints"));
  energy_.visit_saved(visit.inside("energy"));
  touches_.visit_saved(visit.inside("touches"));
  for (std::size_t b = 0; b < deformation_.size(); ++b) {
    const base::SaveVisit body = visit.inside("deformation").inside(b);
    body.number("rotation", deformation_[b].rotation);
    body.number("strain", deformation_[b].strain);
    body.number("tension", deformation_[b].tension);
    body.number("compression", deformation_[b].compression);
  }
}

void CouplingWatch::visit_saved(const base::SaveVisit& visit) {
  visit.count("steps", steps_, 0, kMostCounted);
  visit.count("products", products_, 0, kMostCounted);
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const base::SaveVisit body = visit.inside("bodies").inside(b);
    body.number("window", bodies_[b].window);
    body.number("neglected", bodies_[b].neglected);
    model::visit_saved(body.inside("first"), bodies_[b].first);
    body.texts("changes", bodies_[b].changes);
  }
}

void RunRecording::visit_saved(const base::SaveVisit& visit) {
  visit.flag("is_first", is_first_);
  visit.count("records", records_, 0, kMostCounted);
  visit.number("last_written", last_written_);
  double every = plan_.every;
  visit.number("every", every);
  if (every != plan_.every) skip_to(last_written_);
  visit.number("last_due", last_due_);
  visit.number("last_due_fields", last_due_fields_);
  fields_.visit_saved(visit.inside("fields"));
}

}  // namespace buckens::analysis
