// SPDX-License-Identifier: Apache-2.0
#include "buckens/fem/solid/strains.h"

#include <algorithm>
#include <map>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "buckens/fem/solid/block.h"
#include "buckens/fem/solid/element.h"
#include "buckens/spatial/principal_axes.h"

namespace buckens::fem {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

using Tensor = Eigen::Matrix<double, 6, 1>;

/// Strain of a displacement gradient ∂u_i/∂x_j.
Tensor strain_of(const Matrix3d& H) {
  Tensor out;
  out << H(0, 0), H(1, 1), H(2, 2), H(0, 1) + H(1, 0), H(1, 2) + H(2, 1), H(0, 2) + H(2, 0);
  return out;
}

Matrix3d matrix_of(const Tensor& s) {
  Matrix3d out;
  out << s[0], s[3], s[5],  //
      s[3], s[1], s[4],     //
      s[5], s[4], s[2];
  return out;
}

/// Gradients of the three inner modes 1 − ξ_a² of hex8 as columns, see solid_stiffness().
Matrix3d inner_gradients(const Vector3d& natural, const Matrix3d& centre_inverse,
                         double volume_ratio) {
  return centre_inverse.transpose() * (-2.0 * volume_ratio * natural).asDiagonal();
}

Matrix3d jacobian_at(const NodeVectors& x, const SolidShape& shape) {
  return x.lazyProduct(shape.slope.transpose());
}

/// Adds to the displacement gradients at the points of a hex8 what its inner modes answer.
/// @param centre Jacobian there
/// @param inverse of their stiffness
void add_inner_modes(const SolidSampling& sampling, const Matrix3d& centre,
                     const std::array<double, 8>& volume, const Elasticity& D,
                     const Eigen::Matrix<double, 9, 9>& inverse, std::array<Matrix3d, 8>& H) {
  const Matrix3d centre_inverse = centre.inverse();
  const double centre_volume = centre.determinant();
  std::array<Matrix3d, 8> g;
  Eigen::Matrix<double, 9, 1> load = Eigen::Matrix<double, 9, 1>::Zero();
  for (std::size_t p = 0; p < sampling.points.size(); ++p) {
    g[p] = inner_gradients(sampling.points[p].natural, centre_inverse, centre_volume / volume[p]);
    const Matrix3d stress = matrix_of(D * strain_of(H[p]));
    load += volume[p] * Matrix3d(stress * g[p]).reshaped();
  }
  const Eigen::Matrix<double, 9, 1> modes = inverse * load;
  for (std::size_t p = 0; p < sampling.points.size(); ++p) {
    H[p] -= modes.reshaped(3, 3) * g[p].transpose();
  }
}

}  // namespace

SolidStrains::SolidStrains(const FeModel& fe, const std::vector<int>& nodes,
                           const std::vector<int>& elements)
    : fe_(fe) {
  std::vector<std::pair<const SolidBlock*, int>> solids;
  for (const auto& block : fe.blocks) {
    const auto* own = dynamic_cast<const SolidBlock*>(block.get());
    for (int e = 0; own != nullptr && e < own->num_elements(); ++e) {
      solids.emplace_back(own, e);
      solid_materials_.push_back(material_of(*own, e));
    }
  }
  std::vector<int> rows(solids.size(), -1);
  for (const int e : elements) {
    rows.at(static_cast<std::size_t>(e)) = num_elements();
    element_materials_.push_back(solid_materials_[static_cast<std::size_t>(e)]);
  }
  add_places(nodes);
  std::vector<int> counts(places_.size());
  int num_inner = 0;
  for (std::size_t e = 0; e < solids.size(); ++e) {
    const auto& [block, index] = solids[e];
    Element element{block, index, rows[e], solid_materials_[e], -1, -1};
    std::vector<int> own;
    for (const int node : block->nodes(index)) own.push_back(place_of(node, static_cast<int>(e)));
    if (std::any_of(own.begin(), own.end(), [](int place) { return place >= 0; })) {
      element.first_corner = static_cast<int>(corner_places_.size());
      corner_places_.insert(corner_places_.end(), own.begin(), own.end());
      for (const int place : own) {
        if (place >= 0) ++counts[static_cast<std::size_t>(place)];
      }
    }
    if (element.first_corner < 0 && element.row < 0) continue;
    if (block->form(index).integration == SolidIntegration::incompatible_modes &&
        element.first_corner >= 0) {
      element.inner = num_inner++;
    }
    elements_.push_back(element);
  }
  inner_.reserve(static_cast<std::size_t>(num_inner));
  for (const Element& element : elements_) {
    if (element.inner >= 0) inner_.push_back(inner_inverse(element));
  }
  for (const int count : counts) share_.push_back(count > 0 ? 1.0 / count : 0.0);
}

