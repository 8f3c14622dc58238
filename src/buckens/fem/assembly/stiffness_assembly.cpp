// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/assembly/stiffness_assembly.h"

#include <algorithm>
#include <optional>
#include <span>

#include "buckens/fem/assembly/element_pieces.h"
#include "buckens/fem/assembly/entry_sums.h"

namespace buckens::fem {

StiffnessMatrices assemble_stiffness(const std::vector<std::shared_ptr<const ElementBlock>>& blocks,
                                     const MeshView& mesh) {
  TaskPool* pool = mesh.pool;
  EntrySums K(blocks, mesh.dofs, pool);
  std::optional<EntrySums> K_damping;
  std::vector<StiffnessSum> sums(pool != nullptr ? static_cast<std::size_t>(pool->threads()) : 1);
  const auto lists = [&sums](std::vector<linalg::Triplet> StiffnessSum::*entries) {
    std::vector<std::span<const linalg::Triplet>> out;
    for (const StiffnessSum& sum : sums) out.emplace_back(sum.*entries);
    return out;
  };
  for (const auto& block : blocks) {
    const ElementPieces pieces(*block, mesh.nodes);
    const auto at_once = static_cast<int>(sums.size());
    for (int first = 0; first < pieces.count(); first += at_once) {
      run_tasks(pool, at_once, [&](int k) {
        StiffnessSum& sum = sums[static_cast<std::size_t>(k)];
        sum.K.clear();
        sum.K_damping.clear();
        if (first + k >= pieces.count()) return;
        pieces.visit(first + k,
                     [&](const ElementBlock& piece, int) { piece.add_stiffness(mesh, sum); });
      });
      K.add(lists(&StiffnessSum::K), pool);
      const bool is_damped = std::any_of(
          sums.begin(), sums.end(), [](const StiffnessSum& sum) { return !sum.K_damping.empty(); });
      if (!is_damped) continue;
      if (!K_damping) K_damping.emplace(blocks, mesh.dofs, pool);
      K_damping->add(lists(&StiffnessSum::K_damping), pool);
    }
  }
  linalg::SparseMatrix undamped(mesh.dofs.num_dofs, mesh.dofs.num_dofs);
  return {K.take(), K_damping ? K_damping->take() : undamped};
}

}  // namespace buckens::fem
