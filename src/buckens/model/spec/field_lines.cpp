// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/spec/field_lines.h"

#include <array>
#include <optional>

#include <fmt/format.h>

#include "buckens/base/errors.h"
#include "buckens/base/field.h"
#include "buckens/model/function_signal.h"
#include "buckens/model/spec/description_member.h"

namespace buckens::model {

namespace {

using Form = base::MemberType::Form;

/// The shortest text that gives the same bits again.
std::string text_of(double value) { return fmt::format("{}", value); }

/// Collects lines below a path.
class LineCollector {
 public:
  LineCollector(std::vector<std::string>& lines, double duration)
      : lines_(lines), duration_(duration) {}

  void add(const std::string& path, const base::Member& member) {
    switch (member.type->form()) {
      case Form::value:
        return add_value(path, member);
      case Form::choice:
        return put(path, member.type->choices()[member.type->index(member.at)]);
      case Form::record:
        for (const base::Field& field : member.fields()) {
          add(field.note.name.empty() ? path : fmt::format("{}.{}", path, field.note.name),
              field.member);
        }
        return;
      case Form::variant: {
        const std::string key = member.type->alternatives()[member.type->index(member.at)].key;
        return add(path + "." + key, member.parts().front());
      }
      case Form::optional:
      case Form::reference:
        for (const base::Member& part : member.parts()) add(path, part);
        return;
      case Form::array:
      case Form::list:
        return add_items(path, member.parts());
    }
  }

 private:
  void add_items(const std::string& path, const std::vector<base::Member>& items) {
    for (std::size_t k = 0; k < items.size(); ++k) {
      if (const std::string* name = items[k].type->name(items[k].at)) {
        put(path + "." + *name, "");
        add(path + "." + *name, items[k]);
      } else {
        add(fmt::format("{}.{}", path, k), items[k]);
      }
    }
  }

  void put(const std::string& path, const std::string& text) {
    lines_.push_back(path.substr(path.front() == '.' ? 1 : 0) + ": " + text);
  }

  void add_value(const std::string& path, const base::Member& member) {
    if (const auto* truth = member.get<bool>()) put(path, *truth ? "on" : "off");
    if (const auto* number = member.get<int>()) put(path, std::to_string(*number));
    add_if<double>(path, member);
    add_if<std::string>(path, member);
    add_if<Eigen::Vector3d>(path, member);
    add_if<base::MarkerRef>(path, member);
    add_if<DeflectionBase>(path, member);
    add_if<body::FrameDivision>(path, member);
    add_if<PositionLaw>(path, member);
    add_if<base::TimeLaw>(path, member);
    add_if<base::SignalLaw>(path, member);
    add_if<base::Characteristic>(path, member);
  }
  template <class T>
  void add_if(const std::string& path, const base::Member& member) {
    if (const T* value = member.get<T>()) add_special(path, *value);
  }

  void add_special(const std::string& path, double value) { put(path, text_of(value)); }
  void add_special(const std::string& path, const std::string& value) { put(path, value); }
  void add_special(const std::string& path, const Eigen::Vector3d& value) {
    put(path, fmt::format("[{}, {}, {}]", value.x(), value.y(), value.z()));
  }
  void add_special(const std::string& path, const base::MarkerRef& value) {
    const Eigen::Vector3d point = value.point.value_or(Eigen::Vector3d::Zero());
    add_special(path, value.body + "/" + value.marker);
    if (value.point) add_special(path, point);
  }
  void add_special(const std::string& path, const DeflectionBase& value) {
    if (value == DeflectionBase::other) return add_special(path, value.marker);
    put(path, DeflectionBase::kWords[static_cast<std::size_t>(value.kind)]);
  }
  void add_special(const std::string& path, const body::FrameDivision& value) {
    put(path, value.per_element ? "per-element" : std::to_string(value.count));
  }
  void add_special(const std::string& path, const PositionLaw& value) {
    if (value.given) put(path, fmt::format("{} x {}", value.expression.text(), value.scale));
  }
  void add_special(const std::string& path, const base::TimeLaw& value) {
    std::string text = value.text();
    constexpr std::array kShares = {0.0, 0.171, 0.377, 0.593, 0.811, 1.0};
    for (const double share : kShares) text += ", " + value_at(value, share * duration_);
    put(path, text);
  }
  void add_special(const std::string& path, const base::SignalLaw& value) {
    if (const std::optional<double> number = value.number()) return put(path, text_of(*number));
    if (!value.formula) return add_special(path, value.law);
    put(path, fmt::format("{} x {}", value.formula->text(), value.scale));
  }
  void add_special(const std::string& path, const base::Characteristic& value) {
    std::string text = value.text();
    constexpr std::array kPlaces = {-0.8, -0.1, -0.003, 0.003, 0.1, 0.8};
    for (const double x : kPlaces) text += ", " + force_at(value, x);
    put(path, text);
  }
  static std::string force_at(const base::Characteristic& value, double x) {
    try {
      return text_of(value.force(x, x));
    } catch (const NumericalError&) {
      return "none";  // outside of a table
    }
  }
  static std::string value_at(const base::TimeLaw& law, double t) {
    try {
      return text_of(law.value(t));
    } catch (const NumericalError&) {
      return "none";  // outside of a table
    }
  }

  std::vector<std::string>& lines_;
  double duration_;
};

}  // namespace

std::vector<std::string> field_lines(const ModelDescription& description) {
  std::vector<std::string> all;
  // Laws are told by their values within the same second, however long the run is.
  LineCollector(all, 1.0).add("", description_member(description));
  std::vector<std::string> out;
  for (std::string& line : all) {
    const bool is_left_out = line.starts_with("title:") || line.starts_with("base:") ||
                             line.starts_with("simulation.duration:") ||
                             line.starts_with("simulation.checkpoint:");
    if (is_left_out) continue;
    out.push_back(std::move(line));
  }
  return out;
}

std::vector<std::string> built_lines(const Model& model) {
  std::vector<std::string> out;
  for (const body::Body& body : model.bodies) {
    out.push_back(fmt::format("body {}: {} variables, {} rows, mass {:.9g} kg", body.name,
                              body.num_dofs(), body.num_interface_rows(), body.mass));
  }
  out.push_back(fmt::format("joints: {} equations", model.num_constraint_rows()));
  // Those of pairs come and go.
  const std::size_t count =
      model.pair_loads.empty() ? model.loads.size() : model.pair_loads.front().first;
  for (std::size_t k = 0; k < count; ++k) {
    out.push_back("load " + model.loads[k].name + ": " + model.loads[k].kind);
  }
  for (const Signal& signal : model.signals.all) {
    if (const FunctionSignal* function = function_of(signal)) {
      out.push_back(fmt::format("signal {}: function of t, {}", signal.name,
                                fmt::join(function->inputs(), ", ")));
    }
  }
  return out;
}

}  // namespace buckens::model
