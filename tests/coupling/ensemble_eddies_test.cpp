// Ensembles in a turbulent gas: what is evenly mixed stays so, and walls take what comes through the eddies beside
// them.
#include <gtest/gtest.h>

#include <cmath>

#include "flow/boundaries/wall_flux.hpp"
#include "flow/properties/wall_transfer.hpp"
#include "tests/coupling/moving_particles.hpp"
#include "tests/every_module.hpp"
#include "tests/particles/statistics.hpp"

namespace lampblack::test {
namespace {

using moving::Moving;

Vector3 still(const Vector3&) {
  return {};
}

// Density and eddies vary by several times; as many particles per mass of gas everywhere.
TEST(EnsembleEddies, LeaveWhatIsEvenlyMixed) {
  constexpr int repeats = 60;
  std::vector<std::vector<double>> perMass;
  for (int r = 0; r < repeats; ++r) {
    Moving m(6, still);
    const Mesh& mesh = m.box.mesh;
    for (int c = 0; c < mesh.cells; ++c) m.state.density[at(c)] = 0.2 + 60.0 * mesh.centre[at(c)][0];
    m.state.eddyViscosity.resize(at(mesh.cells));
    for (int c = 0; c < mesh.cells; ++c) m.state.eddyViscosity[at(c)] = 1e-4 + 0.04 * mesh.centre[at(c)][1];
    for (int face = 0; face < mesh.faces; ++face) m.density[at(face)] = 0.2 + 60.0 * mesh.faceCentre[at(face)][0];
    m.state.keepStart();
    m.fill(40, [](const Vector3& x) { return 1e16 * (0.2 + 60.0 * x[0]); });
    EnsembleTransport transport = m.transport(false, 70 + static_cast<std::uint64_t>(r));
    for (int s = 0; s < 4; ++s) m.step(transport, 3e-4, static_cast<std::uint64_t>(s));
    perMass.resize(at(mesh.owned));
    for (int c = 0; c < mesh.owned; ++c) perMass[at(c)].push_back(m.moment(c, 0.0) / m.state.density[at(c)]);
  }
  double largest = 0.0;
  for (const std::vector<double>& values : perMass) {
    const Sample sample = summarise(values);
    EXPECT_GT(sample.standardError, 0.0);
    largest = std::max(largest, std::abs(sample.mean - 1e16) / sample.standardError);
  }
  EXPECT_LT(maxOverRanks(largest), 4.5);
}

// Gas at 1500 K beside walls for which the law of the wall stands, with particles of which one size diffuses.
TEST(EnsembleEddies, WallsTakeWhatComesThroughThem) {
  constexpr double dt = 2e-4;
  for (const bool diffuses : {false, true}) {
    Moving m(3, still);
    const Mesh& mesh = m.box.mesh;
    m.letWallsTake();
    for (BoundaryCondition& wall : m.box.context.boundaries) wall.slip = false;
    m.state.wallEnergy = 0;
    m.state.scalars.resize(1);
    m.state.carried.resize(at(mesh.cells));
    for (int c = 0; c < mesh.cells; ++c) m.state.carried[at(c)] = m.state.density[at(c)] * 40.0;
    m.properties.boundaryViscosity.assign(at(mesh.boundaryFaces()), 5e-5);
    m.properties.boundaryConductivity.assign(at(mesh.boundaryFaces()), 0.08);
    m.properties.heatCapacity.assign(at(mesh.cells), 1200.0);
    m.state.keepStart();
    for (int face = mesh.interiorFaces; face < mesh.faces; ++face)
      m.drift[at(face)] = m.state.density[0] * mesh.area[at(face)] * (diffuses ? 0.0 : 6.0);
    m.fill(
        20000, [](const Vector3&) { return 1e16; }, 0.0);
    EnsembleTransport transport = m.transport(diffuses, 5);
    transport.advance({m.state, m.drift, m.density, m.properties}, dt, 0, EnsembleTransport::Half::First, m.populations,
                      m.arrived);
    EXPECT_EQ(transport.parts(), 1);
    const CarrierGas gas{1500.0, constants::oneAtmosphere, m.state.density[0], 5e-5, 0.028};
    const double D = diffuses ? brownianDiffusivity(gas, 2e-9) : 0.0;
    std::vector<double> expected(at(mesh.owned));
    for (int face = mesh.interiorFaces; face < mesh.faces; ++face) {
      const auto c = at(mesh.low[at(face)]);
      const double eddies = eddiesToWall(m.box.context, m.state, m.properties, face).resistance;
      const double layer = conductanceToWall(m.box.context, m.state, m.properties, face, m.density[at(face)], D);
      EXPECT_GT(eddies * takenByWall(0.55 * m.drift[at(face)], layer), diffuses ? 1e-3 : 0.05);
      const double passes = 1.0 / (1.0 / takenByWall(0.55 * m.drift[at(face)], layer) + eddies);
      expected[c] += 0.5 * dt * passes / (mesh.volume[c] * m.state.density[c]);
    }
    double gone = 0.0, all = 0.0;  // over all cells: some hundred leave one
    EnsembleTransport::Rows rows(packedHead);
    rows.insert(rows.end(), transport.gone().begin(), transport.gone().end());
    for (const GivenParticle& p : packedParticles(rows)) gone += p.number;
    for (int c = 0; c < mesh.owned; ++c) all += 1e16 * mesh.volume[at(c)] * expected[at(c)];
    EXPECT_NEAR(sumOverRanks(gone) / sumOverRanks(all), 1.0, 0.04) << diffuses;
  }
}

}  // namespace
}  // namespace lampblack::test
