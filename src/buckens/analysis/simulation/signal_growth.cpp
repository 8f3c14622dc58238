// SPDX-License-Identifier: Apache-2.0
#include "buckens/analysis/simulation/signal_growth.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

namespace buckens::analysis {

namespace {

// The last growth by this factor is looked at; a stretch has most of it, or the signal has jumped.
constexpr double kGrowthSeen = 4096.0;
constexpr double kLeastGrowthSeen = kGrowthSeen / 8.0;
// A stretch has at least as many doublings, each in a step of its own: no single jump.
constexpr std::ptrdiff_t kLeastDoublings = 5;
// How much longer the second half of a growth may take, as a factor, than the first. Exponential
// growth takes equal times, powers of time below the sixth take longer than this.
constexpr double kSlowing = 2.0;

}  // namespace

bool follows_signals(const model::Model& model) {
  return !model.signals.steering.empty() ||
         std::any_of(model.loads.begin(), model.loads.end(),
                     [](const model::Load& load) { return load.element->uses_signals(); });
}

SignalGrowth::SignalGrowth(const model::Model& model)
    : model_(model), acts_(follows_signals(model)), doublings_(model.signals.all.size()) {}

void SignalGrowth::follow(const std::vector<double>& signals) {
  if (!acts_ || signals.empty()) return;
  for (std::size_t k = 0; k < doublings_.size(); ++k) {
    const double size = std::abs(signals[k + 1]);
    if (!std::isfinite(size)) continue;
    std::vector<Doubling>& known = doublings_[k];
    const double largest = known.empty() ? 0.0 : known.back().size;
    if (size > 0.0 && size >= 2.0 * largest) known.push_back({signals[0], size});
  }
}

std::optional<SignalGrowth::Stretch> SignalGrowth::growth(std::size_t signal) const {
  const std::vector<Doubling>& known = doublings_[signal];
  if (known.empty()) return std::nullopt;
  const auto reaches = [&](double size) {
    return std::find_if(known.begin(), known.end(),
                        [size](const Doubling& one) { return one.size >= size; });
  };
  const Doubling& last = known.back();
  const auto first = reaches(last.size / kGrowthSeen);
  if (last.size < kLeastGrowthSeen * first->size || known.end() - first < kLeastDoublings) {
    return std::nullopt;
  }
  const auto middle = reaches(first->size * std::sqrt(last.size / first->size));
  if (last.t - middle->t > kSlowing * (middle->t - first->t)) return std::nullopt;
  return Stretch{*first, last};
}

void SignalGrowth::check_failed(const NumericalError& failure) const {
  // A failure with a place in the model file has named its cause.
  if (!acts_ || !failure.where().empty()) return;
  // A block is rather a controller than what measures; of others, the last depends on those before.
  std::ptrdiff_t named = -1;
  std::vector<std::string> all;
  for (const int k : model_.signals.order) {
    const auto one = static_cast<std::size_t>(k);
    if (!growth(one)) continue;
    all.push_back(fmt::format("\"{}\"", model_.signals.all[one].name));
    const bool is_block_named =
        named >= 0 && model_.signals.all[static_cast<std::size_t>(named)].block != nullptr;
    if (!is_block_named || model_.signals.all[one].block) named = k;
  }
  if (named < 0) return;
  const model::Signal& signal = model_.signals.all[static_cast<std::size_t>(named)];
  const Stretch stretch = *growth(static_cast<std::size_t>(named));
  all.erase(std::find(all.begin(), all.end(), fmt::format("\"{}\"", signal.name)));
  throw NumericalError(
      signal.where,
      fmt::format("signal \"{}\" has grown exponentially, from {:.3g} at t = {:.6g} s to {:.3g} at "
                  "t = {:.6g} s{}: what it controls seems to diverge; check the sign of its "
                  "feedback and its gains, give it `limits`, or use a smaller step; then the {}",
                  signal.name, stretch.from.size, stretch.from.t, stretch.to.size, stretch.to.t,
                  all.empty() ? "" : fmt::format(", like {}", fmt::join(all, ", ")),
                  failure.what()));
}

void SignalGrowth::visit_saved(const base::SaveVisit& visit) {
  if (!acts_) return;
  for (std::size_t k = 0; k < doublings_.size(); ++k) {
    std::vector<double> instants, sizes;
    for (const Doubling& one : doublings_[k]) {
      instants.push_back(one.t);
      sizes.push_back(one.size);
    }
    const base::SaveVisit signal = visit.inside(k);
    signal.any_numbers("instants", instants);
    signal.any_numbers("sizes", sizes);
    if (!visit.is_restoring()) continue;
    if (sizes.size() != instants.size()) signal.refuse("sizes", "has another length than instants");
    doublings_[k].clear();
    for (std::size_t i = 0; i < sizes.size(); ++i) doublings_[k].push_back({instants[i], sizes[i]});
  }
}

}  // namespace buckens::analysis
