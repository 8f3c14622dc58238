// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "buckens/model_file/yaml_tree.h"

/// Texts that look like numbers but are not; each is reported with what to write instead.
namespace buckens::model_file {

/// What is wrong with "010" (octal elsewhere), or a word that denotes a number or a boolean in
/// other programs; empty for anything else.
/// @param expected what to write instead of a word
std::optional<std::string> look_alike_problem(const std::string& text, const std::string& expected);

/// What is wrong with "1e400" or "1e-400"; empty for anything else.
std::optional<std::string> size_problem(const std::string& formula);

/// The first character of a formula that only looks like a permitted one: the minus signs and
/// blanks of word processors, multiplication signs, π. Empty if there is none.
/// @param has_unit the text may contain a unit, in which ·, ² and ³ are permitted
std::optional<std::string> foreign_character_problem(const std::string& formula, bool has_unit);

/// A list with more items than it should have because commas within numbers or expressions split
/// them: "1,5" and "max(1, 2)". Says which, and how to write it; empty for other lists.
/// @param count items that the list should have
std::optional<std::string> cut_item_problem(const YamlNode& list, int count);

}  // namespace buckens::model_file
