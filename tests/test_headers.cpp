// Nothing: a source for the precompiled headers that the tests share (CMakeLists.txt).
