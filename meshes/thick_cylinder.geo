// A quarter of a thick cylinder, inner radius a and outer radius b, centre at the origin. Structured.
// Every mesh has four boundary lines. Here they are: lower_platen, the cut on y = 0, and left_side, the cut on x = 0 (both
// are planes of symmetry); right_side, the inner arc, which carries the pressure; upper_platen, the outer arc.
//   gmsh thick_cylinder.geo -2 -format msh22 -setnumber b 3
DefineConstant[ a = 1, b = 2, n_radial = 10, n_around = 20 ];

Point(1) = {0, 0, 0}; // Centre of the arcs, not a vertex of the mesh.
Point(2) = {a, 0, 0};
Point(3) = {b, 0, 0};
Point(4) = {0, b, 0};
Point(5) = {0, a, 0};
Line(1) = {2, 3};
Circle(2) = {3, 1, 4};
Line(3) = {4, 5};
Circle(4) = {5, 1, 2};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};

Physical Curve("lower_platen", 1) = {1};
Physical Curve("upper_platen", 2) = {2};
Physical Curve("left_side", 3) = {3};
Physical Curve("right_side", 4) = {4};
Physical Surface("sample", 1) = {1};

Transfinite Curve{1, 3} = n_radial + 1;
Transfinite Curve{2, 4} = n_around + 1;
Transfinite Surface{1};
Recombine Surface{1};
