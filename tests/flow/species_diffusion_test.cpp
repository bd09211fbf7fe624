// Mixture-averaged diffusion fluxes and the state of the gas at the faces.
#include "flow/equations/species_diffusion.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <numbers>

#include "core/constants.hpp"
#include "flow/discretisation/face_fluxes.hpp"
#include "flow/equations/face_state.hpp"
#include "flow/equations/heat_conduction.hpp"
#include "flow/properties/gas_properties.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

// Fluxes of a state at rest over dt.
std::vector<double> fluxesOf(Box& box, const State& state, double dt) {
  GasProperties properties;
  properties.update(box.context, state);
  const Mesh& m = box.mesh;
  const auto n = at(state.species);
  std::vector<double> content(at(m.owned) * n);
  std::vector<double> mass(at(m.owned));
  for (std::size_t c = 0; c < mass.size(); ++c) {
    mass[c] = m.volume[c] * state.density[c];
    for (std::size_t k = 0; k < n; ++k) content[c * n + k] = mass[c] * state.Y[c * n + k];
  }
  std::vector<double> flux(at(m.faces) * n, 0.0);
  ImplicitDiffusion solver(m, box.halo);
  SpeciesDiffusion diffusion(box.context, solver);
  diffusion.prepare(state, properties);
  std::vector<double> solution(state.Y.size());
  diffusion.advance({state.Y, solution, mass, content}, dt, [&](int face, std::span<const double> row) {
    std::copy(row.begin(), row.end(), flux.begin() + static_cast<std::ptrdiff_t>(at(face) * n));
  });
  return flux;
}

class Diffusing : public testing::Test {
 protected:
  Gas& gas = Gas::hydrogen();
  std::vector<double> fuel = gas.massFractions("H2: 1, H2O: 0.2, H: 0.01");
  std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79, OH: 0.02");

  Box::Local blend(double share, double temperature) const {
    Box::Local local;
    local.temperature = temperature;
    for (std::size_t k = 0; k < fuel.size(); ++k) local.Y.push_back(share * fuel[k] + (1.0 - share) * air[k]);
    return local;
  }
  // Three gases, each with its own wave: the species' ratios of differences differ, and so do their limiters.
  Box::Local mixed(const Vector3& x) const {
    const double share = 0.5 + 0.5 * std::sin(400.0 * x[0]) * std::cos(300.0 * x[1]);
    const double steam = 0.3 + 0.2 * std::sin(900.0 * x[0] + 500.0 * x[1]);
    Box::Local local = blend(share, 400.0 + 1200.0 * share * (1.0 - share));
    for (double& y : local.Y) y *= 1.0 - steam;
    local.Y[gas.mechanism.speciesIndex("H2O")] += steam;
    return local;
  }
  // Inlet of given composition, outlet, symmetry and wall: every kind of boundary.
  std::vector<Side> sides() const {
    Side inlet = opening(BoundaryKind::Inlet, 1, false, 0.1, 300.0, fuel);
    inlet.condition.fixedComposition = true;
    return {side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Wall, 0, true), inlet,
            opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, air)};
  }
  Box box{Geometry::Axisymmetric, {gradedAxis(0.0, {{0.01, 12, 2.0}}), gradedAxis(0.0, {{0.01, 10, 0.5}})}, sides()};
};

TEST_F(Diffusing, FluxesSumToZeroAtEveryFace) {
  const auto flux = fluxesOf(box, box.state([&](const auto& x) { return mixed(x); }), 1e-4);
  const auto n = gas.mechanism.numSpecies();
  double largestFlux = 0.0;
  for (int face = 0; face < box.mesh.faces; ++face) {
    double sum = 0.0;
    double scale = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
      sum += flux[at(face) * n + k];
      scale += std::abs(flux[at(face) * n + k]);
    }
    // Two sums of n terms, and the corrections of n terms.
    EXPECT_LE(std::abs(sum), 4.0 * static_cast<double>(n) * epsilon * scale) << "face " << face;
    largestFlux = std::max(largestFlux, scale);
  }
  EXPECT_GT(maxOverRanks(largestFlux), 0.0);
}

