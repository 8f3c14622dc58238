// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/running_integral.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::base {

namespace {

// Positive abscissae of the Kronrod rule with 15 points and its weights; every second point is one
// of the Gauss rule with 7 (Piessens et al., QUADPACK, 1983).
constexpr std::array<double, 8> kAbscissae = {
    0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
    0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
    0.586087235467691130294144691258380, 0.405845151377397166906606412076961,
    0.207784955007898467600689403773245, 0.0};
constexpr std::array<double, 8> kKronrod = {
    0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
    0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
    0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
    0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
constexpr std::array<double, 4> kGauss = {
    0.129484966168869693270611432679082, 0.279705391489276667901467771423780,
    0.381830050505118944950369775488975, 0.417959183673469387755102040816327};

// The rules differ by much more than the better one errs: by about err^(2/3).
constexpr double kQuadratureAgreement = 1e-11;
// Panels grow again where the rules agree much better than they need to.
constexpr double kEasy = 1e-3 * kQuadratureAgreement;
constexpr double kFirstWidth = 1e-12;  // [s]; doubles 40 times on the way to 1 s
// Relative to t: a jump of f within such a panel is placed well enough.
constexpr double kLeastWidth = 1e-12;
constexpr std::size_t kMostPanels = 4000000;
// For one panel truncated by t. A jump takes 50 of them; noise in f is not worth more.
constexpr int kMostPieces = 500;

struct Panel {
  double value = 0, difference = 0, magnitude = 0;
  bool agrees() const { return difference <= kQuadratureAgreement * magnitude; }
  bool is_easy() const { return difference <= kEasy * magnitude; }
};

Panel integrate(const std::function<double(double)>& f, double a, double b) {
  const double middle = 0.5 * (a + b);
  const double half = 0.5 * (b - a);
  double kronrod = 0, gauss = 0, magnitude = 0;
  for (std::size_t k = 0; k < kAbscissae.size(); ++k) {
    const bool is_middle = kAbscissae[k] == 0.0;
    const double low = f(middle - half * kAbscissae[k]);
    const double high = is_middle ? 0.0 : f(middle + half * kAbscissae[k]);
    kronrod += kKronrod[k] * (low + high);
    magnitude += kKronrod[k] * (std::abs(low) + std::abs(high));
    if (k % 2 == 1) gauss += kGauss[k / 2] * (low + high);
  }
  return {half * kronrod, std::abs(half * (kronrod - gauss)), std::abs(half) * magnitude};
}

}  // namespace

RunningIntegral::RunningIntegral(std::function<double(double)> f, std::vector<double> breaks)
    : f_(std::move(f)), breaks_(std::move(breaks)), width_(kFirstWidth) {
  marks_.push_back(mark_at(0, 0));
}

RunningIntegral::Mark RunningIntegral::mark_at(double at, double sum) const {
  const double end = std::min(at + width_, next_break(at));
  return {at, sum, marks_.empty() ? end : std::max(end, marks_.back().reach)};
}

double RunningIntegral::next_break(double after) const {
  const auto found = std::upper_bound(breaks_.begin(), breaks_.end(), after);
  return found == breaks_.end() ? HUGE_VAL : *found;
}

void RunningIntegral::advance(double t) const {
  while (true) {
    const Mark last = marks_.back();
    if (last.reach > t) return;
    const double end = std::min(last.at + width_, next_break(last.at));
    const Panel panel = integrate(f_, last.at, end);
    const double least = std::max(kLeastWidth * end, kFirstWidth);
    if (!panel.agrees() && end - last.at > least) {
      width_ = 0.5 * (end - last.at);
      continue;
    }
    if (panel.is_easy()) width_ *= 2.0;
    marks_.push_back(mark_at(end, last.sum + panel.value));
    if (marks_.size() > kMostPanels) {
      throw NumericalError(fmt::format(
          "a law of speed varies too fast to be integrated up to t = {:.6g} s; give the angle "
          "itself in its place",
          t));
    }
  }
}

double RunningIntegral::within_panel(double a, double b) const {
  double sum = 0;
  // Depth first, so that few pieces are pending near a jump.
  std::vector<std::pair<double, double>> pieces = {{a, b}};
  for (int count = 0; !pieces.empty(); ++count) {
    const auto [from, to] = pieces.back();
    pieces.pop_back();
    if (from == to) continue;
    const Panel panel = integrate(f_, from, to);
    const double middle = 0.5 * (from + to);
    if (panel.agrees() || count >= kMostPieces || middle == from || middle == to) {
      sum += panel.value;
    } else {
      pieces.emplace_back(middle, to);
      pieces.emplace_back(from, middle);
    }
  }
  return sum;
}

double RunningIntegral::to(double t) const {
  if (!(t > 0.0)) return t < 0.0 ? within_panel(0.0, t) : 0.0;
  const std::lock_guard lock(mutex_);
  advance(t);
  // Where advance() would have stopped if nothing later had been requested.
  const Mark& mark = *std::upper_bound(marks_.begin(), marks_.end(), t,
                                       [](double time, const Mark& m) { return time < m.reach; });
  return mark.sum + within_panel(mark.at, t);
}

}  // namespace buckens::base
