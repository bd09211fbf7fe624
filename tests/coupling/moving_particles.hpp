// Ensembles in a box of still or moving gas that is given, for tests of how particles move between cells.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/constants.hpp"
#include "coupling/ensemble_transport.hpp"
#include "particles/collisions/sphere.hpp"
#include "tests/coupling/closed_box.hpp"
#include "tests/every_module.hpp"
#include "tests/flow/flow_fixture.hpp"

namespace lampblack::test::moving {

inline constexpr double sootDensity = 1800.0;
inline double massOf(double d) {
  return sootDensity * constants::pi / 6.0 * d * d * d;
}

// A box of still or moving gas without boundaries that let anything out, and ensembles in it.
struct Moving {
  using Velocity = std::function<Vector3(const Vector3&)>;
  explicit Moving(int cells, const Velocity& velocity, MPI_Comm comm = MPI_COMM_WORLD, std::optional<Split> split = {})
      : box(closedBox(0.01, cells, cells), fourWalls(), split, comm),
        state(box.state([&](const Vector3& x) {
          return Box::Local{velocity(x), 1500.0, Gas::hydrogen().massFractions("N2: 1")};
        })),
        drift(at(box.mesh.faces)),
        density(at(box.mesh.faces), state.density[0]),
        populations(at(box.mesh.owned)),
        arrived(populations.size()) {
    const Mesh& m = box.mesh;
    for (int face = 0; face < m.interiorFaces; ++face)
      state.massFlux[at(face)] =
          state.density[0] * m.area[at(face)] * dot(velocity(m.faceCentre[at(face)]), m.normal[at(face)]);
    state.keepStart();
    properties.viscosity.assign(at(m.cells), 5e-5);
    properties.molecularWeight.assign(at(m.cells), 0.028);
  }

  void letWallsTake() {
    for (BoundaryCondition& wall : box.context.boundaries) wall.takesParticles = true;
  }
  // Along x, of all faces.
  void driftAt(double speed) {
    for (int face = 0; face < box.mesh.faces; ++face)
      drift[at(face)] = state.density[0] * box.mesh.area[at(face)] * speed * box.mesh.normal[at(face)][0];
  }

  // `number(x)` per m3 in each cell, as `count` numerical particles of diameters from 2 nm on, each a tenth larger.
  void fill(int count, const std::function<double(const Vector3&)>& number, double spread = 0.1) {
    for (int c = 0; c < box.mesh.owned; ++c) {
      const double all = number(box.mesh.centre[at(c)]);
      populations[at(c)].assign(packedHead, 0.0);
      for (int k = 0; k < count; ++k)
        packDoubles(populations[at(c)],
                    GivenParticle{massOf(2e-9 * std::pow(1.0 + spread, k % 20)), 0.0, 1.0, all / count});
    }
  }
  void step(EnsembleTransport& transport, double dt, std::uint64_t number) {
    for (auto& rows : arrived) rows.clear();
    for (const auto half : {EnsembleTransport::Half::First, EnsembleTransport::Half::Second})
      transport.advance({state, drift, density, properties}, dt, number, half, populations, arrived);
    for (std::size_t c = 0; c < populations.size(); ++c)
      populations[c].insert(populations[c].end(), arrived[c].begin(), arrived[c].end());
  }
  [[nodiscard]] EnsembleTransport transport(bool diffusion, std::uint64_t seed, double thermophoresis = 0.55,
                                            ParticleRows rows = {packedHead}) const {
    return {box.context, {{sootDensity, true}, thermophoresis, diffusion, true, seed, rows}};
  }
  // Sum over the particles of a cell of number times diameter^order, per m3.
  [[nodiscard]] double moment(int cell, double order) const {
    double sum = 0.0;
    for (const GivenParticle& p : packedParticles(populations[at(cell)]))
      sum += p.number * std::pow(sphereDiameter(p.carbon / sootDensity) / 2e-9, order);
    return sum;
  }
  [[nodiscard]] double total(double order) const {
    return integral(box.mesh, [&](int c) { return moment(c, order); });
  }

  Box box;
  State state;
  std::vector<double> drift, density;
  GasProperties properties;
  std::vector<EnsembleTransport::Rows> populations, arrived;
};

// A vortex that turns round the box's centre and comes to rest at the walls.
inline Vector3 vortex(const Vector3& x) {
  const double k = constants::pi / 0.01;
  return {-std::sin(k * x[0]) * std::cos(k * x[1]), std::cos(k * x[0]) * std::sin(k * x[1]), 0.0};
}
inline double hill(const Vector3& x) {
  return 1e16 * (1.0 + 0.8 * std::sin(400.0 * x[0]) * std::cos(300.0 * x[1]));
}

}  // namespace lampblack::test::moving
