// What tests of turbulence in a flow share: a square of air between walls, with a model of a test's own.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "flow/models/turbulence/turbulence_operator.hpp"
#include "flow_fixture.hpp"

namespace lampblack::test {

inline constexpr double ofMolecules = 1.5e-5;  // m^2/s

// What the models of tests have in common, whose rates say what they were asked with.
struct TwoVariables {
  static constexpr bool needsWallDistance = false, needsStrainGradient = false;
  static constexpr double secondValue = 3.0;  // of a free stream; the first is the stream's energy
  [[nodiscard]] std::string name() const { return "two variables"; }
  [[nodiscard]] std::vector<TurbulenceModel::Variable> variables() const { return {{"a", "1", ""}, {"b", "1", ""}}; }
  [[nodiscard]] std::array<double, 2> freeStream(const FreeStream& stream) const {
    return {stream.energy, secondValue};
  }
};

// 7 x 7 cells of 1 mm; the gas slips along all walls, or along those of `sides`.
struct TurbulentSquare {
  static constexpr double length = 0.007, viscosity = 1.8e-5;  // m, Pa s
  static constexpr int wellInside = 25;                        // cells isWellInside() is true of

  explicit TurbulentSquare(std::shared_ptr<const TurbulenceModel> modelOfIt, Geometry geometry = Geometry::Planar)
      : TurbulentSquare(std::move(modelOfIt), geometry, walls(geometry)) {}
  TurbulentSquare(std::shared_ptr<const TurbulenceModel> modelOfIt, Geometry geometry, const std::vector<Side>& sides,
                  std::optional<Split> split = {})
      : model(std::move(modelOfIt)),
        box(geometry, {uniformAxis(length, 7), uniformAxis(length, 7)}, sides, Gas::hydrogen(), split) {}

  static std::vector<Side> walls(Geometry geometry) {
    std::vector<Side> sides;
    for (const int axis : {0, 1})
      for (const bool isAtMax : {false, true}) {
        const bool isAxis = geometry == Geometry::Axisymmetric && axis == 0 && !isAtMax;
        sides.push_back(side(isAxis ? BoundaryKind::Symmetry : BoundaryKind::Wall, axis, isAtMax));
      }
    return sides;
  }

  // Air at 300 K; the properties are of as many cells.
  State state(const std::function<Vector3(const Vector3&)>& velocity, bool swirls = false) {
    const std::vector<double> air = box.gas.massFractions("O2: 0.21, N2: 0.79");
    const std::vector<FreeStream> streams(box.context.boundaries.size(), {ofMolecules, ofMolecules, 1.0});
    State made = box.stateWith(
        {TurbulenceOperator::blockOf(*model, box.context.boundaries, streams)},
        [&](const Vector3& x) {
          return Box::Local{velocity(x), 300.0, air};
        },
        swirls);
    properties.viscosity.assign(made.density.size(), viscosity);
    return made;
  }
  TurbulenceOperator turbulence(const State& of, const TurbulenceOperator::Options& options = {}) {
    return {box.context, of, model, properties, options};
  }

  // Where no gradient sees a boundary.
  [[nodiscard]] bool isWellInside(const Vector3& x) const {
    return std::max(std::abs(x[0] - 0.5 * length), std::abs(x[1] - 0.5 * length)) < 0.3 * length;
  }
  // Of every owned cell well inside; of all ranks together there are as many as there should be.
  void forCellsWellInside(const std::function<void(std::size_t cell, const Vector3& centre)>& look) const {
    int inside = 0;
    for (std::size_t c = 0; c < at(box.mesh.owned); ++c) {
      if (!isWellInside(box.mesh.centre[c])) continue;
      ++inside;
      look(c, box.mesh.centre[c]);
    }
    MPI_Allreduce(MPI_IN_PLACE, &inside, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    EXPECT_EQ(inside, wellInside);
  }

  std::shared_ptr<const TurbulenceModel> model;
  GasProperties properties;
  Box box;
};

}  // namespace lampblack::test
