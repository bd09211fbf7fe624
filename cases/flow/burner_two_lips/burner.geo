// A coflow burner in a half plane: x is the radius, y the axis, in mm. Fuel comes through a tube of 11 mm inner diameter
// whose wall ends 4 mm above the air's entrance; the air's tube of 40 mm ends 2 mm above it. Both have blunt lips.
//
//   gmsh -2 -format msh41 burner.geo -o burner.msh

Mesh.Algorithm = 6;
Mesh.RecombinationAlgorithm = 0;

Point(1) = {0, -8, 0, 0.7};    // fuel, on the axis
Point(2) = {5.5, -8, 0, 0.45};  // fuel, at the tube
Point(3) = {5.5, 0, 0, 0.27};   // inner edge of the lip
Point(4) = {6.3, 0, 0, 0.27};   // outer edge
Point(5) = {6.3, -4, 0, 0.7};   // air, at the tube
Point(6) = {20, -4, 0, 1.5};    // air, at its own tube
Point(7) = {20, -2, 0, 1.2};    // inner edge of the air's lip
Point(8) = {21, -2, 0, 1.2};    // outer edge
Point(9) = {21, -4, 0, 1.5};    // surroundings
Point(10) = {45, -4, 0, 5};
Point(11) = {45, 60, 0, 5};
Point(12) = {0, 60, 0, 2};
Point(13) = {0, 0, 0, 0.45};

Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 7};
Line(7) = {7, 8};
Line(8) = {8, 9};
Line(9) = {9, 10};
Line(10) = {10, 11};
Line(11) = {11, 12};
Line(12) = {12, 13};
Line(13) = {13, 1};
Line(14) = {13, 3};

// The fuel tube: rectangles. Everything else: triangles.
Transfinite Curve {1, 14} = 14;
Transfinite Curve {2, -13} = 15 Using Progression 0.92;
Curve Loop(1) = {1, 2, -14, 13};
Plane Surface(1) = {1};
Transfinite Surface {1} = {1, 2, 3, 13};
Recombine Surface {1};

Curve Loop(2) = {14, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
Plane Surface(2) = {2};

// Fine along the flame, from the lip upwards.
Point(20) = {6, 18, 0, 0.7};
Point(21) = {4, 34, 0, 1};
Point{20, 21} In Surface {2};

Physical Curve("fuel") = {1};
Physical Curve("fuel_tube") = {2, 3, 4};
Physical Curve("air") = {5};
Physical Curve("air_tube") = {6, 7, 8};
Physical Curve("surroundings") = {9};
Physical Curve("side") = {10};
Physical Curve("top") = {11};
Physical Curve("axis") = {12, 13};
Physical Surface("gas") = {1, 2};
