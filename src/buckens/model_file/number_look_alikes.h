// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "buckens/model_file/yaml_tree.h"

/// Texts that look like numbers and are none; each is told with what to write in its place.
namespace buckens::model_file {

/// What is wrong with "010" (octal elsewhere), or a word that stands for a number or a truth value
/// in other programs; empty for anything else.
/// @param expected what to write in place of a word
std::optional<std::string> look_alike_problem(const std::string& text, const std::string& expected);

/// What is wrong with "1e400" or "1e-400"; empty for anything else.
std::optional<std::string> size_problem(const std::string& formula);

/// The first character of a formula that only looks like one of those it may hold: the minus signs
/// and blanks of word processors, signs of multiplication, π. Empty if there is none.
/// @param has_unit the text may hold a unit, to which ·, ² and ³ belong
std::optional<std::string> foreign_character_problem(const std::string& formula, bool has_unit);

/// A list that has more items than it should because commas within numbers or expressions cut them:
/// "1,5" and "max(1, 2)". Says which, and how to write it; empty for other lists.
/// @param count items that the list should have
std::optional<std::string> cut_item_problem(const YamlNode& list, int count);

}  // namespace buckens::model_file
