// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "buckens/model/model.h"
#include "buckens/results/geometry.h"

namespace buckens::results {

/// Place of a marker in the undeformed whole body, world for the ground.
GeometrySide side_of(const model::Model& model, const model::MarkerId& id);

/// A direction given in a marker's axes, in those of its body.
Eigen::Vector3d to_body(const model::Model& model, const model::MarkerId& id,
                        const Eigen::Vector3d& axis);

/// Shapes of contacts, also of many bodies. Surfaces of bodies that are drawn anyway are left out.
void add_contact_shapes(const model::Model& model, Geometry& out);

/// Appends what rolls on a plane: the wheels of rolling joints.
void add_wheels(const model::Model& model, Geometry& out);

/// Appends curves that guide points: slots, and cams with their rollers.
void add_curves(const model::Model& model, Geometry& out);

/// Cables and belts, also those that are joints.
void add_cables(const model::Model& model, Geometry& out);

}  // namespace buckens::results
