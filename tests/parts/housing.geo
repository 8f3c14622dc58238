// SPDX-License-Identifier: Apache-2.0
// Thin-walled housing as a surface, mm: an open box with a round opening.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 120, 80, 60};
Cylinder(2) = {60, 40, -1, 0, 0, 2, 20};
box() = BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; };
e = 0.1;
lid() = Surface In BoundingBox {-e, -e, 60 - e, 120 + e, 80 + e, 60 + e};
floor() = Surface In BoundingBox {-e, -e, -e, 120 + e, 80 + e, e};
inner() = Surface In BoundingBox {40 - e, 20 - e, -e, 80 + e, 60 + e, 1 + e};
all() = Surface {:};
all() -= {lid()};
all() -= {inner()};
walls() = all();
walls() -= {floor()};
base() = floor();
base() -= {inner()};
bottom() = Surface In BoundingBox {-e, -e, -e, 120 + e, 80 + e, e};
Physical Surface("WALLS") = {walls()};
Physical Surface("FLOOR") = {bottom()};
edge() = Curve In BoundingBox {-e, -e, 60 - e, 120 + e, 80 + e, 60 + e};
Physical Curve("rim") = {edge()};
Mesh.MeshSizeMax = 22;
Mesh.RecombineAll = 1;
