// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "buckens/linalg/block_lu.h"
#include "buckens/linalg/streaming_memory.h"
#include "buckens/model/model.h"
#include "buckens/stepping/body_step_operator.h"
#include "buckens/stepping/strand/layout.h"
#include "buckens/stepping/strand/sweep.h"

namespace buckens::stepping {

namespace strand {
/// A row of the lane at which `at` points.
inline double& entry(double* at, int row) { return at[static_cast<std::ptrdiff_t>(kLanes) * row]; }
}  // namespace strand

/// A mechanism of small bodies laid out in lanes: parts of divided beams and rigid links with two
/// markers, held by coincident points and perpendicular directions.
///
/// Bodies stand in blocks of eight, each number of theirs in a row of eight lanes
/// (layout.h); rigid bodies and parts have blocks of their own. Joints and the pairs of
/// joints that meet on a body stand in blocks likewise. All parts may have matrices of their own.
class StrandMechanism {
 public:
  /// The step operators of all bodies, null of rigid ones.
  using Operators = std::vector<BodyStepOperator*>;
  /// Where a body or a joint is.
  struct Place {
    double* at = nullptr;  ///< first row, its lane
    bool has_mesh = false;
    const double* fixed = nullptr;  ///< the same of what is constant of a part
  };

  /// Whether all bodies and joints of a model are of this kind, nothing else acts but gravity and
  /// loads that StrandLoads can take, and there are enough of them.
  static bool suits(const model::Model& model, const Scheme& scheme, const Operators& operators);

  /// Node of a part whose variables are the rows of a marker there, −1: none of its two.
  static int node_of(const body::Body& body, const body::Marker& marker);

  /// @param operators of a model that suits()
  StrandMechanism(const model::Model& model, const Scheme& scheme, const Operators& operators,
                  linalg::SimdLevel level);
  StrandMechanism(const StrandMechanism&) = delete;
  StrandMechanism& operator=(const StrandMechanism&) = delete;

  bool is_planar() const { return is_planar_; }
  const strand::Kernels& kernels() const { return *kernels_; }
  strand::Constants& constants() { return constants_; }
  const strand::Constants& constants() const { return constants_; }
  std::vector<strand::BodyBlock>& body_blocks() { return body_blocks_; }
  /// Bodies of a block, by lanes.
  const std::vector<std::size_t>& members(std::size_t block) const { return members_[block]; }
  std::vector<strand::JointBlock>& joint_blocks() { return joint_blocks_; }
  const std::vector<strand::PairBlock>& pair_blocks() const { return pair_blocks_; }
  /// Goes through both.
  const strand::Sweep& sweep() const { return sweep_; }
  linalg::BlockLu& matrix() { return *matrix_; }
  const Place& body(std::size_t b) const { return bodies_[b]; }
  /// First of the multipliers of a joint, its lane.
  double* multipliers(std::size_t joint) const { return multipliers_[joint]; }
  /// Movements of a node of a part count where an iteration's end is looked for.
  void watch_node(std::size_t b, int node);
  /// Place in the tables of every nodal variable of a part.
  const std::vector<int>& order(std::size_t b) const { return orders_[b]; }

 private:
  template <class S>
  void lay_out(const Operators& operators);
  template <class S>
  void lay_out_block(const std::array<std::size_t, strand::kLanes>& members,
                     const Operators& operators, bool has_mesh);
  template <class S>
  void fill_body(std::size_t b);
  template <class S>
  void fill_mesh(std::size_t b, BodyStepOperator& op, double* fixed);
  template <class S>
  void collect_integrals(const std::array<std::size_t, strand::kLanes>& bodies,
                         strand::BodyBlock& block);
  /// The last result of rows(), or another table with the same numbers, which then is given up.
  const double* shared_table(double* table, int count);
  /// @return the marker's turn in its body
  template <class S>
  Eigen::Matrix3d place_end(const model::MarkerId& id, int end, int lane,
                            strand::JointBlock& block);
  int slot_of(const model::MarkerId& id) const;
  template <class S>
  void place_joint(std::size_t j, int lane, strand::JointBlock& block);
  template <class S>
  void lay_out_joints();
  template <class S>
  void lay_out_pairs();
  void set_constants(const Scheme& scheme, const Operators& operators);
  double* rows(int count);

  /// What a block has of the integrals W_ab of its parts.
  struct Integrals {
    std::vector<strand::IntegralColumn> columns;
    std::vector<int> entries;
    const double* values = nullptr;

    bool is_same(const Integrals& other) const {
      return values == other.values && entries == other.entries && columns == other.columns;
    }
  };
  struct Table {
    const double* rows;
    int count;
  };

  const model::Model& model_;
  bool is_planar_;
  const strand::Kernels* kernels_;
  strand::Constants constants_;
  std::vector<linalg::StreamingMemory> memory_;
  std::size_t used_ = 0;      // of the last one
  std::vector<Table> fixed_;  // the last ones that are shared
  std::vector<strand::BodyBlock> body_blocks_;
  std::vector<std::vector<std::size_t>> members_;
  std::vector<std::unique_ptr<Integrals>> integrals_;
  std::vector<strand::JointBlock> joint_blocks_;
  std::vector<strand::PairBlock> pair_blocks_;
  strand::Sweep sweep_;
  std::unique_ptr<linalg::BlockLu> matrix_;
  std::vector<Place> bodies_;
  std::vector<std::vector<int>> orders_;
  std::vector<std::array<int, strand::kSlots>> slots_;  // markers of every body, −1: none
  double* ground_ = nullptr;
  std::vector<double*> multipliers_;
  std::vector<std::array<const double*, 2>> sides_;  // of every joint
};

}  // namespace buckens::stepping