int SolidStrains::material_of(const SolidBlock& block, int element) {
  const Elasticity D = solid_elasticity(*block.material(element));
  // Neighbours mostly have the material that came last.
  for (std::size_t k = elasticities_.size(); k-- > 0;) {
    if (elasticities_[k] == D) return static_cast<int>(k);
  }
  elasticities_.push_back(D);
  return static_cast<int>(elasticities_.size()) - 1;
}

void SolidStrains::add_places(const std::vector<int>& nodes) {
  std::vector<std::vector<int>> materials(fe_.nodes.size());
  std::size_t number = 0;
  for (const auto& block : fe_.blocks) {
    const auto* own = dynamic_cast<const SolidBlock*>(block.get());
    for (int e = 0; own != nullptr && e < own->num_elements(); ++e) {
      const int material = solid_materials_[number++];
      for (const int node : own->nodes(e)) {
        auto& there = materials[static_cast<std::size_t>(node)];
        if (std::find(there.begin(), there.end(), material) == there.end()) {
          there.push_back(material);
        }
      }
    }
  }
  first_place_.assign(fe_.nodes.size(), -1);
  for (const int node : nodes) {
    auto& there = materials.at(static_cast<std::size_t>(node));
    first_place_[static_cast<std::size_t>(node)] = static_cast<int>(places_.size());
    std::sort(there.begin(), there.end());
    if (there.empty()) places_.push_back({node, -1});
    for (const int material : there) places_.push_back({node, material});
  }
}

int SolidStrains::place_of(int node, int element) const {
  const int first = first_place_.at(static_cast<std::size_t>(node));
  if (first < 0) return -1;
  // Shells are counted behind the solids.
  const auto e = static_cast<std::size_t>(element);
  const int material = e < solid_materials_.size() ? solid_materials_[e] : -1;
  for (auto p = static_cast<std::size_t>(first); p < places_.size() && places_[p].node == node;
       ++p) {
    if (places_[p].material == material) return static_cast<int>(p);
  }
  return -1;
}

SolidStrains::InnerProducts SolidStrains::inner_inverse(const Element& element) const {
  const NodeVectors x = element.block->positions(fe_.nodes, element.index);
  const Elasticity& D = elasticities_[static_cast<std::size_t>(element.material)];
  const SolidSampling& sampling = solid_sampling(element.block->form(element.index).kind);
  const Matrix3d centre = jacobian_at(x, sampling.centre);
  const Matrix3d centre_inverse = centre.inverse();
  InnerProducts sum = InnerProducts::Zero();
  for (const SolidSampling::Point& point : sampling.points) {
    const double volume = jacobian_at(x, point.shape).determinant();
    const Matrix3d g =
        inner_gradients(point.natural, centre_inverse, centre.determinant() / volume);
    Eigen::Matrix<double, 6, 9> G;
    for (int a = 0; a < 3; ++a) {
      for (int c = 0; c < 3; ++c) {
        Matrix3d H = Matrix3d::Zero();
        H.row(c) = g.col(a).transpose();
        G.col(3 * a + c) = strain_of(H);
      }
    }
    sum.noalias() += volume * G.transpose() * D * G;
  }
  return sum.llt().solve(InnerProducts::Identity());
}

