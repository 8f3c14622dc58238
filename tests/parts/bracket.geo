// SPDX-License-Identifier: Apache-2.0
// Angle bracket with holes, mm.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 60, 40, 6};
Box(2) = {0, 0, 0, 6, 40, 50};
angle() = BooleanUnion{ Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(5) = {40, 10, -1, 0, 0, 8, 4};
Cylinder(6) = {40, 30, -1, 0, 0, 8, 4};
Cylinder(7) = {-1, 20, 32, 8, 0, 0, 7};
part() = BooleanDifference{ Volume{angle()}; Delete; }{ Volume{5, 6, 7}; Delete; };
e = 0.1;
screws() = Surface In BoundingBox {36 - e, 6 - e, -e, 44 + e, 34 + e, 6 + e};
eye() = Surface In BoundingBox {-e, 13 - e, 25 - e, 6 + e, 27 + e, 39 + e};
Physical Volume("BRACKET") = {part()};
Physical Surface("SCREWS") = {screws()};
Physical Surface("EYE") = {eye()};
Mesh.MeshSizeMax = 10;