TEST_F(Diffusing, NothingDiffusesThroughWallsAxisAndOutlets) {
  const auto flux = fluxesOf(box, box.state([&](const auto& x) { return mixed(x); }), 1e-4);
  const auto n = gas.mechanism.numSpecies();
  for (int face = box.mesh.interiorFaces; face < box.mesh.faces; ++face)
    if (box.context.boundaryOf(face).kind != BoundaryKind::Inlet) {
      for (std::size_t k = 0; k < n; ++k) EXPECT_EQ(flux[at(face) * n + k], 0.0);
    }
}

TEST_F(Diffusing, BothRanksComputeTheSameFluxThroughASharedFace) {
  const Mesh& m = box.mesh;
  const auto flux = fluxesOf(box, box.state([&](const auto& x) { return mixed(x); }), 1e-4);
  const auto n = gas.mechanism.numSpecies();
  // Bit patterns of every species at each interior face, by the pair of natural cells: [owner of low | owner of high].
  const auto faces = static_cast<std::size_t>(2 * m.totalCells);
  std::vector<std::uint64_t> bits(2 * faces * n, 0);
  std::size_t shared = 0;
  for (int face = 0; face < m.interiorFaces; ++face) {
    const auto key = static_cast<std::size_t>(2 * m.naturalCell[at(m.low[at(face)])] + axisOf(m, face));
    for (std::size_t k = 0; k < n; ++k) {
      std::uint64_t pattern = 0;
      std::memcpy(&pattern, &flux[at(face) * n + k], sizeof pattern);
      if (m.low[at(face)] < m.owned) bits[key * n + k] = pattern;
      if (m.high[at(face)] < m.owned) bits[(faces + key) * n + k] = pattern;
    }
    shared += m.low[at(face)] >= m.owned || m.high[at(face)] >= m.owned;
  }
  MPI_Allreduce(MPI_IN_PLACE, bits.data(), static_cast<int>(bits.size()), MPI_UINT64_T, MPI_BOR, MPI_COMM_WORLD);
  for (std::size_t i = 0; i < faces * n; ++i) ASSERT_EQ(bits[i], bits[faces * n + i]) << "face " << i / n;
  EXPECT_EQ(shared > 0, m.ranks > 1);
}

TEST_F(Diffusing, FaceStateSumsToOneAndIsInPressureEquilibrium) {
  const State state = box.state([&](const auto& x) { return mixed(x); });
  FaceState faces(box.context, state);
  faces.prepare(state, state.Y);
  const auto n = gas.mechanism.numSpecies();
  for (const double sign : {1.0, -1.0}) {
    for (int face = 0; face < box.mesh.faces; ++face) {
      std::vector<double> Y(n);
      faces.interpolate(state, face, sign, Y);
      double sum = 0.0;
      for (double y : Y) sum += y;
      EXPECT_NEAR(sum, 1.0, 4.0 * static_cast<double>(n) * epsilon);
      const double T = faces.temperature[at(face)];
      const double p = faces.density[at(face)] * constants::gasConstant * T / gas.thermo.meanMolecularWeight(Y);
      EXPECT_NEAR(p / state.thermodynamicPressure, 1.0, 16.0 * epsilon);
      const double h = gas.thermo.enthalpyMass(T, Y);
      EXPECT_NEAR(faces.enthalpy[at(face)], h, 16.0 * epsilon * std::abs(h));
    }
  }
}

