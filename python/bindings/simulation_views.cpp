// SPDX-License-Identifier: Apache-2.0
// What a simulation shows to Python.
#include <algorithm>

#include "bindings/simulation_handle.h"

namespace py = pybind11;

namespace buckens::python {

namespace {

constexpr py::ssize_t kFrameNumbers = 18;

}  // namespace

double SimulationHandle::time() const { return simulation_->time(); }
double SimulationHandle::end_time() const { return simulation_->end_time(); }
long SimulationHandle::num_steps() const { return simulation_->num_steps(); }
bool SimulationHandle::is_done() const { return simulation_->is_done(); }

/// An array without copy, which keeps the simulation alive.
py::array SimulationHandle::view(double* data, std::vector<py::ssize_t> shape) {
  py::array_t<double> out(std::move(shape), data, py::cast(shared_from_this()));
  py::detail::array_proxy(out.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return out;
}

py::array SimulationHandle::frame(const std::string& body) {
  require_at_rest("frame");
  simulation_->frame(body);  // refuses unknown names before anything is kept
  std::vector<double>& table = tables_["frame/" + body];
  table.resize(kFrameNumbers);
  const auto fill = [this, body, &table] {
    const body::FrameMotion frame = simulation_->frame(body);
    const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> R = frame.X_WB.R();
    double* out = table.data();
    out = std::copy_n(frame.X_WB.p.data(), 3, out);
    out = std::copy_n(R.data(), 9, out);
    out = std::copy_n(frame.v.data(), 3, out);
    std::copy_n(frame.w.data(), 3, out);
  };
  fill();
  refreshes_["frame/" + body] = fill;
  return view(table.data(), {kFrameNumbers});
}

py::array SimulationHandle::displacements(const std::string& body) {
  require_at_rest("displacements");
  const auto map = simulation_->displacements(body);
  refreshes_["displacements/" + body] = [this, body] { simulation_->displacements(body); };
  return view(const_cast<double*>(map.data()), {map.rows(), map.cols()});
}

py::array SimulationHandle::velocities(const std::string& body) {
  require_at_rest("velocities");
  const auto map = simulation_->velocities(body);
  refreshes_["velocities/" + body] = [this, body] { simulation_->velocities(body); };
  return view(const_cast<double*>(map.data()), {map.rows(), map.cols()});
}

py::array SimulationHandle::multipliers() {
  require_at_rest("multipliers");
  std::vector<double>& table = tables_["multipliers"];
  table.resize(static_cast<std::size_t>(simulation_->state().lambda.size()));
  const auto fill = [this, &table] {
    const linalg::Vector& lambda = simulation_->state().lambda;
    std::copy_n(lambda.data(), table.size(), table.data());
  };
  fill();
  refreshes_["multipliers"] = fill;
  return view(table.data(), {static_cast<py::ssize_t>(table.size())});
}

py::array SimulationHandle::value(const std::string& path) const {
  require_at_rest("value");
  const auto map = evaluate([&] { return simulation_->values(path); });
  const results::Channel channel = simulation_->channel(path);
  const std::vector<py::ssize_t> shape(channel.shape.begin(), channel.shape.end());
  py::array_t<double> out(shape);
  std::copy_n(map.data(), map.size(), out.mutable_data());
  return out;
}

double SimulationHandle::signal(const std::string& name) const {
  require_at_rest("signals");
  return simulation_->signal(name);
}

std::vector<std::string> SimulationHandle::signals() const {
  std::vector<std::string> out;
  for (const model::Signal& signal : built_->model.signals.all) out.push_back(signal.name);
  return out;
}

std::vector<std::tuple<std::string, std::string, std::vector<std::string>>>
SimulationHandle::quantities() const {
  std::vector<std::tuple<std::string, std::string, std::vector<std::string>>> out;
  for (const results::Channel& channel : simulation_->layout().channels()) {
    out.emplace_back(channel.path, channel.unit, channel.components);
  }
  return out;
}

py::list SimulationHandle::curves() const {
  require_at_rest("curves");
  py::list out;
  if (!curves_) return out;
  const auto add = [&out](const std::string& name, const std::string& unit,
                          const std::vector<double>& values) {
    out.append(py::make_tuple(
        name, unit, py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data())));
  };
  add("t", "s", curves_->times());
  for (const analysis::SensorCurve& curve : curves_->curves()) {
    add(curve.name, curve.unit, curve.values);
  }
  return out;
}

}  // namespace buckens::python
