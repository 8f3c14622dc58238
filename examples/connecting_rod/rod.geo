// SPDX-License-Identifier: Apache-2.0
// A connecting rod, lengths in mm: bores of 28 and 18 mm at a distance of 300 mm, a shank of
// 10 mm x 16 mm. make_rod.py makes rod.step of it.
SetFactory("OpenCASCADE");
L = 300; h = 10; t = 16;
Cylinder(1) = {0, 0, -t/2, 0, 0, t, 22};
Cylinder(2) = {L, 0, -t/2, 0, 0, t, 15};
Box(3) = {0, -h/2, -t/2, L, h, t};
BooleanUnion(4) = { Volume{1}; Delete; }{ Volume{2, 3}; Delete; };
// Fillets where the shank meets the eyes.
xa = Sqrt(22^2 - (h/2)^2);
xb = L - Sqrt(15^2 - (h/2)^2);
e = 0.01;
edges() = Curve In BoundingBox {xa - e, -h/2 - e, -t/2 - e, xb + e, h/2 + e, t/2 + e};
fillets() = {};
For i In {0 : #edges() - 1}
  box() = BoundingBox Curve { edges(i) };
  If (box(3) - box(0) < e && box(4) - box(1) < e)
    fillets() += edges(i);
  EndIf
EndFor
solid() = Fillet{4}{fillets()}{10};
Cylinder(5) = {0, 0, -t, 0, 0, 2*t, 14};
Cylinder(6) = {L, 0, -t, 0, 0, 2*t, 9};
BooleanDifference(7) = { Volume{solid()}; Delete; }{ Volume{5, 6}; Delete; };
