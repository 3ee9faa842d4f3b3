// A rectangle under a strip in the middle of its upper edge. The rest of the upper edge is free. Structured.
// The program can make the same mesh (continuum/mesh/rectangle_mesh.cc). This file is a start for shapes of your own.
//   gmsh footing.geo -2 -format msh22 -setnumber width 40 -setnumber strip 4
DefineConstant[ width = 20, height = 10, strip = 2, size = 0.5 ];

beside = (width - strip) / 2;
x() = {0, beside, beside + strip, width};
For i In {0:3}
  Point(1 + i) = {x(i), 0, 0};
  Point(11 + i) = {x(i), height, 0};
  Line(21 + i) = {1 + i, 11 + i}; // vertical lines
EndFor
For i In {0:2}
  Line(31 + i) = {1 + i, 2 + i};   // lower edge
  Line(41 + i) = {11 + i, 12 + i}; // upper edge
  Curve Loop(1 + i) = {31 + i, 22 + i, -(41 + i), -(21 + i)};
  Plane Surface(1 + i) = {1 + i};
EndFor

Physical Curve("lower_platen", 1) = {31, 32, 33};
Physical Curve("upper_platen", 2) = {42};
Physical Curve("left_side", 3) = {21};
Physical Curve("right_side", 4) = {24};
Physical Curve("free", 5) = {41, 43};
Physical Surface("sample", 1) = {1, 2, 3};

Transfinite Curve{21:24} = Ceil(height / size) + 1;
Transfinite Curve{31, 33, 41, 43} = Ceil(beside / size) + 1;
Transfinite Curve{32, 42} = Ceil(strip / size) + 1;
Transfinite Surface{1:3};
Recombine Surface{1:3};
