// SPDX-License-Identifier: Apache-2.0
#include "buckens/model_file/shape.h"

#include <fmt/format.h>

#include "buckens/base/field_types.h"
#include "buckens/model/spec/model_description.h"
#include "buckens/model_file/table.h"

namespace buckens::model_file {

namespace {

template <class T>
Shape shape_of();

/// Default of a member as the file would write it, "" where there is none worth printing.
template <class T>
std::string default_text(const T& value, const base::FieldNote& note) {
  if (note.is_required) return "";
  if (!note.standard.empty()) return note.standard;
  if constexpr (std::is_same_v<T, bool>) {
    if (note.is_switch) return value ? "on" : "off";
    return value ? "true" : "false";
  } else if constexpr (std::is_arithmetic_v<T>) {
    return fmt::format("{:g}", static_cast<double>(value));
  } else if constexpr (std::is_enum_v<T>) {
    return base::choices_of<T>()[static_cast<std::size_t>(value)];
  } else if constexpr (std::is_same_v<T, std::string>) {
    return value;
  } else if constexpr (std::is_same_v<T, body::FrameDivision>) {
    return fmt::format("{}", value.count);
  } else if constexpr (std::is_same_v<T, model::DeflectionBase>) {
    return T::kWords[0];
  } else if constexpr (std::is_same_v<T, Eigen::Vector3d>) {
    return fmt::format("[{:g}, {:g}, {:g}]", value.x(), value.y(), value.z());
  } else {
    return "";
  }
}

class ShapeBuilder {
 public:
  explicit ShapeBuilder(Shape& out) : out_(out) {}

  template <class T>
  void operator()(const base::Field<T>& field) {
    if constexpr (base::kIsVariant<T>) {
      add_alternatives(std::type_identity<T>{});
    } else {
      out_.fields.push_back({field.note, shape_of<T>(), default_text(field.member, field.note)});
    }
  }

 private:
  template <class... A>
  void add_alternatives(std::type_identity<std::variant<A...>> /*type*/) {
    const auto add = [this]<class One>(std::type_identity<One>) {
      base::FieldNote note;
      note.name = One::kKey;
      note.doc = One::kDoc;
      out_.alternatives.push_back({note, shape_of<One>(), ""});
    };
    (add(std::type_identity<A>{}), ...);
  }

  Shape& out_;
};

Shape simple(Shape::Kind kind) {
  Shape out;
  out.kind = kind;
  return out;
}

Shape list_of(Shape element, int count) {
  Shape out = simple(Shape::Kind::list);
  out.count = count;
  out.element.push_back(std::move(element));
  return out;
}

template <class T, std::size_t n>
Shape array_shape(std::type_identity<std::array<T, n>> /*type*/) {
  return list_of(shape_of<T>(), static_cast<int>(n));
}

template <class T>
Shape reference_shape(std::type_identity<base::Reference<T>> /*type*/) {
  Shape out = simple(Shape::Kind::reference);
  out.element.push_back(shape_of<T>());
  return out;
}

template <class T>
Shape shape_of() {
  if constexpr (std::is_same_v<T, double>) {
    return simple(Shape::Kind::quantity);
  } else if constexpr (std::is_same_v<T, int>) {
    return simple(Shape::Kind::integer);
  } else if constexpr (std::is_same_v<T, body::FrameDivision>) {
    Shape out = simple(Shape::Kind::frame_division);
    out.choices = {body::FrameDivision::kPerElement};
    return out;
  } else if constexpr (std::is_same_v<T, bool>) {
    return simple(Shape::Kind::truth);
  } else if constexpr (std::is_same_v<T, std::string>) {
    return simple(Shape::Kind::text);
  } else if constexpr (std::is_enum_v<T>) {
    Shape out = simple(Shape::Kind::choice);
    out.choices = base::choices_of<T>();
    return out;
  } else if constexpr (std::is_same_v<T, Eigen::Vector3d>) {
    return list_of(simple(Shape::Kind::quantity), 3);
  } else if constexpr (std::is_same_v<T, base::TimeLaw>) {
    Shape out = simple(Shape::Kind::time_law);
    out.element.push_back(shape_of<TableLawSpec>());
    return out;
  } else if constexpr (std::is_same_v<T, base::SignalLaw>) {
    Shape out = shape_of<base::TimeLaw>();
    out.choices = {"or of signals"};
    return out;
  } else if constexpr (std::is_same_v<T, base::Characteristic>) {
    Shape out = shape_of<base::TimeLaw>();
    out.choices = {"or characteristic"};
    return out;
  } else if constexpr (std::is_same_v<T, model::PositionLaw>) {
    return simple(Shape::Kind::position_law);
  } else if constexpr (std::is_same_v<T, base::MarkerRef>) {
    return simple(Shape::Kind::marker);
  } else if constexpr (std::is_same_v<T, model::DeflectionBase>) {
    Shape out = simple(Shape::Kind::word_or_marker);
    out.choices = {T::kWords.begin(), T::kWords.end()};
    return out;
  } else if constexpr (base::kIsOptional<T>) {
    return shape_of<typename T::value_type>();
  } else if constexpr (base::kIsArray<T>) {
    return array_shape(std::type_identity<T>{});
  } else if constexpr (base::kIsReference<T>) {
    return reference_shape(std::type_identity<T>{});
  } else if constexpr (base::kIsVector<T>) {
    Shape out = list_of(shape_of<typename T::value_type>(), -1);
    if (base::kIsNamedList<T>) out.kind = Shape::Kind::named;
    return out;
  } else {
    Shape out = simple(Shape::Kind::record);
    out.type = typeid(T);
    T record;
    ShapeBuilder builder(out);
    record.fields(builder);
    return out;
  }
}

}  // namespace

const FieldShape* Shape::shorthand() const {
  for (const FieldShape& field : fields) {
    if (field.note.is_shorthand || field.note.name.empty()) return &field;
  }
  return nullptr;
}

const FieldShape* Shape::find(const std::string& key) const {
  for (const auto* list : {&fields, &alternatives}) {
    for (const FieldShape& field : *list) {
      if (field.note.name == key) return &field;
    }
  }
  return nullptr;
}

std::vector<std::string> Shape::keys() const {
  std::vector<std::string> out;
  for (const auto* list : {&alternatives, &fields}) {
    for (const FieldShape& field : *list) {
      if (!field.note.name.empty()) out.push_back(field.note.name);
    }
  }
  return out;
}

const Shape& model_file_shape() {
  static const Shape shape = shape_of<model::ModelDescription>();
  return shape;
}

}  // namespace buckens::model_file
