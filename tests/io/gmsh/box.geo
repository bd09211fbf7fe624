// gmsh -3 box.geo -bin -o box.msh
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 2, 1, 1};
Mesh.MeshSizeMin = 0.5;
Mesh.MeshSizeMax = 0.5;
Periodic Surface {2} = {1} Translate {2, 0, 0};
Physical Surface("fuel inlet", 5) = {1};
Physical Surface("far away", 6) = {2};
Physical Surface(7) = {3, 4, 5, 6};
Physical Volume("gas", 1) = {1};