/// Fixed sizes let the compiler unroll.
template <int nodes, class AtNode, class AtCentre>
void SolidStrains::evaluate_element(const Element& element, const linalg::Vector& d,
                                    const AtNode& at_node, const AtCentre& at_centre) const {
  constexpr int kMost = nodes == Eigen::Dynamic ? kMostSolidNodes : nodes;
  using Vectors = Eigen::Matrix<double, 3, nodes, 0, 3, kMost>;
  const std::span<const int> own = element.block->nodes(element.index);
  const auto count = static_cast<Eigen::Index>(own.size());
  Vectors x(3, count), u(3, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto node = static_cast<std::size_t>(own[static_cast<std::size_t>(k)]);
    x.col(k) = fe_.nodes[node].position;
    const auto& dofs = fe_.dofs.node_dofs[node];
    for (int c = 0; c < 3; ++c) {
      const int dof = dofs[static_cast<std::size_t>(c)];
      u(c, k) = dof >= 0 ? d[dof] : 0.0;
    }
  }
  const SolidSampling& sampling = solid_sampling(element.block->form(element.index).kind);
  const auto gradient_at = [&](const SolidShape& shape, double* volume) {
    Vectors slope = shape.slope;
    const Matrix3d J = x.lazyProduct(slope.transpose());
    if (volume != nullptr) *volume = J.determinant();
    return Matrix3d(Matrix3d(u.lazyProduct(slope.transpose())) * J.inverse());
  };
  if (element.row >= 0) {
    at_centre(element.row, strain_of(gradient_at(sampling.centre, nullptr)));
  }
  if (element.first_corner < 0) return;
  const std::size_t num_points = sampling.points.size();
  std::array<Matrix3d, 8> H;
  std::array<double, 8> volume{};
  for (std::size_t p = 0; p < num_points; ++p) {
    H[p] = gradient_at(sampling.points[p].shape, &volume[p]);
  }
  if (element.inner >= 0) {
    add_inner_modes(sampling, jacobian_at(x, sampling.centre), volume,
                    elasticities_[static_cast<std::size_t>(element.material)],
                    inner_[static_cast<std::size_t>(element.inner)], H);
  }
  Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 8> strain(6,
                                                           static_cast<Eigen::Index>(num_points));
  for (std::size_t p = 0; p < num_points; ++p) {
    strain.col(static_cast<Eigen::Index>(p)) = strain_of(H[p]);
  }
  for (Eigen::Index k = 0; k < count; ++k) {
    const int place = corner_places_[static_cast<std::size_t>(element.first_corner + k)];
    if (place >= 0) at_node(place, k, Tensor(strain * sampling.to_nodes.row(k).transpose()));
  }
}

template <class AtNode, class AtCentre>
void SolidStrains::evaluate_any(const Element& element, const linalg::Vector& d,
                                const AtNode& at_node, const AtCentre& at_centre) const {
  switch (element.block->nodes(element.index).size()) {
    case 8:
      return evaluate_element<8>(element, d, at_node, at_centre);
    case 10:
      return evaluate_element<10>(element, d, at_node, at_centre);
    case 20:
      return evaluate_element<20>(element, d, at_node, at_centre);
    default:
      return evaluate_element<Eigen::Dynamic>(element, d, at_node, at_centre);
  }
}

