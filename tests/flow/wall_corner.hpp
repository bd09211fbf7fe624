// What tests of the law of the wall in a flow share.
#pragma once

#include <memory>
#include <vector>

#include "flow/models/turbulence/turbulence_operator.hpp"
#include "flow_fixture.hpp"

namespace lampblack::test {

// Warm gas that slides along a wall with a corner.
struct WallCorner {
  static std::vector<Side> sides(Gas& gas) {
    std::vector<Side> all{side(BoundaryKind::Wall, 0, false), side(BoundaryKind::Symmetry, 0, true),
                          side(BoundaryKind::Wall, 1, false), side(BoundaryKind::Symmetry, 1, true)};
    for (Side& of : all) {
      of.condition.slip = false;
      of.condition.isothermal = of.condition.kind == BoundaryKind::Wall;
      of.condition.takesParticles = of.condition.kind == BoundaryKind::Wall;
      of.condition.temperature = 300.0;
      of.condition.Y = gas.massFractions("O2: 0.21, N2: 0.79");
    }
    return all;
  }
  Gas& gas = Gas::hydrogen();
  int rows = 2;
  double k = 0.5, u = 3.0, v = 1.0;
  Box box{Geometry::Planar, {uniformAxis(0.03, 3), uniformAxis(0.02, rows)}, sides(gas)};
  std::shared_ptr<const TurbulenceModel> model;
  State state =
      box.stateWith({takenByWalls({"dust", {{.name = "dust", .unit = "1", .description = ""}}}, box.context.boundaries),
                     TurbulenceOperator::blockOf(*model, box.context.boundaries, std::vector<FreeStream>(4))},
                    [&](const Vector3&) {
                      return Box::Local{{u, v}, 320.0, gas.massFractions("O2: 0.21, N2: 0.79")};
                    });
  GasProperties properties;

  explicit WallCorner(double energy, const char* name = "k_epsilon", bool blendsLayers = false, int cellsUp = 2)
      : rows(cellsUp), k(energy), model(turbulenceModel(name, {.blendsLayers = blendsLayers})) {
    for (int c = 0; c < box.mesh.cells; ++c) {
      state.carried[at(3 * c + 1)] = state.density[at(c)] * k;
      state.carried[at(3 * c + 2)] = state.density[at(c)] * 20.0;
      state.carriedDiffusivity[at(3 * c)] = 3e-8;
    }
    box.context.eddies = {0.85, 0.7};
    properties.update(box.context, state);
  }
};

}  // namespace lampblack::test
