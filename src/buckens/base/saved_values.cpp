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

/// The entry of this name, or null.
template <class Map>
const typename Map::mapped_type* entry(const Map& map, const std::string& path) {
  const auto found = map.find(path);
  return found == map.end() ? nullptr : &found->second;
}

template <class Map, class Take>
void for_each_beginning(const Map& map, const std::string& beginning, const Take& take) {
  for (auto it = map.lower_bound(beginning); it != map.end() && it->first.starts_with(beginning);
       ++it) {
    take(it->first, it->second);
  }
}

}  // namespace

SavedValues SavedValues::part(const std::string& beginning) const {
  SavedValues out;
  const auto copy_to = [](auto& map) {
    return [&map](const std::string& path, const auto& list) { map[path] = list; };
  };
  for_each_beginning(numbers, beginning, copy_to(out.numbers));
  for_each_beginning(singles, beginning, copy_to(out.singles));
  for_each_beginning(counts, beginning, copy_to(out.counts));
  for_each_beginning(texts, beginning, copy_to(out.texts));
  for_each_beginning(in_file, beginning, [&out](const std::string& path, const InFile& list) {
    std::vector<double>& values = out.numbers[path];
    values.resize(list.size);
    list.read(std::span(values));
  });
  return out;
}

bool SavedValues::operator==(const SavedValues& other) const {
  if (!in_file.empty() || !other.in_file.empty()) return part("") == other.part("");
  return numbers == other.numbers && singles == other.singles && counts == other.counts &&
         texts == other.texts;
}

SaveVisit SaveVisit::inside(const std::string& name) const {
  return {out_, from_, prefix_ + name + "/", makes_later_};
}

void SaveVisit::refuse(const std::string& name, const std::string& what) const {
  throw InputError(fmt::format("the saved {}{} does not fit: {}", prefix_, name, what));
}

std::size_t SaveVisit::length_of(const std::string& name) const {
  const std::string path = prefix_ + name;
  if (const auto* list = entry(from_->numbers, path)) return list->size();
  if (const auto* list = entry(from_->in_file, path)) return list->size;
  if (const auto* list = entry(from_->singles, path)) return list->size();
  refuse(name, "it is missing");
}

template <class List>
List SaveVisit::restored(const std::string& name) const {
  using Number = std::decay_t<decltype(*std::declval<List>().data())>;
  const std::string path = prefix_ + name;
  List out(static_cast<decltype(out.size())>(length_of(name)));
  const auto copy = [&out](const auto& list) {
    std::transform(list.begin(), list.end(), out.data(),
                   [](auto number) { return static_cast<Number>(number); });
  };
  if (const auto* list = entry(from_->numbers, path)) {
    copy(*list);
  } else if (const auto* there = entry(from_->in_file, path)) {
    there->read(std::span<Number>(out.data(), there->size));
  } else {
    copy(from_->singles.at(path));
  }
  return out;
}

template <class List>
List SaveVisit::restored(const std::string& name, std::size_t size) const {
  const std::size_t found = length_of(name);
  if (found != size) refuse(name, fmt::format("it has {} values, expected {}", found, size));
  auto out = restored<List>(name);
  if (!are_finite(out)) refuse(name, "it holds a value that is not finite");
  return out;
}

void SaveVisit::numbers(const std::string& name, std::span<double> values) const {
  if (is_restoring()) {
    const auto found = restored<std::vector<double>>(name, values.size());
    std::copy(found.begin(), found.end(), values.begin());
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
    values = restored<std::vector<double>>(name);
  } else {
    out_->numbers[prefix_ + name] = values;
  }
}

void SaveVisit::list(const std::string& name, std::vector<double>& values, std::size_t size) const {
  if (is_restoring()) {
    values = restored<std::vector<double>>(name, size);
  } else {
    any_numbers(name, values);
  }
}

void SaveVisit::list_or_none(const std::string& name, std::vector<double>& values,
                             std::size_t size) const {
  const std::size_t found = is_restoring() ? length_of(name) : values.size();
  if (found != 0 && found != size) {
    refuse(name, fmt::format("it has {} values, expected {} or none", found, size));
  }
  any_numbers(name, values);
}

void SaveVisit::vector(const std::string& name, Eigen::VectorXd& value, Eigen::Index size) const {
  if (is_restoring()) {
    value = restored<Eigen::VectorXd>(name, static_cast<std::size_t>(size));
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
  return restored<Eigen::VectorXf>(name, static_cast<std::size_t>(size));
}

void SaveVisit::vector_or_none(const std::string& name, Eigen::VectorXd& value,
                               Eigen::Index size) const {
  const bool is_none = is_restoring() && length_of(name) == 0;
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
