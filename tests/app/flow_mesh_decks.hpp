// Decks of flows of one gas on any mesh, for tests of what they become.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/problems/flow/flow_case_parts.hpp"
#include "tests/every_module.hpp"
#include "tests/source_folder.hpp"

namespace lampblack::app::test_mesh {

inline const std::string gas = R"(temperature: 300 K, composition: "GAS: 1")";

// A flow of one gas on this mesh, with these boundaries; `more`: other sections.
inline FlowCase caseOf(const std::string& mesh, const std::string& boundaries, const std::string& more = "",
                       const std::filesystem::path& path = "deck.yaml") {
  const std::string text =
      "problem: flow\nmechanism: " + test::sourcePath("cases/mechanisms/perfect_gas_1.yaml") +
      "\ntransport: {model: unity_lewis, sutherland: {viscosity: 1.68e-5 Pa s, temperature: 273 K, "
      "constant: 110.5 K, prandtl_number: 0.71}}\nmesh: {" +
      mesh + "}\nboundaries:\n" + boundaries + "time: {end: 1 ms}\n" +
      (more.find("initial:") == std::string::npos
           ? "initial: {layer: none, temperature: 300 K, composition: \"GAS: 1\"}\n"
           : "") +
      more;
  return readFlowCase(Deck::parse(text, path, {}, flowSchema()));
}

// A channel of 6 x 4 mm.
inline const std::string channel = "geometry: planar, x: [{to: 6 mm, cells: 6}], y: [{to: 4 mm, cells: 4}]";
inline const std::string channelSides = "  in: {type: inlet, side: x-min, velocity: 1 m/s, " + gas +
                                        "}\n  out: {type: outlet, side: x-max, " + gas +
                                        "}\n  floor: {type: wall, side: y-min}\n  top: {type: wall, side: y-max}\n";

// Faces of each boundary and the sum of their areas, over all ranks.
struct Surface {
  std::vector<double> faces, area;
  explicit Surface(const Mesh& mesh) : faces(mesh.patches.size()), area(mesh.patches.size()) {
    for (int face = mesh.interiorFaces; face < mesh.faces; ++face) {
      const auto patch = static_cast<std::size_t>(mesh.patch[static_cast<std::size_t>(face - mesh.interiorFaces)]);
      faces[patch] += 1;
      area[patch] += mesh.area[static_cast<std::size_t>(face)];
    }
    const auto n = static_cast<int>(faces.size());
    MPI_Allreduce(MPI_IN_PLACE, faces.data(), n, MPI_DOUBLE, MPI_SUM, mesh.comm);
    MPI_Allreduce(MPI_IN_PLACE, area.data(), n, MPI_DOUBLE, MPI_SUM, mesh.comm);
  }
};

inline double volumeOf(const Mesh& mesh) {
  double volume = 0;
  for (int c = 0; c < mesh.owned; ++c) volume += mesh.volume[static_cast<std::size_t>(c)];
  MPI_Allreduce(MPI_IN_PLACE, &volume, 1, MPI_DOUBLE, MPI_SUM, mesh.comm);
  return volume;
}

}  // namespace lampblack::app::test_mesh
