// The XDMF file that tells ParaView (and meshio) what is in a results file: XDMF 3, one grid for each step in a
// temporal collection, all data by reference to the HDF5 file.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::io {

struct XdmfField {
  std::string name;
  int components = 1;
  bool isInteger = false;
};

struct XdmfStep {
  std::string group;  // "/steps/000123"
  double time = 0.0;
  std::vector<XdmfField> fields;
};

struct XdmfMesh {
  int dimension = 2;
  int corners = 4;  // of a cell
  std::int64_t cells = 0;
  std::int64_t vertices = 0;
  std::int64_t mixed = 0;  // values of /mesh/mixed, of a mesh of several kinds of cells; 0: of one kind
};

// Whether there are cells of so many corners.
bool isTopology(int dimension, int corners);
// XDMF's number for them in a topology of several kinds.
std::int64_t topologyNumber(int dimension, int corners);

// The whole file as text; `file` is the HDF5 file's name beside it. The text is the head, each step and the tail.
std::string xdmfText(const std::string& file, const XdmfMesh& mesh, const std::vector<XdmfStep>& steps);
std::string xdmfStepText(const std::string& file, const XdmfMesh& mesh, const XdmfStep& step);
std::string_view xdmfTail();

}  // namespace lampblack::io
