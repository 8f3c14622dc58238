// An assembly in millimetres: a plate, a pin that stands on it, and a block that touches neither.
SetFactory("OpenCASCADE");
Geometry.OCCTargetUnit = "MM";
Box(1) = {0, 0, 0, 40, 20, 10};
Box(2) = {40, 5, 0, 20, 10, 10};
Box(3) = {0, 40, 0, 10, 10, 10};
