// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "buckens/base/characteristic.h"
#include "buckens/base/expression.h"
#include "buckens/base/field.h"
#include "buckens/base/name_index.h"
#include "buckens/base/signal_law.h"
#include "buckens/base/time_law.h"
#include "buckens/body/frame_division.h"
#include "buckens/model/check/finding.h"
#include "buckens/model/spec/initial_spec.h"
#include "buckens/model_file/yaml_tree.h"

namespace buckens::model {
struct ModelDescription;
}

namespace buckens::model_file {

class StepMeshCache;

/// What a value may refer to while a model file is read.
struct ReadContext {
  base::Parameters parameters;
  std::vector<std::string> signals;                ///< names of all, in their order
  std::filesystem::path directory;                 ///< relative file names begin here
  const model::ModelDescription* model = nullptr;  ///< what has been read so far
  mutable base::NameIndex bodies;                  ///< of its bodies
  StepMeshCache* step_meshes = nullptr;
};

/// A value of the model file under a field.
struct ReadPlace {
  const YamlNode& node;
  std::string path;  ///< "bodies.rod.beam.elements"
};

using model::join_path;

/// @throws InputError "file:line:column: path: message"
[[noreturn]] void fail(const ReadPlace& place, const std::string& message);

/// A formula and the SI value of its unit.
struct Formula {
  base::Expression expression;
  double scale = 1;
};

/// Reads "10*sin(t) N" and the like with the given variables, checking the unit's dimension.
Formula read_formula(const ReadPlace& place, const base::FieldNote& note,
                     const std::vector<std::string>& variables, const ReadContext& context);

/// A number in SI units, from a number, a quantity or an expression of parameters. The field's
/// range is checked.
double read_quantity(const ReadPlace& place, const base::FieldNote& note,
                     const ReadContext& context);

int read_integer(const ReadPlace& place, const base::FieldNote& note, const ReadContext& context);
/// An integer or `per-element`.
body::FrameDivision read_frames(const ReadPlace& place, const base::FieldNote& note,
                                const ReadContext& context);
bool read_truth(const ReadPlace& place, const base::FieldNote& note);
std::string read_text(const ReadPlace& place);

/// Index of a word among the allowed ones. `planned` words get a separate error.
std::size_t read_choice(const ReadPlace& place, const std::vector<std::string>& allowed,
                        const std::vector<std::string>& planned);

/// A number, an expression of t, or a table.
base::TimeLaw read_time_law(const ReadPlace& place, const base::FieldNote& note,
                            const ReadContext& context);
/// A law of time, or an expression of t and signals.
base::SignalLaw read_signal_law(const ReadPlace& place, const base::FieldNote& note,
                                const ReadContext& context);
/// A number, an expression of displacement and rate, or a table of the displacement.
base::Characteristic read_characteristic(const ReadPlace& place, const base::FieldNote& note,
                                         const ReadContext& context);
model::PositionLaw read_position_law(const ReadPlace& place, const base::FieldNote& note,
                                     const ReadContext& context);

/// "a length such as 75 mm": what a field expects, with an example.
std::string expectation(const base::FieldNote& note);

}  // namespace buckens::model_file
