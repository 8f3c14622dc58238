// SPDX-License-Identifier: Apache-2.0
#include "buckens/linalg/recycled_solves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

namespace buckens::linalg {

using Eigen::Index;
using Eigen::VectorXf;

namespace {
// How fast the use of a pair is forgotten, per load.
constexpr double kFade = 0.9;
// Outcomes are counted from when all places are taken, and judged after so many loads per place. A
// store with fewer answers than this share of them sleeps for so many times as many loads.
constexpr long kJudgedPerPlace = 3;
constexpr double kLeastAnswered = 0.5;
constexpr long kSleepPerJudged = 8;
// Loads that are solved for together may have remainders in common. Where less than this share of
// one is new, it becomes no pair: its rounding would count.
constexpr double kLeastNew = 0.1;
// Single precision ends at 1e-38: of smaller loads, digits that count (6e-8) may be lost.
constexpr double kLeastSize = 1e-30;

constexpr long kMostCounted = 1L << 60;

std::size_t index(int pair) { return static_cast<std::size_t>(pair); }
}  // namespace

RecycledSolves::RecycledSolves(const Vector& inverse_diagonal, int most, SharedRowOrder order)
    : parts_(inverse_diagonal.size()),
      most_(std::max(most, 0)),
      scale_(inverse_diagonal.cwiseSqrt().cast<float>()),
      pairs_(make_kept_pairs(rows(), most_, std::move(order))),
      squares_(static_cast<std::size_t>(parts_.count())) {
  scores_.reserve(static_cast<std::size_t>(most_));
  made_.reserve(static_cast<std::size_t>(most_));
  along_.resize(most_);
}

void RecycledSolves::begin(const Vector& f, Request& request, TaskPool* pool) {
  request.remainder.resize(rows());
  request.answer.resize(rows());
  request.weights.setZero(most_);
  parts_.for_pieces(pool, [&](int /*part*/, Index first, Index size) {
    request.remainder.segment(first, size) =
        f.segment(first, size).cwiseProduct(scale_.segment(first, size).cast<double>());
  });
}

double RecycledSolves::norm(const Request& request, TaskPool* pool) {
  if (request.of != nullptr) return norm_of_divided(request);
  std::fill(squares_.begin(), squares_.end(), 0.0);
  parts_.for_pieces(pool, [&](int part, Index first, Index size) {
    squares_[static_cast<std::size_t>(part)] +=
        request.remainder.segment(first, size).squaredNorm();
  });
  double square = 0;
  for (const double part : squares_) square += part;
  return std::sqrt(square);
}

double RecycledSolves::project(Request& request, TaskPool* pool) {
  const double left = pairs_->project(num_pairs(), request.remainder, along_, pool);
  request.weights.head(num_pairs()) += along_.head(num_pairs());
  return left;
}

bool RecycledSolves::answer(Vector& f, double limit, Request& request, TaskPool* pool) {
  request.fate = Request::Fate::not_tried;
  request.of = nullptr;
  if (!may_answer()) return false;
  begin(f, request, pool);
  if (project(request, pool) <= limit) {
    pairs_->combine(num_pairs(), request.weights, scale_, false, f, pool);
    request.fate = Request::Fate::answered;
    return true;
  }
  // Once more: what rounding has left along the pairs must not come into the next one.
  project(request, pool);
  request.fate = Request::Fate::solved;
  parts_.for_pieces(pool, [&](int /*part*/, Index first, Index size) {
    f.segment(first, size) = request.remainder.segment(first, size)
                                 .cwiseQuotient(scale_.segment(first, size).cast<double>());
  });
  return false;
}

void RecycledSolves::complete(Request& request, Vector& x, TaskPool* pool) const {
  if (request.fate != Request::Fate::solved) return;
  parts_.for_pieces(pool, [&](int /*part*/, Index first, Index size) {
    request.answer.segment(first, size) =
        x.segment(first, size).cwiseQuotient(scale_.segment(first, size).cast<double>());
  });
  pairs_->combine(num_pairs(), request.weights, scale_, true, x, pool);
}

void RecycledSolves::learn(std::span<Request* const> requests, TaskPool* pool) {
  made_.clear();
  for (Request* request : requests) {
    if (asleep_for_ > 0) {
      --asleep_for_;
      continue;
    }
    if (request->fate == Request::Fate::not_tried) continue;
    note_use(*request);
    note_outcome(request->fate == Request::Fate::answered);
    if (asleep_for_ == 0 && request->fate == Request::Fate::solved) keep(*request, pool);
  }
}

void RecycledSolves::forget() {
  scores_.clear();
  tried_ = answered_ = asleep_for_ = 0;
}

void RecycledSolves::keep(Request& request, TaskPool* pool) {
  double size = norm(request, pool);
  const double least = kLeastNew * size;
  if (!made_.empty()) {
    for (const int pair : made_) separate(pair, request, pool);
    size = norm(request, pool);
  }
  if (!std::isfinite(size) || size <= std::max(least, kLeastSize)) return;
  if (static_cast<int>(made_.size()) == most_) return;
  const int pair = free_pair();
  scores_[index(pair)] = size;
  put(pair, 1.0 / size, request, pool);
  made_.push_back(pair);
}

void RecycledSolves::separate(int pair, Request& request, TaskPool* pool) {
  if (request.of != nullptr) return separate_divided(pair, request);
  pairs_->separate(pair, request.remainder, request.answer, pool);
}

void RecycledSolves::put(int pair, double scale, const Request& request, TaskPool* pool) {
  if (request.of != nullptr) return put_divided(pair, scale, request);
  pairs_->put(pair, scale, request.remainder, request.answer, pool);
}

int RecycledSolves::free_pair() {
  if (num_pairs() < most_) {
    scores_.push_back(0.0);
    return num_pairs() - 1;
  }
  int least = -1;
  for (int pair = 0; pair < num_pairs(); ++pair) {
    if (std::find(made_.begin(), made_.end(), pair) != made_.end()) continue;
    if (least < 0 || scores_[index(pair)] < scores_[index(least)]) least = pair;
  }
  return least;
}

void RecycledSolves::note_use(const Request& request) {
  for (int pair = 0; pair < num_pairs(); ++pair) {
    double& score = scores_[index(pair)];
    score = std::max(kFade * score, std::abs(request.weights[pair]));
  }
}

void RecycledSolves::note_outcome(bool is_answered) {
  if (num_pairs() < most_) return;
  ++tried_;
  if (is_answered) ++answered_;
  const long judged = kJudgedPerPlace * most_;
  if (tried_ < judged) return;
  if (static_cast<double>(answered_) < kLeastAnswered * static_cast<double>(tried_)) {
    asleep_for_ = kSleepPerJudged * judged;
    scores_.clear();
    made_.clear();
  }
  tried_ = answered_ = 0;
}

void RecycledSolves::visit_saved(const base::SaveVisit& visit) {
  visit.count("tried", tried_, 0, kMostCounted);
  visit.count("answered", answered_, 0, kMostCounted);
  visit.count("asleep_for", asleep_for_, 0, kMostCounted);
  visit.any_numbers("scores", scores_);
  if (num_pairs() > most_) visit.refuse("scores", "there are more pairs than places");
  for (const double score : scores_) {
    if (!std::isfinite(score)) visit.refuse("scores", "a score is not finite");
  }
  for (int pair = 0; pair < num_pairs(); ++pair) {
    const base::SaveVisit one = visit.inside(static_cast<std::size_t>(pair));
    visit_pair(one, pair);
  }
}

void RecycledSolves::visit_pair(const base::SaveVisit& visit, int pair) {
  if (visit.is_restoring()) {
    const VectorXf load = visit.restored_singles("load", rows());
    const VectorXf answer = visit.restored_singles("answer", rows());
    pairs_->restore(pair, load, answer);
    return;
  }
  // Other processes may have the pair, and send both: the second waits for its turn.
  auto both = std::make_shared<std::array<VectorXf, 2>>();
  const auto save = [&](const char* name, std::size_t which) {
    visit.save_singles(name, rows(), [this, pair, both, which] {
      if ((*both)[which].size() == 0) pairs_->take(pair, (*both)[0], (*both)[1]);
      return std::exchange((*both)[which], {});
    });
  };
  save("load", 0);
  save("answer", 1);
}

}  // namespace buckens::linalg
