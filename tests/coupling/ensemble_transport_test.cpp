// Particles of ensembles that move between cells: their mean is a finite-volume scalar's, nothing is lost, and ranks do
// not matter. The gas is given: the flow solver has no part in it.
#include "coupling/ensemble_transport.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>

#include "core/constants.hpp"
#include "particles/collisions/collision_physics.hpp"
#include "particles/collisions/sphere.hpp"
#include "tests/coupling/mean_of_repeats.hpp"
#include "tests/coupling/moving_particles.hpp"
#include "tests/every_module.hpp"
#include "tests/flow/flow_fixture.hpp"
#include "tests/particles/statistics.hpp"

namespace lampblack::test {
namespace {

using moving::fieldAfter;
using moving::hill;
using moving::massOf;
using moving::MeanOfRepeats;
using moving::Moving;
using moving::sootDensity;
using moving::vortex;

struct Motion {
  std::string name;
  bool turns, drifts, diffuses, walls = false;
  double eddies = 0.0;  // m2/s
};
void PrintTo(const Motion& motion, std::ostream* out) {
  *out << motion.name;
}

class MeanOfParticles : public testing::TestWithParam<Motion> {};
INSTANTIATE_TEST_SUITE_P(Motions, MeanOfParticles,
                         testing::Values(Motion{"convection", true, false, false}, Motion{"drift", false, true, false},
                                         Motion{"diffusion", false, false, true}, Motion{"all", true, true, true},
                                         Motion{"allWithWalls", true, true, true, true},
                                         Motion{"eddies", false, false, false, false, 5e-4},
                                         Motion{"allWithEddies", true, true, true, false, 5e-4}),
                         [](const auto& info) { return info.param.name; });

TEST_P(MeanOfParticles, IsTheFiniteVolumeField) {
  const Motion& motion = GetParam();
  constexpr int cells = 8, steps = 6, repeats = 100;
  constexpr double dt = 2e-4, d = 2e-9;
  MeanOfRepeats numbers, fourth;
  std::vector<double> expected;
  for (int r = 0; r < repeats; ++r) {
    Moving m(
        cells, motion.turns ? vortex : [](const Vector3&) { return Vector3{}; });
    if (motion.drifts) m.driftAt(motion.walls ? 0.1 : 0.8);
    if (motion.walls) m.letWallsTake();
    if (motion.eddies > 0.0)
      m.state.eddyViscosity.assign(m.state.density.size(), motion.eddies * m.state.density[0] * 0.9);
    m.fill(40, hill, 0.0);
    EnsembleTransport transport = m.transport(motion.diffuses, 1000 + static_cast<std::uint64_t>(r));
    if (expected.empty()) {
      std::vector<double> field(at(m.box.mesh.cells));
      for (int c = 0; c < m.box.mesh.owned; ++c) field[at(c)] = m.moment(c, 0.0);
      const CarrierGas gas{1500.0, constants::oneAtmosphere, m.state.density[0], 5e-5, 0.028};
      expected = fieldAfter(m, field, dt, (motion.diffuses ? brownianDiffusivity(gas, d) : 0.0) + motion.eddies, steps);
    }
    for (int s = 0; s < steps; ++s) m.step(transport, dt, static_cast<std::uint64_t>(s));
    std::vector<double> values;
    for (int c = 0; c < m.box.mesh.owned; ++c) values.push_back(m.moment(c, 0.0));
    numbers.add(values);
  }
  const auto score = numbers.against(expected);
  report(
      fmt::format("{}: largest |z| {:.2f} of 64 cells, mean square {:.2f}", motion.name, score.largest, score.square));
  // Of 64 cells at 99.9 % together: each at 4.3 (t distribution of 99 degrees).
  EXPECT_LT(score.largest, 4.5);
  EXPECT_LT(score.square, 1.6);
}

// Diffusion on triangles, where the steps between centres are oblique to the faces: numbers that rise evenly stay, away
// from the walls.
TEST(EnsembleTransport, DiffusesAcrossObliqueFacesAsAcrossOthers) {
  constexpr int repeats = 30;
  const double d = 2e-9, edge = 0.003;
  const auto rising = [](const Vector3& x) { return 1e16 * (0.2 + 120.0 * x[0] + 60.0 * x[1]); };
  MeanOfRepeats numbers;
  std::vector<double> before;
  double diffused = 0.0;
  for (int r = 0; r < repeats; ++r) {
    Moving m(
        10, [](const Vector3&) { return Vector3{}; }, MPI_COMM_WORLD, Split{Cells::Triangles});
    m.fill(300, rising, 0.0);
    const Mesh& mesh = m.box.mesh;
    std::vector<int> inner;
    for (int c = 0; c < mesh.owned; ++c)
      if (const Vector3& x = mesh.centre[at(c)];
          std::abs(x[0] - 0.005) < 0.005 - edge && std::abs(x[1] - 0.005) < 0.005 - edge)
        inner.push_back(c);
    if (before.empty())
      for (const int c : inner) before.push_back(m.moment(c, 0.0));
    EnsembleTransport transport = m.transport(true, 300 + static_cast<std::uint64_t>(r));
    const CarrierGas gas{1500.0, constants::oneAtmosphere, m.state.density[0], 5e-5, 0.028};
    const double dt = 1e-7 / brownianDiffusivity(gas, d);  // 0.3 mm
    m.step(transport, dt, 0);
    EXPECT_EQ(sumOverRanks(static_cast<double>(transport.limited())), 0.0);
    std::vector<double> values;
    for (const int c : inner) values.push_back(m.moment(c, 0.0));
    numbers.add(values);
    diffused = static_cast<double>(m.arrived[at(inner.empty() ? 0 : inner[0])].size());
  }
  EXPECT_GT(diffused, 0.0);
  const auto score = numbers.against(before);
  report(fmt::format("oblique faces: largest |z| {:.2f}, mean square {:.2f}", score.largest, score.square));
  EXPECT_LT(score.largest, 4.5);
  EXPECT_LT(score.square, 2.5);  // of neighbours that share faces; 60 without the correction
}

// Alone in the middle of 3 x 3 cells of gas at rest: the share that diffuses out in a half of a step.
TEST(EnsembleTransport, DiffusesByTheDiameterOfMobility) {
  struct One {
    double primaries, diameter;
  };
  for (const auto& [primaries, d] : {One{1, 2e-9}, {1, 7e-9}, {30, 4e-9}, {1, 3.3e-7}}) {
    Moving m(3, [](const Vector3&) { return Vector3{}; });
    const double h = 0.01 / 3, share = 0.1;
    const CarrierGas gas{1500.0, m.state.thermodynamicPressure, m.state.density[0], 5e-5, 0.028};
    const double D = brownianDiffusivity(gas, SootAggregate::mobilityFactor(primaries) * d);
    constexpr int count = 20000;
    for (int c = 0; c < m.box.mesh.owned; ++c) {
      m.populations[at(c)].assign(packedHead, 0.0);
      if (std::hypot(m.box.mesh.centre[at(c)][0] - 0.005, m.box.mesh.centre[at(c)][1] - 0.005) > 1e-6) continue;
      for (int k = 0; k < count; ++k)
        packDoubles(m.populations[at(c)], GivenParticle{primaries * massOf(d), 0.0, primaries, 1e10});
    }
    EnsembleTransport transport(m.box.context, {{sootDensity, SootShape::aggregates}, 0.55, true, true, 5});
    transport.advance({m.state, m.drift, m.density, m.properties}, 2 * share * h * h / (4 * D), 0,
                      EnsembleTransport::Half::First, m.populations, m.arrived);
    EXPECT_EQ(transport.parts(), 1);
    for (int c = 0; c < m.box.mesh.owned; ++c)
      if (const auto left = packedParticles(m.populations[at(c)]).size(); left > 0) {
        EXPECT_NEAR(1 - static_cast<double>(left) / count, share, 0.02 * share) << primaries << " of " << d;
      }
  }
}

// Numbers and all moments in the whole of a closed box stay, to round-off, on any number of ranks and on cells of any
// shape.
TEST(EnsembleTransport, KeepsEveryMomentOfTheWhole) {
  for (const std::optional<Split>& split : {std::optional<Split>{}, std::optional<Split>{Split{Cells::Triangles}}}) {
    Moving m(8, vortex, MPI_COMM_WORLD, split);
    m.fill(60, hill);
    EnsembleTransport transport = m.transport(true, 1);
    std::map<double, double> before;
    for (const double order : {0.0, 1.0, 3.0, 6.0}) before[order] = m.total(order);
    for (int s = 0; s < 20; ++s) m.step(transport, 2e-4, static_cast<std::uint64_t>(s));
    for (const auto& [order, value] : before) EXPECT_NEAR(m.total(order) / value, 1.0, 1e-13) << order;
    for (const auto& population : m.populations)  // who has left leaves nothing behind
      for (const GivenParticle& p : packedParticles(population)) EXPECT_GT(p.number, 0.0);
  }
}

// Each moment by itself: particles of many sizes, by the mean over repeats of all particles' x and y.
TEST(EnsembleTransport, MovesEveryMomentAlike) {
  constexpr int repeats = 60;
  const std::vector<double> orders{0.0, 1.0, 2.0, 3.0, 4.0};
  std::vector<std::vector<double>> centres(orders.size());
  double expected = 0.0;
  for (int r = 0; r < repeats; ++r) {
    Moving m(8, vortex);
    m.fill(40, hill);
    if (r == 0) {
      std::vector<double> field(at(m.box.mesh.cells));
      for (int c = 0; c < m.box.mesh.owned; ++c) field[at(c)] = m.moment(c, 0.0);
      const std::vector<double> after = fieldAfter(m, field, 2e-4, 0.0, 8);
      const double number = integral(m.box.mesh, [&](int c) { return after[at(c)]; });
      expected = integral(m.box.mesh, [&](int c) { return after[at(c)] * m.box.mesh.centre[at(c)][0]; }) / number;
    }
    EnsembleTransport transport = m.transport(false, 500 + static_cast<std::uint64_t>(r));
    for (int s = 0; s < 8; ++s) m.step(transport, 2e-4, static_cast<std::uint64_t>(s));
    for (std::size_t k = 0; k < orders.size(); ++k)
      centres[k].push_back(
          integral(m.box.mesh, [&](int c) { return m.moment(c, orders[k]) * m.box.mesh.centre[at(c)][0]; }) /
          m.total(orders[k]));
  }
  for (std::size_t k = 0; k < orders.size(); ++k) {
    const Sample sample = summarise(centres[k]);
    EXPECT_LT(std::abs(sample.mean - expected) / sample.standardError, zLimit) << "order " << orders[k];
  }
}

// The scatter of a cell's number falls at least as one over the number of particles.
TEST(EnsembleTransport, ScattersLessWithMoreParticles) {
  const auto variance = [](int count) {
    constexpr int repeats = 40;
    std::map<int, std::vector<double>> all;
    for (int r = 0; r < repeats; ++r) {
      Moving m(6, vortex);
      m.fill(count, hill);
      EnsembleTransport transport = m.transport(true, 77 + static_cast<std::uint64_t>(r));
      for (int s = 0; s < 6; ++s) m.step(transport, 2e-4, static_cast<std::uint64_t>(s));
      for (int c = 0; c < m.box.mesh.owned; ++c) all[c].push_back(m.moment(c, 0.0) / 1e16);
    }
    double sum = 0.0;
    for (const auto& [cell, values] : all) {
      const Sample sample = summarise(values);
      sum += sample.standardError * sample.standardError * repeats;
    }
    return sumOverRanks(sum) / 36.0;
  };
  const double few = variance(20), many = variance(320);
  report(
      fmt::format("variance of a cell's number over its square: {:.2e} with 20 particles, {:.2e} with 320", few, many));
  EXPECT_LT(many, few / 16.0 * 1.4);  // each of 36 cells by 40 repeats: 4 % and more
}

// Second order: a hill carried once around, on twice as many cells.
TEST(EnsembleTransportLong, ErrsFourTimesLessOnHalfTheCells) {
  const auto error = [](int cells, int steps) {
    Moving m(cells, [](const Vector3& x) { return vortex(x); });
    const auto smooth = [](const Vector3& x) {
      const double k = constants::pi / 0.01;
      // A function of the stream function does not change, plus one that turns.
      return 1e16 * (1.0 + 0.5 * std::sin(k * x[0]) * std::sin(k * x[1]));
    };
    m.fill(4000, smooth, 0.0);
    EnsembleTransport transport = m.transport(false, 3);
    for (int s = 0; s < steps; ++s) m.step(transport, 4e-3 / steps, static_cast<std::uint64_t>(s));
    return integral(m.box.mesh, [&](int c) { return std::abs(m.moment(c, 0.0) - smooth(m.box.mesh.centre[at(c)])); }) /
           m.total(0.0);
  };
  const double coarse = error(8, 16), fine = error(16, 32);
  report(fmt::format("error of a steady hill in a vortex: {:.2e} on 8 x 8 cells, {:.2e} on 16 x 16", coarse, fine));
  EXPECT_LT(fine, coarse / 2.8);
}

// The same particles on any number of ranks, in the same order; and the same at the walls, where all that is lost is.
TEST(EnsembleTransport, DoesNotDependOnRanks) {
  Moving alone(8, vortex, MPI_COMM_SELF), together(8, vortex);
  std::map<std::int64_t, std::vector<double>> gone[2];  // of each face, by its number
  for (Moving* m : {&alone, &together}) {
    m->letWallsTake();
    m->driftAt(0.1);
    m->fill(50, hill);
    EnsembleTransport transport = m->transport(true, 9);
    double taken = 0.0, start = 0.0, end = 0.0;
    for (int c = 0; c < m->box.mesh.owned; ++c) start += m->box.mesh.volume[at(c)] * m->moment(c, 0.0);
    for (int s = 0; s < 10; ++s) {
      m->step(transport, 3e-4, static_cast<std::uint64_t>(s));
      std::size_t row = 0;
      ParticleRows{packedHead}.forEach(transport.gone(), [&](const double* particle) {
        const int face = transport.goneThrough()[row++];
        ASSERT_LT(m->box.mesh.high[at(face)], 0);
        gone[m == &together ? 1 : 0][m->box.mesh.faceNumber[at(face)]].push_back(particle[packedNumberAt]);
        taken += particle[packedNumberAt];
      });
      EXPECT_EQ(row, transport.goneThrough().size());
    }
    for (int c = 0; c < m->box.mesh.owned; ++c) end += m->box.mesh.volume[at(c)] * m->moment(c, 0.0);
    if (m == &together)
      for (double* sum : {&taken, &start, &end}) *sum = sumOverRanks(*sum);
    EXPECT_NEAR((end + taken) / start, 1.0, 1e-13);
    EXPECT_GT(taken, 0.01 * start);
  }
  for (const auto& [face, numbers] : gone[1]) EXPECT_EQ(numbers, gone[0][face]) << face;
  EXPECT_EQ(sumOverRanks(static_cast<double>(gone[1].size())), static_cast<double>(gone[0].size()));
  for (int c = 0; c < together.box.mesh.owned; ++c) {
    const int same = alone.box.mesh.findOwned(together.box.mesh.naturalCell[at(c)]);
    EXPECT_EQ(together.populations[at(c)], alone.populations[at(same)]) << c;
  }
}

// One cell full, its neighbours empty: lines through the values leave what can be at the faces, which is counted.
TEST(EnsembleTransport, CountsTheParticlesWhoseProbabilityIsLimited) {
  for (const bool secondOrder : {true, false}) {
    Moving m(8, [](const Vector3&) { return Vector3{0.1, 0.0, 0.0}; });
    m.fill(50, [](const Vector3& x) { return x[0] > 0.005 && x[0] < 0.00625 ? 1e15 : 0.1 * x[0]; });
    EnsembleTransport transport(m.box.context, {{sootDensity, true}, 0.0, false, secondOrder, 9});
    m.step(transport, 1e-3, 0);
    double limited = static_cast<double>(transport.limited());
    MPI_Allreduce(MPI_IN_PLACE, &limited, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    if (secondOrder)
      EXPECT_GE(limited, 50.0);  // of a column's cell at least
    else
      EXPECT_EQ(limited, 0.0);
  }
}

}  // namespace
}  // namespace lampblack::test
