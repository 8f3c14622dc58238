// SPDX-License-Identifier: Apache-2.0
// Web of a crank, mm: a rounded plate with the bores of shaft and pin.
SetFactory("OpenCASCADE");
r = 40; t = 12;
Cylinder(1) = {0, 0, 0, 0, 0, t, 25};
Cylinder(2) = {r, 0, 0, 0, 0, t, 18};
Box(3) = {0, -15, 0, r, 30, t};
web() = BooleanUnion{ Volume{1}; Delete; }{ Volume{2, 3}; Delete; };
Cylinder(5) = {0, 0, -1, 0, 0, t + 2, 14};
Cylinder(6) = {r, 0, -1, 0, 0, t + 2, 9};
part() = BooleanDifference{ Volume{web()}; Delete; }{ Volume{5, 6}; Delete; };
e = 0.1;
shaft() = Surface In BoundingBox {-14 - e, -14 - e, -e, 14 + e, 14 + e, t + e};
pin() = Surface In BoundingBox {r - 9 - e, -9 - e, -e, r + 9 + e, 9 + e, t + e};
Physical Volume("WEB") = {part()};
Physical Surface("SHAFT") = {shaft()};
Physical Surface("PIN") = {pin()};
rim() = Curve In BoundingBox {-14 - e, -14 - e, -e, 14 + e, 14 + e, e};
Physical Curve("rim") = {rim()};
Physical Point("seat") = {PointsOf{ Surface{pin()}; }};
Mesh.MeshSizeMax = 30;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.ElementOrder = 2;
Mesh.HighOrderOptimize = 1;
