// SPDX-License-Identifier: Apache-2.0
#include "buckens/model/build/shell_from_spec.h"

#include "buckens/model/build/spec_properties.h"

namespace buckens::model {

fem::ShellSection make_shell_section(const fem::ShellPropertySpec& spec,
                                     const fem::MaterialSpec& material,
                                     const std::optional<fem::DampingSpec>& of_body) {
  fem::ShellSection out;
  out.offset = spec.offset;
  out.direction = spec.direction;
  if (spec.thickness) {
    out.layers.push_back({make_material(material, of_body), *spec.thickness, 0.0});
  }
  for (const fem::ShellLayerSpec& layer : spec.layers) {
    const fem::MaterialSpec& own = layer.material ? **layer.material : material;
    out.layers.push_back({make_material(own, of_body), layer.thickness, layer.angle});
  }
  return out;
}

}  // namespace buckens::model
