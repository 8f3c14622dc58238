// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "buckens/dynamics/mass_metric.h"
#include "buckens/model/build/build_model.h"
#include "buckens/results/mesh_observer.h"
#include "buckens/results/record_sink.h"
#include "buckens/results/sensor.h"

namespace buckens::results {

/// Turns states into records: poses, nodal displacements, section forces, stresses, joint forces,
/// energies and all sensors of the model file.
class Recorder {
 public:
  /// @param metric and has_redundant_joints: joint forces of redundant joints are distributed with
  /// the least norm
  /// @param pool shares the work, or null; outlives this object. No bit depends on it
  Recorder(const model::BuiltModel& built, const dynamics::MassMetric& metric,
           bool has_redundant_joints, TaskPool* pool = nullptr);
  ~Recorder();

  const RecordLayout& layout() const { return layout_; }
  Geometry geometry() const;

  /// The record of a state. The first call sets the reference of sensors (t = 0).
  /// Cost: a product with M, K and the recovery rows per flexible body.
  /// @param work its balance is not read, but found here
  /// @param energy instead of that of the state, for states between steps
  Record record(const model::State& state, const WorkBalance& work,
                const std::optional<dynamics::Energy>& energy = {});

  /// One value of a sensor.
  struct SensorValue {
    std::size_t sensor = 0;  ///< index into description.output.sensors
    std::size_t place = 0;   ///< among its values
  };
  /// Some values of sensors without the rest of a record. The first call sets the references of
  /// sensors, as that of record() does. Cost: products with M and K only for sensors of energies,
  /// and those with all recovery rows of a body only for its largest stresses.
  std::vector<double> read(const model::State& state, const WorkBalance& work,
                           const std::vector<SensorValue>& values);
  /// Place of the value that a signal reads among those of a sensor.
  /// @throws InputError as results::find_component()
  std::size_t find_component(std::size_t sensor, const model::Signal& signal) const;

  /// Factor of applied loads in the records that follow; one at first.
  void set_load_factor(double factor) { load_factor_ = factor; }

  /// Multipliers of the last record, distributed where joints are redundant.
  const linalg::Vector& last_multipliers() const { return multipliers_; }
  /// Energies of the last record.
  const dynamics::Energy& last_energy() const { return energy_; }
  double last_balance() const { return balance_; }

  /// Saves or restores what later values depend on.
  /// @throws InputError where it does not fit
  void visit_saved(const base::SaveVisit& visit);

 private:
  Observation observe(const model::State& state, const WorkBalance& work);
  void add_energies(const std::optional<dynamics::Energy>& energy, Observation& now);
  void start(const Observation& now);
  void add_channels();
  void add_body_and_joint_channels();
  void add_tables();
  void add_mesh_channels(const model::WholeBody& whole, const fem::FeModel& mesh);
  void append_bodies(const Observation& now, std::vector<double>& values) const;
  void append_joints_and_loads(const Observation& now, std::vector<double>& values) const;

  const model::BuiltModel& built_;
  const dynamics::MassMetric& metric_;
  bool has_redundant_joints_;
  TaskPool* pool_;
  RecordLayout layout_;
  MeshObserver meshes_;
  std::vector<std::size_t> recorded_loads_;  // first of each name, indices into Model::loads
  std::vector<std::unique_ptr<Sensor>> sensors_;
  bool started_ = false;
  double load_factor_ = 1;
  linalg::Vector multipliers_;
  double first_energy_ = 0;
  dynamics::Energy energy_;
  double balance_ = 0;
};

}  // namespace buckens::results