void SolidStrains::add_by_threads(const linalg::Vector& d, TensorColumns& at_places,
                                  TensorColumns& at_elements, TaskPool& pool) const {
  // What so many elements of each thread list stays in its cache. Then threads add, taking places
  // in turns, some cache lines each.
  constexpr std::size_t kAtOnce = 256;
  constexpr int kPlacesInTurn = 8;
  const int threads = pool.available();
  std::vector<std::vector<StrainAtPlace>> lists(static_cast<std::size_t>(threads));
  const auto at_centre = [&](int row, const Tensor& strain) { at_elements.col(row) = strain; };
  std::size_t first = 0;
  const auto list = [&](int k) {
    auto& own = lists[static_cast<std::size_t>(k)];
    own.clear();
    const auto at_node = [&](int place, Eigen::Index /*corner*/, const Tensor& strain) {
      own.push_back({place, share_[static_cast<std::size_t>(place)] * strain});
    };
    const std::size_t begin = first + kAtOnce * static_cast<std::size_t>(k);
    for (std::size_t e = begin; e < std::min(begin + kAtOnce, elements_.size()); ++e) {
      evaluate_any(elements_[e], d, at_node, at_centre);
    }
  };
  const auto add = [&](int k) {
    for (const auto& of_thread : lists) {
      for (const StrainAtPlace& at : of_thread) {
        if (at.place / kPlacesInTurn % threads == k) at_places.col(at.place) += at.strain;
      }
    }
  };
  for (; first < elements_.size(); first += kAtOnce * lists.size()) {
    pool.run(threads, list);
    pool.run(threads, add);
  }
}

void SolidStrains::evaluate(const linalg::Vector& d, TensorColumns& at_places,
                            TensorColumns& at_elements, TaskPool* pool) const {
  at_places.setZero(6, static_cast<Eigen::Index>(places_.size()));
  at_elements.resize(6, num_elements());
  if (pool != nullptr) return add_by_threads(d, at_places, at_elements, *pool);
  const auto at_node = [&](int place, Eigen::Index /*corner*/, const Tensor& strain) {
    at_places.col(place) += share_[static_cast<std::size_t>(place)] * strain;
  };
  const auto at_centre = [&](int row, const Tensor& strain) { at_elements.col(row) = strain; };
  for (const Element& element : elements_) evaluate_any(element, d, at_node, at_centre);
}

EnergyOfError SolidStrains::energy_of_error(const linalg::Vector& d,
                                            const TensorColumns& at_places) const {
  EnergyOfError out;
  TensorColumns own, off;
  const auto at_node = [&](int place, Eigen::Index corner, const Tensor& strain) {
    own.col(corner) = strain;
    off.col(corner) = at_places.col(place) - strain;
  };
  const auto at_centre = [](int /*row*/, const Tensor& /*strain*/) {};
  for (const Element& element : elements_) {
    if (element.first_corner < 0) continue;
    const auto count = static_cast<Eigen::Index>(element.block->nodes(element.index).size());
    own.setZero(6, count);
    off.setZero(6, count);
    evaluate_any(element, d, at_node, at_centre);
    const Elasticity& D = elasticities_[static_cast<std::size_t>(element.material)];
    const NodeProducts V =
        solid_volume_products(element.block->form(element.index).kind,
                              element.block->positions(fe_.nodes, element.index));
    out.error += (D * off * V).cwiseProduct(off).sum();
    out.energy += (D * own * V).cwiseProduct(own).sum();
  }
  return out;
}

void SolidStrains::stresses(const TensorColumns& strain_at_places,
                            const TensorColumns& strain_at_elements, TensorColumns& at_places,
                            TensorColumns& at_elements, TaskPool* pool) const {
  at_places.setZero(6, strain_at_places.cols());
  run_ranges(pool, static_cast<int>(at_places.cols()), [&](int begin, int end) {
    for (int p = begin; p < end; ++p) {
      const int material = places_[static_cast<std::size_t>(p)].material;
      if (material < 0) continue;
      at_places.col(p) =
          elasticities_[static_cast<std::size_t>(material)] * strain_at_places.col(p);
    }
  });
  at_elements.resize(6, strain_at_elements.cols());
  run_ranges(pool, static_cast<int>(at_elements.cols()), [&](int begin, int end) {
    for (int e = begin; e < end; ++e) {
      const int material = element_materials_[static_cast<std::size_t>(e)];
      at_elements.col(e) =
          elasticities_[static_cast<std::size_t>(material)] * strain_at_elements.col(e);
    }
  });
}

Vector3d principal_stresses(const Eigen::Ref<const Tensor>& s) {
  return spatial::principal_values(matrix_of(s)).reverse();
}

}  // namespace buckens::fem
