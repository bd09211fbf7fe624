// A cylinder of 1 mm in a channel 4.1 mm high and 22 mm long, a little below its middle; all cells are quadrilaterals.
// In mm. More cells by "-setnumber refine 2".
//
//   gmsh -2 -format msh41 cylinder.geo -o cylinder.msh

DefineConstant[ refine = 1 ];
around = 2 * Round(8 * refine);     // cells along a quarter of the cylinder
outwards = Round(10 * refine);      // from the cylinder to the square around it
before = Round(10 * refine);        // from the entrance to the square
behind = Round(64 * refine);        // from the square to the end
beside = Round(12 * refine);        // from the square to the walls
growth = 1 / refine;                // of what is a ratio of neighbouring cells below

x0 = 2; y0 = 2; radius = 0.5; side = 0.8;
xs[] = {0, x0 - side, x0 + side, 22};
ys[] = {0, y0 - side, y0 + side, 4.1};

// Corners of the blocks, row by row.
For j In {0:3}
  For i In {0:3}
    Point(1 + i + 4 * j) = {xs[i], ys[j], 0};
  EndFor
EndFor
// Lines along x (10 + ...) and along y (40 + ...).
For j In {0:3}
  For i In {0:2}
    Line(10 + i + 3 * j) = {1 + i + 4 * j, 2 + i + 4 * j};
  EndFor
EndFor
For j In {0:2}
  For i In {0:3}
    Line(40 + i + 4 * j) = {1 + i + 4 * j, 5 + i + 4 * j};
  EndFor
EndFor
For j In {0:3}
  Transfinite Curve {10 + 3 * j} = before + 1 Using Progression 0.92 ^ growth;
  Transfinite Curve {11 + 3 * j} = around + 1;
  Transfinite Curve {12 + 3 * j} = behind + 1 Using Progression 1.038 ^ growth;
EndFor
For i In {0:3}
  Transfinite Curve {40 + i} = beside + 1;
  Transfinite Curve {44 + i} = around + 1;
  Transfinite Curve {48 + i} = beside + 1;
EndFor

// The blocks but the one in the middle.
For j In {0:2}
  For i In {0:2}
    If (i != 1 || j != 1)
      b = 100 + i + 3 * j;
      Curve Loop(b) = {10 + i + 3 * j, 41 + i + 4 * j, -(13 + i + 3 * j), -(40 + i + 4 * j)};
      Plane Surface(b) = {b};
    EndIf
  EndFor
EndFor

// Around the cylinder.
Point(20) = {x0, y0, 0};
square[] = {6, 7, 11, 10};
For k In {0:3}
  angle = Pi * (-0.75 + 0.5 * k);
  Point(21 + k) = {x0 + radius * Cos(angle), y0 + radius * Sin(angle), 0};
EndFor
For k In {0:3}
  Circle(60 + k) = {21 + k, 20, 21 + (k + 1) % 4};
  Line(70 + k) = {21 + k, square[k]};
  Transfinite Curve {60 + k} = around + 1;
  Transfinite Curve {70 + k} = outwards + 1 Using Progression 1.12 ^ growth;
EndFor
Curve Loop(120) = {70, 14, -71, -60};
Curve Loop(121) = {71, 46, -72, -61};
Curve Loop(122) = {72, -17, -73, -62};
Curve Loop(123) = {73, -45, -70, -63};
For k In {0:3}
  Plane Surface(120 + k) = {120 + k};
EndFor

Transfinite Surface "*";
Recombine Surface "*";

Physical Curve("entrance") = {40, 44, 48};
Physical Curve("end") = {43, 47, 51};
Physical Curve("walls") = {10, 11, 12, 19, 20, 21};
Physical Curve("cylinder") = {60, 61, 62, 63};
Physical Surface("gas") = {100, 101, 102, 103, 105, 106, 107, 108, 120, 121, 122, 123};
