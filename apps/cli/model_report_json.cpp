// SPDX-License-Identifier: Apache-2.0
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/model_report_text.h"
#include "cli/output.h"

#include "buckens/analysis/simulation/turn.h"
#include "buckens/files/json_member.h"
#include "buckens/files/vector_json.h"

namespace buckens::cli {

namespace {

using analysis::BodyReport;

using analysis::ModelReport;
using files::json_of;
using Json = nlohmann::ordered_json;

Json json_of(const std::vector<analysis::ModeDamping>& modes) {
  Json out = Json::array();
  for (const analysis::ModeDamping& mode : modes) {
    out.push_back({{"frequency", mode.frequency},
                   {"ratio", mode.ratio},
                   {"asked", mode.asked ? Json(*mode.asked) : Json(nullptr)},
                   {"body", mode.body},
                   {"energy_share", mode.share}});
  }
  return out;
}

Json json_of(const std::vector<analysis::LoadReport>& loads) {
  Json out = Json::object();
  for (const analysis::LoadReport& load : loads) {
    out[load.name] = {{"kind", load.kind},
                      {"on", load.place},
                      {"extent", load.extent},
                      {"unit", load.unit},
                      {"force", json_of(load.force)},
                      {"torque", json_of(load.torque)}};
  }
  return out;
}

Json json_of(const std::vector<analysis::InterfaceReport>& interfaces) {
  Json out = Json::object();
  for (const analysis::InterfaceReport& interface : interfaces) {
    out[interface.name] = {{"kind", interface.is_rigid ? "rigid" : "average"},
                           {"nodes", interface.nodes},
                           {"area", interface.area},
                           {"centre", json_of(interface.centre)},
                           {"carries_moment", interface.carries_moment}};
  }
  return out;
}

Json json_of(const std::vector<analysis::SectionReport>& sections) {
  Json out = Json::array();
  for (const analysis::SectionReport& s : sections) {
    Json entry = {{"elements", s.elements}, {"width", s.width},  {"height", s.height},
                  {"y", json_of(s.y)},      {"z", json_of(s.z)}, {"EI_y", s.EI_y},
                  {"EI_z", s.EI_z}};
    if (s.planar) {
      entry["planar"] = {{"axis", json_of(s.planar->axis)},
                         {"EI", s.planar->EI},
                         {"extent_in_plane", s.planar->extent_in_plane},
                         {"extent_across", s.planar->extent_across}};
    }
    out.push_back(std::move(entry));
  }
  return out;
}

Json json_of(const std::vector<analysis::AssemblyMove>& moves) {
  Json out = Json::array();
  for (const analysis::AssemblyMove& move : moves) {
    out.push_back({{"body", move.body},
                   {"translation", json_of(move.translation)},
                   {"angle", move.angle},
                   {"axis", json_of(move.axis)},
                   {"joint", move.joint},
                   {"large", move.is_large}});
  }
  return out;
}

Json json_of(const body::ReductionFigures& r) {
  return {{"basis", r.basis},
          {"modes", r.modes},
          {"static_shapes", r.static_shapes},
          {"full_dof", r.full_dofs},
          {"highest_mode", r.highest_mode / analysis::kTurn},
          {"static_share", r.static_share}};
}

Json json_of(const BodyReport& body) {
  Json out = {{"flexible", body.is_flexible},
              {"mass", body.mass},
              {"com", json_of(body.com)},
              {"inertia", json_of(body.inertia)},
              {"principal_inertia", body.principal_inertia},
              {"nodes", body.nodes},
              {"elements", body.elements},
              {"dof", body.dof},
              {"frames", body.frames},
              {"frame_coordinates", body.frame_coordinates},
              {"frequencies", body.frequencies},
              {"markers", body.markers},
              {"interfaces", json_of(body.interfaces)},
              {"sections", json_of(body.sections)}};
  if (body.reduction) out["reduction"] = json_of(*body.reduction);
  return out;
}

}  // namespace

std::string report_json(const std::string& title, const ModelReport& report) {
  Json bodies = Json::object();
  for (const BodyReport& body : report.bodies) {
    files::add_member(bodies, body.name, json_of(body));
  }
  return to_text({{"title", title},
                  {"bodies", std::move(bodies)},
                  {"joints", report.joints},
                  {"loads", report.loads},
                  {"distributed_loads", json_of(report.distributed_loads)},
                  {"constraint_rows", report.constraint_rows},
                  {"redundant_rows", report.redundant_rows},
                  {"redundant", report.redundant},
                  {"degrees_of_freedom", report.degrees_of_freedom},
                  {"assembly_gap", report.assembly_gap},
                  {"damping", json_of(report.damping)},
                  {"assembly_moves", json_of(report.moves)},
                  {"step", report.step},
                  {"highest_frequency", report.highest_frequency},
                  {"result_bytes", report.result_bytes},
                  {"notes", report.notes},
                  {"warnings", report.warnings}});
}

}  // namespace buckens::cli
