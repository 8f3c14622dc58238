// SPDX-License-Identifier: Apache-2.0
// Fields over meshes, against motion and deformation given by hand.
#include "buckens/results/field_recorder.h"

#include <cmath>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "buckens/base/errors.h"
#include "buckens/results/model_geometry.h"
#include "buckens/results/test/recorded.h"
#include "buckens/spatial/rotation.h"

namespace buckens::results {
namespace {

using Eigen::Vector3d;
using model::FieldQuantity;
using model::test::Described;
using model::test::kE;

using VectorField = std::function<Vector3d(const Vector3d&)>;

/// A model with a recorder of fields and a state to be set by hand.
struct Fields {
  std::unique_ptr<model::BuiltModel> built;
  FieldRecorder recorder;
  model::State state;
  Record last;

  explicit Fields(const Described& model)
      : built(model.build()), recorder(*built), state(model::placed_state(built->model)) {}

  void set(std::size_t b, const VectorField& field, linalg::Vector& d) {
    const fem::FeModel& fe = built->model.bodies[b].flexible->mesh();
    linalg::Vector nodal = linalg::Vector::Zero(fe.dofs.num_dofs);
    for (std::size_t n = 0; n < fe.nodes.size(); ++n) {
      const Vector3d u = field(fe.nodes[n].position);
      for (std::size_t k = 0; k < 3; ++k) nodal[fe.dofs.node_dofs[n][k]] = u[static_cast<int>(k)];
    }
    d = built->model.bodies[b].flexible->coordinates(nodal);
  }
  Geometry geometry() const {
    Geometry out = model_geometry(built->model);
    recorder.add_places(out);
    return out;
  }
  /// One row per place.
  Eigen::MatrixXd values(const std::string& path) const {
    const RecordLayout& layout = recorder.layout().fields;
    const int index = layout.find("fields/bodies/" + path);
    if (index < 0) throw std::out_of_range(path);
    const auto k = static_cast<std::size_t>(index);
    const Channel& channel = layout.channel(k);
    const Eigen::Index columns = channel.shape.size() == 1 ? 1 : channel.shape.back();
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    return Eigen::Map<const Rows>(last.values.data() + layout.offset(k), channel.shape[0], columns);
  }
  Eigen::VectorXd largest(const std::string& path) const {
    const RecordLayout& layout = recorder.layout().extremes;
    const auto k = static_cast<std::size_t>(layout.find("extremes/bodies/" + path));
    const std::vector<double> all = recorder.extremes();
    return Eigen::Map<const Eigen::VectorXd>(all.data() + layout.offset(k),
                                             layout.channel(k).shape[0]);
  }
};

Described block(const std::vector<FieldQuantity>& record,
                model::FieldLocation at = model::FieldLocation::both) {
  Described m;
  m.block("block", {0.4, 0.2, 0.2}, {4, 2, 2});
  m.d.output.field_output.emplace();
  m.d.output.field_output->where = model::test::at_line(50);
  m.d.output.field_output->record = record;
  m.d.output.field_output->at = at;
  return m;
}

constexpr double kRate = 1e-4;

Vector3d stretch(const Vector3d& s) { return {kRate * s.x(), 0, 0}; }

TEST(FieldRecorder, NothingIsThereUnlessAskedFor) {
  Described m;
  m.block("block", {0.4, 0.2, 0.2}, {4, 2, 2});
  Fields run(m);
  EXPECT_TRUE(run.recorder.is_empty());
  EXPECT_TRUE(run.geometry().bodies[0].field_nodes.empty());
}

TEST(FieldRecorder, TensorsOfAUniformStretchAreThoseOfHookesLaw) {
  Fields run(block({FieldQuantity::stress, FieldQuantity::strain, FieldQuantity::von_mises,
                    FieldQuantity::principal_stress, FieldQuantity::strain_energy_density}));
  run.set(0, stretch, run.state.bodies[0].d.change());
  run.last = run.recorder.record(run.state);
  const double G = kE / 2.6;
  const double lambda = 2 * G * 0.3 / 0.4;
  const double axial = (lambda + 2 * G) * kRate;
  const double across = lambda * kRate;
  for (const std::string where : {"block/nodes/", "block/elements/"}) {
    const Eigen::MatrixXd stress = run.values(where + "stress");
    EXPECT_EQ(stress.rows(), where == "block/nodes/" ? 45 : 16);
    Eigen::Matrix<double, 1, 6> expected(axial, across, across, 0, 0, 0);
    // Rounding of gradients times E.
    EXPECT_LT((stress.rowwise() - expected).cwiseAbs().maxCoeff(), 1e-10 * axial);
    EXPECT_NEAR(run.values(where + "strain")(3, 0), kRate, 1e-10 * kRate);
    EXPECT_NEAR(run.values(where + "von_mises")(7, 0), axial - across, 1e-10 * axial);
    EXPECT_NEAR(run.values(where + "principal_stress")(2, 0), axial, 1e-10 * axial);
    EXPECT_NEAR(run.values(where + "principal_stress")(2, 2), across, 1e-10 * axial);
    EXPECT_NEAR(run.values(where + "strain_energy_density")(1, 0), 0.5 * axial * kRate,
                1e-10 * axial * kRate);
  }
}

TEST(FieldRecorder, MotionIsThatOfTheNodesInTheWorld) {
  Fields run(
      block({FieldQuantity::displacement, FieldQuantity::velocity, FieldQuantity::acceleration}));
  model::BodyState& s = run.state.bodies[0];
  s.frame.X_WB.q = spatial::exp_rotation(Vector3d(0.3, -0.2, 0.9));
  s.frame.v = {1, 2, 3};
  s.frame.w = {0.5, -1, 2};
  s.v_dot = {4, 5, 6};
  s.w_dot = {-1, 0.5, 0.25};
  run.set(0, stretch, s.d.change());
  run.set(
      0, [](const Vector3d& x) { return Vector3d(0.1 * x.y(), 0, 0.2); }, s.d_dot.change());
  run.set(
      0, [](const Vector3d& x) { return Vector3d(0, 3 * x.z(), 0); }, s.d_ddot.change());
  run.last = run.recorder.record(run.state);
  const int node = 11;
  const Vector3d& at = run.built->model.bodies[0].flexible->fe.nodes[node].position;
  const Vector3d u = stretch(at);
  const Vector3d z = at - run.built->model.bodies[0].com + u;
  const Vector3d u_dot(0.1 * at.y(), 0, 0.2), u_ddot(0, 3 * at.z(), 0);
  const Eigen::Matrix3d R = s.frame.X_WB.R();
  const Vector3d& w = s.frame.w;
  const auto row = [&](const char* name) {
    return Vector3d(run.values(std::string("block/nodes/") + name).row(node));
  };
  EXPECT_LT((row("displacement") - u).norm(), 1e-15);
  EXPECT_LT((row("velocity") - (s.frame.v + R * (w.cross(z) + u_dot))).norm(), 1e-14);
  const Vector3d a =
      s.v_dot + R * (s.w_dot.cross(z) + w.cross(w.cross(z)) + 2 * w.cross(u_dot) + u_ddot);
  EXPECT_LT((row("acceleration") - a).norm(), 1e-14);
  // There is no motion at elements, and no stress was requested.
  EXPECT_EQ(run.recorder.layout().fields.channels().size(), 3U);
  EXPECT_FALSE(run.recorder.has_extremes());
}

TEST(FieldRecorder, KeepsTheLargestStressOfEachNodeAndItsTime) {
  Fields run(block({FieldQuantity::velocity, FieldQuantity::von_mises}));
  const auto at = [&](double t, double factor) {
    run.state.t = t;
    run.set(
        0, [&](const Vector3d& x) { return Vector3d(factor * stretch(x)); },
        run.state.bodies[0].d.change());
  };
  at(0, 1);
  run.last = run.recorder.record(run.state);
  const double one = run.values("block/nodes/von_mises")(0, 0);
  at(0.5, 3);
  run.recorder.watch(run.state);
  at(1, 2);
  run.last = run.recorder.record(run.state);
  for (const std::string where : {"block/nodes/", "block/elements/"}) {
    const Eigen::VectorXd largest = run.largest(where + "von_mises");
    EXPECT_LT((largest.array() - 3 * one).abs().maxCoeff(), 1e-10 * one);
    EXPECT_TRUE((run.largest(where + "von_mises_time").array() == 0.5).all());
  }
}

TEST(FieldRecorder, PlacesOfFacesAreThoseOfTheirCorners) {
  Fields run(block({FieldQuantity::displacement, FieldQuantity::von_mises}));
  const GeometryBody shape = run.geometry().bodies[0];
  ASSERT_EQ(shape.face_places.size(), shape.faces.size());
  EXPECT_EQ(shape.field_elements.size(), 16U);
  EXPECT_EQ(shape.cell_kinds.size(), 16U);
  EXPECT_EQ(shape.cell_nodes.size(), 16U * 8U);
  EXPECT_EQ(shape.cell_kinds[0], fem::CellKind::hex8);
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {
    for (std::size_t c = 0; c < 4; ++c) {
      const int place = shape.face_places[f][c];
      ASSERT_GE(place, 0);
      EXPECT_EQ(shape.field_nodes[static_cast<std::size_t>(place)], shape.faces[f][c]);
    }
  }
}

TEST(FieldRecorder, OneSetOfNodesRecordsThatSetOnly) {
  Described m = block({FieldQuantity::von_mises});
  m.d.output.field_output->on = {"block/x0", "block/centre"};
  Fields run(m);
  const GeometryBody shape = run.geometry().bodies[0];
  EXPECT_EQ(shape.field_nodes.size(), 10U);
  EXPECT_EQ(shape.field_elements.size(), 4U + 8U);  // behind the face, and around the centre
  int known = 0;
  for (const auto& places : shape.face_places) {
    for (const int place : places) known += place >= 0 ? 1 : 0;
  }
  // Corners of faces at the nine nodes of x0: four faces of the end, and the outer ring of sides.
  EXPECT_EQ(known, 4 * 4 + 8 * 2);
}

/// A block in three parts that turns as a whole and is stretched: the same tensors as undivided.
TEST(FieldRecorder, DividedBlocksShowTensorsInTheAxesOfTheWhole) {
  Described divided = block({FieldQuantity::displacement, FieldQuantity::stress});
  divided.d.bodies[0].frames.count = 3;
  Fields one(block({FieldQuantity::displacement, FieldQuantity::stress}));
  Fields three(divided);
  one.set(0, stretch, one.state.bodies[0].d.change());
  one.last = one.recorder.record(one.state);
  const spatial::Pose X{{3, -2, 1}, spatial::exp_rotation(Vector3d(0.5, -1.0, 2.0))};
  for (std::size_t b = 0; b < 3; ++b) {
    model::BodyState& s = three.state.bodies[b];
    const Vector3d com = three.built->model.bodies[b].com;
    // The frame of a part follows its mass centre; only the rest is deformation.
    three.set(
        b, [&](const Vector3d& x) { return Vector3d(stretch(x) - stretch(com)); }, s.d.change());
    s.frame.X_WB.p += stretch(com);
    s.frame.X_WB = X * s.frame.X_WB;
  }
  three.last = three.recorder.record(three.state);
  const GeometryBody shape = three.geometry().bodies[0];
  EXPECT_GT(shape.field_nodes.size(), 45U);  // nodes of the cuts occur once per part
  const Eigen::MatrixXd stress = three.values("block/nodes/stress");
  const Eigen::MatrixXd known = one.values("block/nodes/stress");
  const Eigen::MatrixXd u = three.values("block/nodes/displacement");
  // The frame of the whole follows the parts, and these need not lie symmetric about it.
  const model::WholeBody& whole = three.built->model.wholes[0];
  const spatial::Pose frame = whole_motion(three.built->model, whole, three.state).X_WB;
  const Eigen::Matrix3d turned = (frame.q.conjugate() * X.q).toRotationMatrix();
  const auto turn = [&turned](const Eigen::VectorXd& s) {
    Eigen::Matrix3d T;
    T << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
    T = turned * T * turned.transpose();
    return Eigen::VectorXd(
        Eigen::Vector<double, 6>(T(0, 0), T(1, 1), T(2, 2), T(0, 1), T(1, 2), T(0, 2)));
  };
  for (std::size_t p = 0; p < shape.field_nodes.size(); ++p) {
    const auto row = static_cast<Eigen::Index>(p);
    const int node = shape.field_nodes[p];
    const Vector3d& at = whole.mesh->nodes[static_cast<std::size_t>(node)].position;
    const Vector3d world = X * Vector3d(at + stretch(at));
    const Vector3d expected = frame.q.conjugate() * (world - frame.p) - (at - whole.com);
    EXPECT_LT((Vector3d(u.row(row)) - expected).norm(), 1e-14);  // rounding of metres
    EXPECT_LT((Eigen::VectorXd(stress.row(row)) - turn(known.row(node))).norm(),
              1e-9 * known.norm());
  }
  const Eigen::MatrixXd at_elements = three.values("block/elements/stress");
  const Eigen::MatrixXd known_elements = one.values("block/elements/stress");
  for (Eigen::Index e = 0; e < at_elements.rows(); ++e) {
    EXPECT_LT((Eigen::VectorXd(at_elements.row(e)) - turn(known_elements.row(e))).norm(),
              1e-9 * known.norm());
  }
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {
    for (std::size_t c = 0; c < 4; ++c) {
      const int place = shape.face_places[f][c];
      ASSERT_GE(place, 0);
      EXPECT_EQ(shape.field_nodes[static_cast<std::size_t>(place)], shape.faces[f][c]);
    }
  }
}

TEST(FieldRecorder, ReducedBodiesShowTheStressesOfTheirShape) {
  Described reduced = block({FieldQuantity::velocity, FieldQuantity::stress});
  reduced.d.bodies[0].reduction.free_free.emplace().modes = 6;
  Fields one(block({FieldQuantity::velocity, FieldQuantity::stress}));
  Fields few(reduced);
  model::BodyState& s = few.state.bodies[0];
  ASSERT_TRUE(few.built->model.bodies[0].flexible->is_reduced());
  for (Eigen::Index k = 0; k < s.d.size(); ++k) {
    s.d.change()[k] = 1e-6 * static_cast<double>(k + 1);
    s.d_dot.change()[k] = 1e-4 * static_cast<double>(2 - k);
  }
  one.state.bodies[0].d = few.built->model.bodies[0].flexible->nodal(s.d);
  one.state.bodies[0].d_dot = few.built->model.bodies[0].flexible->nodal(s.d_dot);
  one.last = one.recorder.record(one.state);
  few.last = few.recorder.record(few.state);
  for (const std::string path :
       {"block/nodes/stress", "block/elements/stress", "block/nodes/velocity"}) {
    const Eigen::MatrixXd known = one.values(path);
    EXPECT_GT(known.norm(), 0) << path;
    EXPECT_LT((few.values(path) - known).norm(), 1e-12 * known.norm()) << path;
  }
}

TEST(FieldRecorder, BeamsHaveMotionButNoStressFields) {
  Described m;
  m.beam("rod", {0, 0, 0}, {2, 0, 0}, 2);
  m.d.output.field_output.emplace().record = {FieldQuantity::von_mises, FieldQuantity::velocity};
  Fields run(m);
  run.state.bodies[0].frame.v = {1, 2, 3};
  run.last = run.recorder.record(run.state);
  EXPECT_EQ(run.values("rod/nodes/velocity").row(2), Eigen::RowVector3d(1, 2, 3));
  EXPECT_EQ(run.recorder.layout().fields.find("fields/bodies/rod/nodes/von_mises"), -1);
  m.d.output.field_output->record = {FieldQuantity::von_mises};
  EXPECT_THAT([&] { Fields other(m); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr("no body there has solids")));
}

TEST(FieldRecorder, UnknownPlacesAreNamedWithTheNearestOnes) {
  const auto expect = [](const std::string& on, const char* words) {
    Described m = block({FieldQuantity::von_mises});
    m.rigid("stone", 1, {0, 0, 0}, {1, 1, 1});
    m.d.output.field_output->on = {on};
    EXPECT_THAT([&] { Fields run(m); },
                testing::ThrowsMessage<InputError>(
                    testing::AllOf(testing::HasSubstr(words), testing::HasSubstr("test.yaml:50"))));
  };
  expect("blok", "there is no body \"blok\". Did you mean \"block\"?");
  expect("block/x2", "no interface, face, set or node \"x2\"");
  expect("stone", "body \"stone\" is rigid");
}

}  // namespace
}  // namespace buckens::results
