// The continuum's mesh of a rectangular sample, for use by hand with gmsh. The program makes such a mesh with gmsh's
// library from the outline of the prepared grains (continuum/mesh/).
//   gmsh sample.geo -2 -format msh22 -setnumber width 52 -setnumber height 75 -setnumber size 2
DefineConstant[ width = 52, height = 75, size = 2 ];

Point(1) = {0, 0, 0, size};
Point(2) = {width, 0, 0, size};
Point(3) = {width, height, 0, size};
Point(4) = {0, height, 0, size};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};

// The four boundary ids that the continuum panel reads (BoundaryId in continuum/mesh/).
Physical Curve("lower_platen", 1) = {1};
Physical Curve("upper_platen", 2) = {3};
Physical Curve("left_side", 3) = {4};
Physical Curve("right_side", 4) = {2};
Physical Surface("sample", 1) = {1};

// Quadrilaterals only: the continuum panel refuses triangles.
Mesh.RecombineAll = 1;
Mesh.RecombinationAlgorithm = 1; // Blossom
Mesh.Algorithm = 6;              // frontal Delaunay
