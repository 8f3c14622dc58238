// SPDX-License-Identifier: Apache-2.0
#include "buckens/stepping/strand/mechanism.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <utility>

#include "buckens/body/body_lengths.h"
#include "buckens/body/second_moments.h"

namespace buckens::stepping {

using Eigen::Index;
using linalg::Matrix;
using strand::BodyRows;
using strand::entry;
using strand::FixedRows;
using strand::kLanes;
using strand::kSlots;
using strand::MeshRows;
using strand::Plane;
using strand::Space;

namespace {

/// Pairs (a, b) of W_ab and of patterns in the order of the tables, as numbers of body::kPairs.
template <class S>
constexpr std::array<int, S::P> pairs() {
  if constexpr (S::T == 2) {
    return {0, 1, 3};
  } else {
    return {0, 1, 2, 3, 4, 5};
  }
}

// Of blocks laid out last, to find equal ones.
constexpr std::size_t kTablesCompared = 8;
// Numbers that are allocated at once: more and more of them, so that large models lie on huge
// pages.
constexpr std::size_t kFirstChunk = std::size_t{1} << 14, kLargestChunk = std::size_t{1} << 20;

/// Places of an inertia's entries in a matrix.
template <class S>
constexpr std::array<std::array<int, 2>, S::J> inertia_entries() {
  if constexpr (S::T == 2) {
    return {{{2, 2}, {0, 0}, {1, 1}, {0, 1}}};
  } else {
    return {{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
  }
}

/// Variable of a node along one of the components of the tables: translations, then rotations.
template <class S>
int component(int k) {
  if constexpr (S::T == 2) return k < 2 ? k : 5;
  return k;
}

/// A matrix that is symmetric to rounding, as sieved K̂⁻¹ is: parts can move freely and are damped
/// by M and K. @param order place in the tables of every variable
void put_half(double* fixed, int row, const std::vector<int>& order, const Matrix& values) {
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const auto a = static_cast<Index>(i), b = static_cast<Index>(j);
      entry(fixed, row + strand::symmetric_place(order[i], order[j])) =
          0.5 * (values(a, b) + values(b, a));
    }
  }
}

}  // namespace

double* StrandMechanism::rows(int count) {
  const auto size = static_cast<std::size_t>(kLanes * count);
  if (memory_.empty() || used_ + size > memory_.back().size()) {
    const std::size_t last = memory_.empty() ? kFirstChunk / 2 : memory_.back().size();
    memory_.emplace_back(std::max(size, std::min(2 * last, kLargestChunk)));
    used_ = 0;
  }
  double* const out = memory_.back().data() + used_;
  used_ += size;
  std::fill_n(out, size, 0.0);
  return out;
}

StrandMechanism::StrandMechanism(const model::Model& model, const Scheme& scheme,
                                 const Operators& operators, linalg::SimdLevel level)
    : model_(model), is_planar_(model.planar.has_value()) {
  kernels_ = is_planar_ ? &strand::plane_kernels(level) : &strand::space_kernels(level);
  set_constants(scheme, operators);
  is_planar_ ? lay_out<Plane>(operators) : lay_out<Space>(operators);
}

void StrandMechanism::set_constants(const Scheme& scheme, const Operators& operators) {
  const auto of_rate = scheme.history(1.0, 0.0, 0.0);
  const auto of_accel = scheme.history(0.0, 1.0, 0.0);
  const auto of_alg = scheme.history(0.0, 0.0, 1.0);
  const auto weights = [&](double History<double>::*member) {
    return strand::Weights{0.0, of_rate.*member, of_accel.*member, of_alg.*member};
  };
  strand::Constants& is = constants_;
  is.s1 = scheme.end_rate;
  is.s2 = scheme.acceleration_rate;
  is.c = scheme.force;
  is.mass = scheme.mass;
  is.damping = scheme.damping;
  is.side_load = scheme.force;
  is.velocity = weights(&History<double>::velocity);
  is.acceleration = weights(&History<double>::acceleration);
  is.predicted = weights(&History<double>::predicted);
  is.alg_before = scheme.algorithmic(1.0, 0.0, 0.0);
  is.alg_old = scheme.algorithmic(0.0, 1.0, 0.0);
  is.alg_new = scheme.algorithmic(0.0, 0.0, 1.0);
  is.L = model_.length;
  for (int k = 0; k < 3; ++k) is.gravity[k] = model_.gravity[k];
  // As in LargeStep, with θ = 1 and no offset.
  const auto combine = [](double d, const strand::Weights& a, double factor) {
    return strand::Weights{d + factor * a.d, factor * a.rate, factor * a.accel, factor * a.alg};
  };
  is.with_mass = combine(scheme.mass, is.acceleration, -scheme.force);
  for (BodyStepOperator* const op : operators) {
    if (op == nullptr || !op->inertial().is_damped()) continue;
    const strand::Weights with_damping = combine(scheme.damping, is.velocity, -scheme.force);
    is.is_damped = true;
    is.with_mass.d += op->inertial().zeta() * with_damping.d;
    is.with_mass.rate += op->inertial().zeta() * with_damping.rate;
    is.with_mass.accel += op->inertial().zeta() * with_damping.accel;
    is.with_mass.alg += op->inertial().zeta() * with_damping.alg;
    is.beside = combine(0.0, with_damping, op->inertial().share());
    break;  // suits() has compared the others
  }
  for (const body::Body& body : model_.bodies) {
    if (!body.is_flexible()) continue;
    const body::CouplingTerms& terms = body.flexible->coupling.terms;
    is.jvar = terms.jvar;
    is.cor_ref = terms.cor_ref;
    is.cent0 = terms.cent0;
    is.quad_ref = terms.quad_ref;
    is.cent1 = terms.cent1;
    is.cor_fe = terms.cor_fe;
    is.eul_fe = terms.eul_fe;
    break;
  }
}

template <class S>
void StrandMechanism::lay_out(const Operators& operators) {
  const std::size_t count = model_.bodies.size();
  bodies_.resize(count);
  orders_.resize(count);
  slots_.assign(count, {-1, -1});
  for (const model::Joint& joint : model_.joints) {
    for (const model::MarkerId* id : {&joint.first, &joint.second}) {
      if (id->body == model::kGround) continue;
      const auto b = static_cast<std::size_t>(id->body);
      if (model_.bodies[b].is_flexible()) continue;
      auto& slots = slots_[b];
      if (slots[0] == id->marker || slots[1] == id->marker) continue;
      slots[slots[0] < 0 ? 0 : 1] = id->marker;
    }
  }
  for (const bool has_mesh : {false, true}) {
    std::vector<std::size_t> kind;
    for (std::size_t b = 0; b < count; ++b) {
      if (model_.bodies[b].is_flexible() == has_mesh) kind.push_back(b);
    }
    for (std::size_t first = 0; first < kind.size(); first += kLanes) {
      std::array<std::size_t, kLanes> members;
      for (std::size_t k = 0; k < kLanes; ++k) {
        // Idle lanes are like the first, so that their numbers are ordinary ones.
        members[k] = kind[first + k < kind.size() ? first + k : first];
      }
      lay_out_block<S>(members, operators, has_mesh);
      const auto end = std::min(first + kLanes, kind.size());
      members_.emplace_back(kind.begin() + static_cast<std::ptrdiff_t>(first),
                            kind.begin() + static_cast<std::ptrdiff_t>(end));
    }
  }
  lay_out_joints<S>();
  lay_out_pairs<S>();
  sweep_ = strand::Sweep(body_blocks_, joint_blocks_);
}

template <class S>
void StrandMechanism::lay_out_block(const std::array<std::size_t, kLanes>& members,
                                    const Operators& operators, bool has_mesh) {
  strand::BodyBlock& block = body_blocks_.emplace_back();
  block.has_mesh = has_mesh;
  block.rows = rows(has_mesh ? MeshRows<S>::count : BodyRows<S>::count);
  double* const fixed = has_mesh ? rows(FixedRows<S>::count) : nullptr;
  for (std::size_t k = kLanes; k-- > 0;) {  // the first last: idle lanes are not where it is
    const std::size_t b = members[k];
    bodies_[b] = {block.rows + k, has_mesh};
    fill_body<S>(b);
    if (has_mesh) fill_mesh<S>(b, *operators[b], fixed + k);
    if (k > 0 && b == members[0]) entry(bodies_[b].at, BodyRows<S>::mass) = 0.0;
  }
  if (!has_mesh) return;
  block.fixed = shared_table(fixed, FixedRows<S>::count);
  for (std::size_t k = kLanes; k-- > 0;) bodies_[members[k]].fixed = block.fixed + k;
  collect_integrals<S>(members, block);
}

const double* StrandMechanism::shared_table(double* table, int count) {
  const std::size_t size = sizeof(double) * static_cast<std::size_t>(kLanes * count);
  const auto same = std::find_if(fixed_.begin(), fixed_.end(), [&](const Table& known) {
    return known.count == count && std::memcmp(known.rows, table, size) == 0;
  });
  if (same != fixed_.end()) {
    used_ -= static_cast<std::size_t>(kLanes * count);
    return same->rows;
  }
  // Alike blocks follow one another.
  if (fixed_.size() == kTablesCompared) fixed_.erase(fixed_.begin());
  fixed_.push_back({table, count});
  return table;
}

template <class S>
void StrandMechanism::fill_body(std::size_t b) {
  using Row = BodyRows<S>;
  const body::Body& body = model_.bodies[b];
  double* const t = bodies_[b].at;
  entry(t, Row::q) = 1.0;
  entry(t, Row::mass) = body.mass;
  entry(t, Row::tau) = 1.0 / (constants_.mass * body.mass);
  for (int k = 0; k < S::J; ++k) {
    const auto [i, j] = inertia_entries<S>()[static_cast<std::size_t>(k)];
    entry(t, Row::J0 + k) = body.J0(i, j);
  }
  if (body.is_flexible()) return;
  for (int slot = 0; slot < kSlots; ++slot) {
    const int marker = slots_[b][static_cast<std::size_t>(slot)];
    if (marker < 0) continue;
    const Eigen::Vector3d& z = body.markers[static_cast<std::size_t>(marker)].X_BF.p;
    for (int k = 0; k < S::T; ++k) entry(t, Row::z0 + slot * S::T + k) = z[k];
  }
}

template <class S>
void StrandMechanism::fill_mesh(std::size_t b, BodyStepOperator& op, double* fixed) {
  using Row = MeshRows<S>;
  using Fixed = FixedRows<S>;
  constexpr int N = Row::N;
  const body::Body& body = model_.bodies[b];
  const body::FlexiblePart& part = *body.flexible;
  double* const t = bodies_[b].at;
  std::vector<int>& order = orders_[b];
  order.assign(static_cast<std::size_t>(N), 0);
  for (std::size_t node = 0; node < kSlots; ++node) {
    for (int k = 0; k < S::F; ++k) {
      const int dof = part.fe.dofs.node_dofs[node][static_cast<std::size_t>(component<S>(k))];
      order[static_cast<std::size_t>(dof)] = static_cast<int>(node) * S::F + k;
    }
    const Eigen::Vector3d z = part.fe.nodes[node].position - body.com;
    for (int k = 0; k < S::T; ++k) {
      entry(t, Row::z0 + static_cast<int>(node) * S::T + k) = z[k];
    }
  }
  const auto at = [&](Index i) { return order[static_cast<std::size_t>(i)]; };
  const auto set_vector = [&](int row, const linalg::Vector& values) {
    for (Index i = 0; i < N; ++i) entry(fixed, row + at(i)) = values[i];
  };
  const auto set_matrix = [&](int row, const Matrix& values) {
    put_half(fixed, row, order, values);
  };
  Matrix inverse(N, N);
  for (Index j = 0; j < N; ++j) {
    linalg::Vector unit = linalg::Vector::Unit(N, j);
    op.solve_right_side(unit);
    inverse.col(j) = unit;
  }
  Matrix inertia = op.scheme().mass * Matrix(part.fe.M.whole());
  if (part.is_damped()) inertia += op.scheme().damping * Matrix(part.C.whole());
  set_matrix(Fixed::A, inverse);
  set_matrix(Fixed::B, inverse * (inertia * inverse) - inverse);
  set_matrix(Fixed::Mass, Matrix(part.fe.M.whole()));
  for (int k = 0; k < part.sieve.rank(); ++k) {
    set_vector(Fixed::Phi + k * N, part.sieve.stored_Phi().col(k));
    set_vector(Fixed::Pi + k * N, part.sieve.stored_P().col(k));
  }
  const linalg::Vector inverse_diagonal = op.K_hat_diagonal().cwiseInverse();
  set_vector(Fixed::inverse, inverse_diagonal);
  set_vector(Fixed::per_load, body::coordinate_lengths(body).cwiseProduct(inverse_diagonal));
  if (!op.has_patterns()) return;
  const Matrix& patterns = part.invariants.stored_patterns();
  const Matrix undeformed = patterns.transpose() * (inverse_diagonal.asDiagonal() * patterns);
  entry(fixed, Fixed::per_pattern) = 1.0 / (body.mass * body.length_scale());
  for (int i = 0; i < S::P; ++i) {
    const int pair = pairs<S>()[static_cast<std::size_t>(i)];
    set_vector(Fixed::pat + i * N, patterns.col(pair));
    for (int j = 0; j < S::P; ++j) {
      entry(fixed, Fixed::und + S::P * i + j) =
          undeformed(pair, pairs<S>()[static_cast<std::size_t>(j)]);
    }
  }
}

template <class S>
void StrandMechanism::collect_integrals(const std::array<std::size_t, kLanes>& bodies,
                                        strand::BodyBlock& block) {
  // Per pair and column the entries that some lane has.
  std::map<std::array<int, 3>, std::array<double, kLanes>> found;
  for (std::size_t lane = 0; lane < bodies.size(); ++lane) {
    const std::vector<int>& order = orders_[bodies[lane]];
    const auto& shape = model_.bodies[bodies[lane]].flexible->fe.shape;
    for (const int pair : pairs<S>()) {
      const linalg::SparseMatrix& W = shape.W[static_cast<std::size_t>(pair)];
      for (int j = 0; j < W.outerSize(); ++j) {
        for (linalg::SparseMatrix::InnerIterator it(W, j); it; ++it) {
          if (it.value() == 0.0) continue;
          auto& values = found[{pair, order[static_cast<std::size_t>(j)],
                                order[static_cast<std::size_t>(it.row())]}];
          values[lane] += it.value();
        }
      }
    }
  }
  auto made = std::make_unique<Integrals>();
  Integrals& out = *made;
  const int size = std::max(1, static_cast<int>(found.size()));
  double* const table = rows(size);
  for (const auto& [key, values] : found) {
    const auto [pair, column, row] = key;
    const auto [a, b] = body::kPairs[static_cast<std::size_t>(pair)];
    const int count = static_cast<int>(out.entries.size());
    if (out.columns.empty() || out.columns.back().a != a || out.columns.back().b != b ||
        out.columns.back().column != column) {
      out.columns.push_back({a, b, column, count, count});
    }
    std::copy(values.begin(), values.end(), table + kLanes * count);
    out.entries.push_back(row);
    out.columns.back().end = count + 1;
  }
  out.values = shared_table(table, size);
  if (!integrals_.empty() && integrals_.back()->is_same(out)) {
    made.reset();
  } else {
    integrals_.push_back(std::move(made));
  }
  const Integrals& kept = *integrals_.back();
  block.num_columns = static_cast<int>(kept.columns.size());
  block.columns = kept.columns.data();
  block.entries = kept.entries.data();
  block.values = kept.values;
}

}  // namespace buckens::stepping
