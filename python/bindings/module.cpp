// SPDX-License-Identifier: Apache-2.0
// buckens._core: what the Python package takes from the library. Documented and typed in
// python/buckens/_core.pyi; users see the package around it.
#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include "bindings/exceptions.h"
#include "bindings/messages.h"
#include "bindings/simulation_handle.h"
#include "bindings/studies.h"

#include "buckens/analysis/simulation/later_end.h"
#include "buckens/base/errors.h"
#include "buckens/base/version.h"
#include "buckens/linalg/blas_kernels.h"
#include "buckens/run_store/kept_records.h"
#include "buckens/run_store/state_file.h"

namespace py = pybind11;
using namespace py::literals;

namespace buckens::python {

namespace {

using Unlocked = py::call_guard<py::gil_scoped_release>;

template <class Spec>
std::vector<std::string> names(const std::vector<Spec>& specs) {
  std::vector<std::string> out;
  for (const Spec& spec : specs) out.push_back(spec.name);
  return out;
}

void define_model(py::module_& core) {
  using Model = ModelHandle;
  py::class_<Model, std::shared_ptr<Model>>(core, "Model")
      .def_static("read", &Model::read, "path"_a, "overrides"_a, Unlocked())
      .def_static("parse", &Model::parse, "text"_a, "name"_a, "overrides"_a, "is_generated"_a,
                  Unlocked())
      .def_property_readonly("title", [](const Model& m) { return m.description().title; })
      .def_property_readonly("source", [](const Model& m) { return m.description().source; })
      .def_property_readonly("directory", [](const Model& m) { return m.description().directory; })
      .def_property_readonly("warnings", [](const Model& m) { return m.description().warnings; })
      .def_property_readonly("bodies", [](const Model& m) { return names(m.description().bodies); })
      .def_property_readonly("joints", [](const Model& m) { return names(m.description().joints); })
      .def_property_readonly("loads", [](const Model& m) { return names(m.description().loads); })
      .def_property_readonly("signals",
                             [](const Model& m) { return names(m.description().signals); })
      .def_property_readonly("sensors",
                             [](const Model& m) { return names(m.description().output.sensors); })
      .def_property_readonly("duration", [](const Model& m) -> std::optional<double> {
        const auto& simulation = m.description().simulation;
        return simulation ? std::optional<double>(simulation->duration) : std::nullopt;
      });
}

std::shared_ptr<SimulationHandle> make_simulation(
    const std::shared_ptr<ModelHandle>& model,
    const std::vector<std::tuple<std::string, std::string, py::function>>& forces,
    const std::vector<std::tuple<std::string, std::vector<std::string>, py::function>>& signals,
    int threads, const std::string& out, bool keep_records, const std::string& start_from,
    bool continues, const std::string& model_text) {
  SimulationSettings settings;
  for (const auto& [name, marker, function] : forces) {
    settings.forces.push_back({name, marker, function});
  }
  for (const auto& [name, inputs, function] : signals) {
    settings.signals.push_back({name, inputs, function});
  }
  settings.threads = threads;
  settings.out = out;
  settings.keep_records = keep_records;
  settings.start_from = start_from;
  settings.continues = continues;
  settings.model_text = model_text;
  return std::make_shared<SimulationHandle>(model, settings);
}

void define_simulation(py::module_& core) {
  using Simulation = SimulationHandle;
  py::class_<Simulation, std::shared_ptr<Simulation>>(core, "Simulation")
      .def(py::init(&make_simulation), "model"_a, "forces"_a, "signals"_a, "threads"_a, "out"_a,
           "keep_records"_a, "start_from"_a, "continues"_a, "model_text"_a)
      .def("step", &Simulation::step)
      .def("advance", &Simulation::advance, "t"_a)
      .def("run", &Simulation::run, "progress"_a)
      .def("finish", &Simulation::finish)
      .def("leave", &Simulation::leave)
      .def("stop", &Simulation::stop)
      .def("on_step", &Simulation::on_step, "callback"_a)
      .def_property_readonly("time", &Simulation::time)
      .def_property_readonly("end_time", &Simulation::end_time)
      .def_property_readonly("num_steps", &Simulation::num_steps)
      .def_property_readonly("is_done", &Simulation::is_done)
      .def("frame", &Simulation::frame, "body"_a)
      .def("displacements", &Simulation::displacements, "body"_a)
      .def("velocities", &Simulation::velocities, "body"_a)
      .def("multipliers", &Simulation::multipliers)
      .def("value", &Simulation::value, "path"_a)
      .def("quantities", &Simulation::quantities)
      .def("curves", &Simulation::curves)
      .def("set_load", &Simulation::set_load, "load"_a, "value"_a)
      .def("release_load", &Simulation::release_load, "load"_a)
      .def("signal", &Simulation::signal, "name"_a)
      .def("signals", &Simulation::signals)
      .def("set_signal", &Simulation::set_signal, "signal"_a, "value"_a)
      .def("save", &Simulation::save, "path"_a)
      .def("flush", &Simulation::flush);
}

/// Changes that move the end of the run of a checkpoint. @param until [s]
std::vector<std::string> changes_until(const std::string& checkpoint, const ModelHandle& model,
                                       double until) {
  const run_store::Continuation kept =
      run_store::continuation_from(run_store::read_state(checkpoint));
  if (!(until > kept.time)) {
    throw InputError(
        fmt::format("until: {:.9g} s is over, the run has reached t = {:.9g} s; give a later time",
                    until, kept.time));
  }
  if (!model.description().simulation) return {};  // the simulation tells
  return analysis::changes_for_end(model.description(), {kept.march_start, kept.longest_step},
                                   until);
}

py::list messages_as_list() {
  py::list out;
  for (const auto& [level, text] : take_messages()) {
    out.append(py::make_tuple(static_cast<int>(level), text));
  }
  return out;
}

}  // namespace

}  // namespace buckens::python

PYBIND11_MODULE(_core, core) {
  using namespace buckens;
  // As the program does, so that both compute the same to the last bit.
  linalg::choose_blas_kernels();
  python::collect_messages();
  python::translate_exceptions();
  core.attr("version") = kVersion;
  core.def("take_messages", &python::messages_as_list);
  core.def("changes_until", &python::changes_until, "checkpoint"_a, "model"_a, "until"_a);
  python::define_model(core);
  python::define_simulation(core);
  python::define_studies(core);
}
