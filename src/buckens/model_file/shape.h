// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <typeindex>
#include <vector>

#include "buckens/base/field.h"

namespace buckens::model_file {

struct FieldShape;

/// What the model file may contain at one place, as found by visiting the field lists. The schema,
/// the reference page and overrides work on this; the reader itself visits the lists directly.
struct Shape {
  enum class Kind {
    quantity,
    integer,
    frame_division,  ///< an integer or one word
    text,
    truth,
    choice,
    time_law,
    position_law,
    marker,
    word_or_marker,
    list,
    reference,  ///< a name, or the record in place
    named,      ///< a map of names to records
    record
  };

  Kind kind = Kind::record;
  std::vector<std::string> choices;      ///< of a choice
  int count = -1;                        ///< of a list; −1: any
  std::vector<Shape> element;            ///< one entry: of a list, reference or named map
  std::vector<FieldShape> fields;        ///< of a record
  std::vector<FieldShape> alternatives;  ///< of a record: exactly one of these keys
  std::type_index type = typeid(void);   ///< of a record, to detect repetitions

  /// The field that may abbreviate the whole record, or null.
  const FieldShape* shorthand() const;
  /// Of two fields that abbreviate a record, that which takes lists.
  const FieldShape* list_shorthand() const;
  /// Field or alternative of that key, or null.
  const FieldShape* find(const std::string& key) const;
  std::vector<std::string> keys() const;
};

struct FieldShape {
  base::FieldNote note;
  Shape shape;
  std::string standard;  ///< value if left out, as text
};

/// Whether one text may replace a list of texts.
inline bool takes_single_text(const Shape& shape) {
  return shape.kind == Shape::Kind::list && shape.count < 0 &&
         shape.element[0].kind == Shape::Kind::text;
}

/// Shape of the whole model file.
const Shape& model_file_shape();

}  // namespace buckens::model_file
