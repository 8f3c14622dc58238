// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "buckens/body/reduced_basis.h"

namespace buckens::body {

/// Stores reduced bases between runs.
class BasisStore {
 public:
  virtual ~BasisStore() = default;
  /// The basis stored under a file name; empty if there is none.
  /// @param key of the body and its choice, see basis_key()
  /// @throws InputError if the file belongs to another key
  virtual std::optional<ReducedBasis> find(const std::string& file, std::uint64_t key) = 0;
  virtual void keep(const std::string& file, std::uint64_t key, const ReducedBasis& basis) = 0;
};

/// Hash of the mass, stiffness, interface rows and inertia integrals of a body, and of the text
/// that describes the choice of a basis.
std::uint64_t basis_key(const FlexiblePart& part, const std::string& choice);

}  // namespace buckens::body
