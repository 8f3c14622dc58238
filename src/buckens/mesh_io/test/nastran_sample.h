// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/mesh_io/nastran/deck.h"

namespace buckens::mesh_io::test {

inline fem::ImportedMesh read_deck(const std::string& text) {
  return read_nastran_text(text, "deck.bdf");
}

/// The message refusing a deck; "" if it is read.
inline std::string refusal(const std::string& text) {
  try {
    read_deck(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

inline void expect_words(const std::string& message, const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    EXPECT_NE(message.find(word), std::string::npos) << '"' << word << "\" in: " << message;
  }
}

inline bool has_note(const fem::ImportedMesh& mesh, const std::string& part) {
  for (const fem::ImportNote& note : mesh.notes) {
    if (note.text.find(part) != std::string::npos) return true;
  }
  return false;
}

/// A tetrahedron of steel: nodes 1 to 4, element 1, property 1, material 1.
inline const std::string kTetra =
    "GRID,1,,0.,0.,0.\n"
    "GRID,2,,1.,0.,0.\n"
    "GRID,3,,0.,1.,0.\n"
    "GRID,4,,0.,0.,1.\n"
    "CTETRA,1,1,1,2,3,4\n"
    "PSOLID,1,1\n"
    "MAT1,1,2.1+11,,.3,7850.\n";

}  // namespace buckens::mesh_io::test
