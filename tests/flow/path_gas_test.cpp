// The gas on paths: what it is in the cells, and what is given at boundaries.
#include "flow/paths/path_gas.hpp"

#include <gtest/gtest.h>

#include "core/cell_finder.hpp"
#include "paths_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

// Hydrogen in nitrogen, 1 to 1 by moles.
std::vector<double> mixture() {
  return Gas::hydrogen().massFractions("H2: 1, N2: 1");
}

// The gas at a place, the same on all ranks; as numbers of PathGas.
std::vector<double> numbersAt(const Mesh& mesh, const PathGas& gas, const Vector3& place) {
  const FoundCells found = findCells(mesh, std::vector{place});
  std::vector<double> numbers;
  if (found.cell[0] >= 0) gas.append(placeInCell(mesh, found.cell[0], place), numbers);
  numbers.resize(gas.width());
  MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<int>(numbers.size()), MPI_DOUBLE, MPI_SUM, mesh.comm);
  return numbers;
}

void expectGas(const ParticleGas& found, double temperature, double pressure, double tolerance) {
  Gas& gas = Gas::hydrogen();
  const std::vector<double> Y = mixture();
  std::vector<double> X(Y.size()), D(Y.size());
  gas.thermo.massToMole(Y, X);
  const double moles = pressure / (8.31446261815324 * temperature);
  EXPECT_NEAR(found.temperature, temperature, tolerance * temperature);
  EXPECT_EQ(found.pressure, pressure);
  EXPECT_NEAR(found.density, gas.thermo.density(temperature, pressure, Y), tolerance * found.density);
  EXPECT_NEAR(found.viscosity, gas.transport.mixture(temperature, pressure, X, D).viscosity,
              tolerance * found.viscosity);
  EXPECT_NEAR(found.meanMolecularWeight, 0.5 * (2.016e-3 + 28.014e-3), 1e-4 * found.meanMolecularWeight);
  ASSERT_EQ(found.concentrations.size(), 2U);
  EXPECT_NEAR(found.concentrations[0], 0.5 * moles, std::max(tolerance, 1e-8) * moles) << "nitrogen";
  EXPECT_NEAR(found.concentrations[1], 0.5 * moles, std::max(tolerance, 1e-8) * moles) << "hydrogen";
}

TEST(PathGas, IsThatOfTheCellsAndOfAWallThatIsHeld) {
  std::vector<Side> sides{side(BoundaryKind::Wall, 0, false), side(BoundaryKind::Wall, 0, true),
                          side(BoundaryKind::Symmetry, 1, false), side(BoundaryKind::Symmetry, 1, true)};
  sides[0].condition.isothermal = true;
  sides[0].condition.temperature = 350.0;
  Box box(Geometry::Planar, {uniformAxis(1.0, 8), uniformAxis(1.0, 6), {}}, sides);
  State state = box.state([](const Vector3&) { return Box::Local{{}, 700.0, mixture()}; });
  state.thermodynamicPressure = 101325.0;
  GasProperties properties;
  properties.update(box.context, state);
  const Mechanism& mechanism = Gas::hydrogen().mechanism;
  const PathGas gas(box.context, state, properties, {mechanism.speciesIndex("N2"), mechanism.speciesIndex("H2")});
  ASSERT_EQ(gas.width(), 6U);
  for (const Vector3& place : {Vector3{0.5, 0.52, 0.0}, Vector3{0.97, 0.3, 0.0}, Vector3{1.0, 1.0, 0.0}}) {
    const std::vector<double> numbers = numbersAt(box.mesh, gas, place);
    expectGas(gas.gasOf(numbers), 700.0, 101325.0, 1e-12);
  }
  const std::vector<double> atWall = numbersAt(box.mesh, gas, {0.0, 0.4, 0.0});
  expectGas(gas.gasOf(atWall), 350.0, 101325.0, 1e-12);
  // Half-way between the wall and the first centres, on the line from one to the other.
  const std::vector<double> between = numbersAt(box.mesh, gas, {1.0 / 32.0, 5.0 / 12.0, 0.0});
  EXPECT_NEAR(gas.gasOf(between).temperature, 525.0, 1e-9);
}

}  // namespace
}  // namespace lampblack::test