// A small cosine of H2 in N2 decays as exp(-D (pi/L)^2 t). In a binary mixture the mixture-averaged flux is Fick's with
// the binary coefficient: j_1 = -rho D12 grad Y1.
TEST_F(Diffusing, BinaryCosineDecaysAtTheAnalyticRate) {
  const double length = 0.01;
  const int cells = 32;
  const std::size_t h2 = gas.mechanism.speciesIndex("H2");
  const std::size_t n2 = gas.mechanism.speciesIndex("N2");
  Box tube(Geometry::Planar, {uniformAxis(length, cells), uniformAxis(1e-3, 2)},
           {side(BoundaryKind::Wall, 0, false), side(BoundaryKind::Wall, 0, true), side(BoundaryKind::Wall, 1, false),
            opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, air)});
  const double wave = std::numbers::pi / length;
  // Small: W of the mixture varies by 1e-5, so that the coefficient is constant.
  const double mean = 1e-2;
  const double amplitude = 1e-6;
  const State state = tube.state([&](const Vector3& x) {
    Box::Local local{{0.0, 0.0}, 300.0, std::vector<double>(gas.mechanism.numSpecies(), 0.0)};
    local.Y[h2] = mean + amplitude * std::cos(wave * x[0]);
    local.Y[n2] = 1.0 - local.Y[h2];
    return local;
  });
  const double D = gas.transport.binaryDiffusion(300.0, state.thermodynamicPressure, h2, n2);
  const double dt = 1e-3 / (D * wave * wave);
  const auto flux = fluxesOf(tube, state, dt);
  const Mesh& m = tube.mesh;
  // Amplitude of the flux: its projection onto sin(wave x) over all faces normal to x.
  double sum = 0.0;
  for (int face = 0; face < m.interiorFaces; ++face) {
    if (axisOf(m, face) != 0 || m.low[at(face)] >= m.owned) continue;
    sum += flux[at(face) * gas.mechanism.numSpecies() + h2] / m.area[at(face)] *
           std::sin(wave * m.faceCentre[at(face)][0]);
  }
  const double found = sumOverRanks(sum) * 2.0 / (2.0 * cells);  // two rows of cells
  const double density = minOverRanks(state.density[0]);
  const double exact = density * D * wave * amplitude;
  // Second order in space: (wave dx)^2/24 = 4e-4; implicit in time: decay of 1e-3 over the step; the raising of every X
  // by 1e-12 and the variation of density and W: below 1e-4.
  EXPECT_NEAR(found / exact, 1.0, 4.1e-4 + 1e-3 + 1e-4);
}

// Where all else brings what conduction takes, conduction is what it is, in a step in which all else would heat cells
// by hundreds of kelvin too; and without conduction cells get the temperature that all else leads to.
TEST_F(Diffusing, HeatOfASteadyStateDoesNotDependOnTheStep) {
  Box box(Geometry::Planar, {uniformAxis(0.01, 12), uniformAxis(0.01, 1)},
          {side(BoundaryKind::Wall, 0, false), side(BoundaryKind::Wall, 0, true), side(BoundaryKind::Wall, 1, false),
           side(BoundaryKind::Wall, 1, true)});
  State state = box.state([&](const Vector3& x) { return blend(0.3, 900.0 + 600.0 * std::sin(500.0 * x[0])); });
  GasProperties properties;
  properties.update(box.context, state);
  const Mesh& m = box.mesh;
  ImplicitDiffusion solver(m, box.halo);
  HeatConduction conduction(box.context, solver);
  conduction.prepare(state, properties);
  std::vector<double> present(at(m.faces)), flux(present);
  conduction.presentFlux(state, present);
  double largestFlux = 0.0;
  for (const double one : present) largestFlux = std::max(largestFlux, std::abs(one));
  for (const bool atOnce : {false, true})
    for (const double dt : {1e-5, 3e-3}) {
      std::vector<double> mass(at(m.owned)), content, heat(at(m.owned));
      for (int c = 0; c < m.owned; ++c) {
        mass[at(c)] = state.density[at(c)] * m.volume[at(c)];
        heat[at(c)] = mass[at(c)] * state.enthalpy[at(c)];
        for (std::size_t k = 0; k < fuel.size(); ++k) content.push_back(mass[at(c)] * state.Y[at(c) * fuel.size() + k]);
      }
      addFaceFluxes(m, present, 1, -dt, heat);
      conduction.implicitFlux(state, {mass, content, heat}, dt, flux, [&](int) { return atOnce; });
      for (std::size_t face = 0; face < flux.size(); ++face)
        EXPECT_NEAR(flux[face], present[face], 1e-9 * largestFlux) << face << ", " << dt;
    }
}

}  // namespace
}  // namespace lampblack::test
