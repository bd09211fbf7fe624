// Steps of particles between cells that are taken in parts, by each class in as many as it needs.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "particles/collisions/collision_physics.hpp"
#include "tests/coupling/mean_of_repeats.hpp"

namespace lampblack::test {
namespace {

using namespace moving;

// In parts of a half, of which each begins with what the one before left: the field in as many steps.
TEST(EnsembleParts, InPartsIsTheFiniteVolumeFieldInAsManySteps) {
  constexpr int repeats = 100, parts = 3;
  constexpr double dt = 3.4e-3;
  MeanOfRepeats numbers;
  std::vector<double> expected;
  for (int r = 0; r < repeats; ++r) {
    Moving m(8, vortex);
    m.fill(40, hill, 0.0);
    if (expected.empty()) {
      std::vector<double> field(at(m.box.mesh.cells));
      for (int c = 0; c < m.box.mesh.owned; ++c) field[at(c)] = m.moment(c, 0.0);
      expected = fieldAfter(m, field, dt / parts, 0.0, parts);
    }
    EnsembleTransport transport = m.transport(false, 4000 + static_cast<std::uint64_t>(r));
    m.step(transport, dt, 0);
    ASSERT_EQ(transport.parts(), 2 * parts);
    std::vector<double> values;
    for (int c = 0; c < m.box.mesh.owned; ++c) values.push_back(m.moment(c, 0.0));
    numbers.add(values);
  }
  const auto score = numbers.against(expected);
  report(fmt::format("in parts: largest |z| {:.2f} of 64 cells, mean square {:.2f}", score.largest, score.square));
  EXPECT_LT(score.largest, 4.5);
  EXPECT_LT(score.square, 1.6);
}

// Light particles in five parts of a half, those of twice the diameter in two, over three of them and two, large ones
// in one: each the field in these times.
TEST(EnsembleParts, EachClassGoesInAsManyPartsAsItNeeds) {
  struct Kind {
    double diameter;
    std::vector<double> parts;  // of five
    MeanOfRepeats numbers;
    std::vector<double> expected;
  };
  std::vector<Kind> kinds{{2e-9, {1, 1, 1, 1, 1}, {}, {}}, {4e-9, {3, 2}, {}, {}}, {3e-8, {5}, {}, {}}};
  constexpr int repeats = 40, count = 60, steps = 1;
  const auto slow = [](const Vector3& x) {
    const Vector3 u = vortex(x);
    return Vector3{0.008 * u[0], 0.008 * u[1], 0.0};
  };
  const auto numberOf = [](const Moving& m, int cell, double d) {
    double sum = 0.0;
    for (const GivenParticle& p : packedParticles(m.populations[at(cell)]))
      if (std::abs(p.carbon / massOf(d) - 1.0) < 0.1) sum += p.number;
    return sum;
  };
  for (int r = 0; r < repeats; ++r) {
    Moving m(8, slow);
    const CarrierGas gas{1500.0, constants::oneAtmosphere, m.state.density[0], 5e-5, 0.028};
    const double h = 0.01 / 8, dt = 2 * 2.1 * h * h / (4 * brownianDiffusivity(gas, kinds[0].diameter));
    for (int c = 0; c < m.box.mesh.owned; ++c) {
      m.populations[at(c)].assign(packedHead, 0.0);
      for (const Kind& kind : kinds)
        for (int k = 0; k < count; ++k)
          packDoubles(m.populations[at(c)],
                      GivenParticle{massOf(kind.diameter), 0.0, 1.0, hill(m.box.mesh.centre[at(c)]) / count});
    }
    for (Kind& kind : kinds) {
      if (r > 0) continue;
      std::vector<double> field(at(m.box.mesh.cells)), times;
      for (int c = 0; c < m.box.mesh.owned; ++c) field[at(c)] = numberOf(m, c, kind.diameter);
      for (int half = 0; half < 2 * steps; ++half)
        for (const double part : kind.parts) times.push_back(0.5 * dt * part / 5);
      kind.expected = fieldAfter(m, field, times, brownianDiffusivity(gas, kind.diameter));
    }
    EnsembleTransport transport = m.transport(true, 7100 + static_cast<std::uint64_t>(r), 0.0);
    for (int s = 0; s < steps; ++s) m.step(transport, dt, static_cast<std::uint64_t>(s));
    ASSERT_EQ(transport.parts(), 10);
    for (Kind& kind : kinds) {
      std::vector<double> values;
      for (int c = 0; c < m.box.mesh.owned; ++c) values.push_back(numberOf(m, c, kind.diameter));
      kind.numbers.add(values);
    }
  }
  for (const Kind& kind : kinds) {
    const auto score = kind.numbers.against(kind.expected);
    report(fmt::format("{} nm: largest |z| {:.2f} of 64 cells, mean square {:.2f}", 1e9 * kind.diameter, score.largest,
                       score.square));
    EXPECT_LT(score.largest, 4.6);
    EXPECT_LT(score.square, 1.6);
  }
}

// Tiny particles diffuse across more than a cell in a step: it is taken in parts, and nothing becomes negative or lost.
TEST(EnsembleParts, TakesStepsThatAreTooLongInParts) {
  Moving m(8, [](const Vector3&) { return Vector3{}; });
  m.fill(50, hill);
  EnsembleTransport transport = m.transport(true, 9);
  const double before = m.total(0.0);
  m.step(transport, 0.2, 0);
  EXPECT_GT(transport.parts(), 2);
  EXPECT_EQ(transport.limited(), 0);
  EXPECT_NEAR(m.total(0.0) / before, 1.0, 1e-13);
  EXPECT_THROW(m.step(transport, 50.0, 1), NumericsError);
}

}  // namespace
}  // namespace lampblack::test
