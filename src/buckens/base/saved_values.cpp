// SPDX-License-Identifier: Apache-2.0
#include "buckens/base/saved_values.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "buckens/base/errors.h"

namespace buckens::base {

namespace {

template <class Number>
void put_counts(std::vector<std::int64_t>& out, const std::vector<Number>& values) {
  out.assign(values.begin(), values.end());
}

template <class Numbers>
bool are_finite(const Numbers& values) {
  return std::all_of(values.begin(), values.end(), [](auto value) { return std::isfinite(value); });
}

}  // namespace

SaveVisit SaveVisit::inside(const std::string& name) const {
  return {out_, from_, prefix_ + name + "/", makes_later_};
}

void SaveVisit::refuse(const std::string& name, const std::string& what) const {
  throw InputError(fmt::format("the saved {}{} does not fit: {}", prefix_, name, what));
}

const std::vector<double>& SaveVisit::find_numbers(const std::string& name) const {
  const auto found = from_->numbers.find(prefix_ + name);
  if (found == from_->numbers.end()) refuse(name, "it is missing");
  return found->second;
}

const std::vector<double>& SaveVisit::find_numbers(const std::string& name,
                                                   std::size_t size) const {
  const std::vector<double>& values = find_numbers(name);
  require(name, values, size);
  return values;
}

template <class Numbers>
void SaveVisit::require(const std::string& name, const Numbers& values, std::size_t size) const {
  if (values.size() != size) {
    refuse(name, fmt::format("it has {} values, expected {}", values.size(), size));
  }
  if (!are_finite(values)) refuse(name, "it holds a value that is not finite");
}

void SaveVisit::numbers(const std::string& name, std::span<double> values) const {
  if (is_restoring()) {
    std::copy_n(find_numbers(name, values.size()).begin(), values.size(), values.begin());
  } else {
    out_->numbers[prefix_ + name].assign(values.begin(), values.end());
  }
}

void SaveVisit::number(const std::string& name, double& value) const { numbers(name, {&value, 1}); }

void SaveVisit::rotation(const std::string& name, Eigen::Quaterniond& q) const {
  numbers(name, {q.coeffs().data(), 4});
  if (is_restoring() && !(std::abs(q.norm() - 1.0) < 1e-6)) refuse(name, "it is no rotation");
}

void SaveVisit::any_numbers(const std::string& name, std::vector<double>& values) const {
  if (is_restoring()) {
    values = find_numbers(name);
  } else {
    out_->numbers[prefix_ + name] = values;
  }
}

void SaveVisit::list(const std::string& name, std::vector<double>& values, std::size_t size) const {
  if (is_restoring()) {
    values = find_numbers(name, size);
  } else {
    any_numbers(name, values);
  }
}

void SaveVisit::list_or_none(const std::string& name, std::vector<double>& values,
                             std::size_t size) const {
  any_numbers(name, values);
  if (values.empty() || values.size() == size) return;
  refuse(name, fmt::format("it has {} values, expected {} or none", values.size(), size));
}

void SaveVisit::vector(const std::string& name, Eigen::VectorXd& value, Eigen::Index size) const {
  if (is_restoring()) {
    const std::vector<double>& from = find_numbers(name, static_cast<std::size_t>(size));
    value = Eigen::Map<const Eigen::VectorXd>(from.data(), size);
  } else {
    out_->numbers[prefix_ + name].assign(value.data(), value.data() + value.size());
  }
}

void SaveVisit::save_singles(const std::string& name, Eigen::Index size,
                             std::function<Eigen::VectorXf()> make) const {
  if (makes_later_) {
    out_->later[prefix_ + name] = {static_cast<std::size_t>(size), std::move(make)};
    return;
  }
  const Eigen::VectorXf value = make();
  out_->singles[prefix_ + name].assign(value.data(), value.data() + value.size());
}

Eigen::VectorXf SaveVisit::restored_singles(const std::string& name, Eigen::Index size) const {
  const auto found = from_->singles.find(prefix_ + name);
  if (found == from_->singles.end()) {  // it comes from a file
    Eigen::VectorXd numbers;
    vector(name, numbers, size);
    return numbers.cast<float>();
  }
  require(name, found->second, static_cast<std::size_t>(size));
  return Eigen::Map<const Eigen::VectorXf>(found->second.data(), size);
}

void SaveVisit::vector_or_none(const std::string& name, Eigen::VectorXd& value,
                               Eigen::Index size) const {
  const bool is_none = is_restoring() && find_numbers(name).empty();
  vector(name, value, is_none ? 0 : size);
}

void SaveVisit::counts(const std::string& name, std::vector<long>& values, long least,
                       long most) const {
  if (!is_restoring()) return put_counts(out_->counts[prefix_ + name], values);
  const auto found = from_->counts.find(prefix_ + name);
  if (found == from_->counts.end()) refuse(name, "it is missing");
  for (const std::int64_t value : found->second) {
    if (value >= least && value <= most) continue;
    refuse(name, fmt::format("it holds {}, expected {} to {}", value, least, most));
  }
  values.assign(found->second.begin(), found->second.end());
}

void SaveVisit::counts(const std::string& name, std::vector<int>& values, int least,
                       int most) const {
  std::vector<long> all(values.begin(), values.end());
  counts(name, all, least, most);
  if (!is_restoring()) return;
  values.clear();
  for (const long value : all) values.push_back(static_cast<int>(value));
}

void SaveVisit::count(const std::string& name, long& value, long least, long most) const {
  std::vector<long> one = {value};
  counts(name, one, least, most);
  if (one.size() != 1) refuse(name, fmt::format("it has {} values, expected 1", one.size()));
  value = one.front();
}

void SaveVisit::count(const std::string& name, int& value, int least, int most) const {
  long wide = value;
  count(name, wide, least, most);
  value = static_cast<int>(wide);
}

void SaveVisit::flag(const std::string& name, bool& value) const {
  long wide = value ? 1 : 0;
  count(name, wide, 0, 1);
  value = wide == 1;
}

void SaveVisit::texts(const std::string& name, std::vector<std::string>& values) const {
  if (!is_restoring()) {
    out_->texts[prefix_ + name] = values;
    return;
  }
  const auto found = from_->texts.find(prefix_ + name);
  if (found == from_->texts.end()) refuse(name, "it is missing");
  values = found->second;
}

}  // namespace buckens::base
