// A flame as the start of another one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "chemistry/thermo/thermo.hpp"
#include "core/errors.hpp"
#include "flow/flame/initial_flame.hpp"
#include "tests/every_module.hpp"
#include "tests/flow/flame/streams.hpp"

namespace lampblack::test {
namespace {

const Mechanism& drm() {
  static const auto m = shippedMechanism("methane_drm19_21.yaml");
  return m;
}
const Mechanism& gri() {
  static const auto m = shippedMechanism("methane_gri30_53.yaml");
  return m;
}

FlameProblem counterflow(const Mechanism& m, double speed = 0.2, const char* oxidiser = "O2: 0.21, N2: 0.79") {
  FlameProblem p;
  p.type = FlameType::Counterflow;
  p.left = streamAt(m, "CH4: 1", 300, speed);
  p.right = streamAt(m, oxidiser, 300, speed);
  return p;
}

FlameProblem premixed(const Mechanism& m, FlameType type) {
  FlameProblem p;
  p.type = type;
  p.left = streamAt(m, "CH4: 1, O2: 2, N2: 7.52", 300, 0.2);
  return p;
}

NamedFlameProfile named(const Mechanism& m, FlameProfile profile, std::vector<std::string> scalars = {}) {
  NamedFlameProfile n{std::move(profile), {}, std::move(scalars)};
  for (std::size_t k = 0; k < m.numSpecies(); ++k) n.species.push_back(m.speciesName(k));
  return n;
}

void expectContinuous(const Mechanism& m, const FlameProblem& problem, const FlameProfile& p) {
  const Thermo thermo(m);
  double flux = p.global(leftMassFlux);
  for (std::size_t i = 0; i < p.points(); ++i) {
    const double low = i == 0 ? p.z[0] : 0.5 * (p.z[i - 1] + p.z[i]);
    const double high = i + 1 == p.points() ? p.z[i] : 0.5 * (p.z[i] + p.z[i + 1]);
    const double rho = thermo.density(p.temperature(i), problem.pressure, p.massFractions(i));
    flux -= 2 * rho * p.at(i, FlameLayout::spread) * (high - low);
    EXPECT_NEAR(p.at(i, FlameLayout::massFlux), flux, 1e-12);
  }
}

TEST(StartFrom, TheSameFlameIsTheSameStart) {
  for (const auto& problem :
       {counterflow(drm()), premixed(drm(), FlameType::Free), premixed(drm(), FlameType::Burner), [] {
          auto p = premixed(drm(), FlameType::Wall);
          return p;
        }()}) {
    auto old = initialFlame(drm(), problem, 2);
    for (std::size_t i = 0; i < old.points(); ++i) {
      old.at(i, old.layout.firstScalar()) = old.z[i];
      old.at(i, old.layout.firstScalar() + 1) = 1;
    }
    const std::vector<std::string> scalars{"number", "mass"};
    const auto p = startFrom(named(drm(), old, scalars), drm(), problem, scalars);
    ASSERT_EQ(p.z, old.z);
    // Rounding of the sum of fractions, and of the sum of volumes.
    for (std::size_t i = 0; i < p.x.size(); ++i)
      EXPECT_NEAR(p.x[i], old.x[i], 1e-11 * std::max(1.0, std::abs(old.x[i])));
  }
}

TEST(StartFrom, GoesToAnotherMechanismByNameAndKeepsWhatItKnowsOfTheScalars) {
  const auto problem = counterflow(drm());
  auto old = initialFlame(drm(), problem, 2);
  for (std::size_t i = 0; i < old.points(); ++i) old.at(i, old.layout.firstScalar() + 1) = 7;
  const auto next = counterflow(gri());
  const std::vector<std::string> scalars{"mass", "surface"};
  const auto p = startFrom(named(drm(), old, {"number", "mass"}), gri(), next, scalars);
  ASSERT_EQ(p.layout.species, gri().numSpecies());
  ASSERT_EQ(p.points(), old.points());
  for (std::size_t i = 0; i < p.points(); ++i) {
    double sum = 0;
    for (double Y : p.massFractions(i)) sum += Y;
    EXPECT_NEAR(sum, 1, 1e-14);
    // GRI has all of DRM19's species.
    for (std::size_t k = 0; k < drm().numSpecies(); ++k)
      EXPECT_NEAR(p.massFractions(i)[gri().speciesIndex(drm().speciesName(k))], old.massFractions(i)[k], 1e-13);
    EXPECT_EQ(p.scalars(i)[0], 7.0);
    EXPECT_EQ(p.scalars(i)[1], 0.0);
  }
  expectContinuous(gri(), next, p);
  // And back, where most species are unknown.
  const auto back = startFrom(named(gri(), p, scalars), drm(), problem, {});
  for (std::size_t i = 0; i < p.points(); ++i)
    for (std::size_t k = 0; k < drm().numSpecies(); ++k)
      EXPECT_NEAR(back.massFractions(i)[k], old.massFractions(i)[k], 1e-13);
}

TEST(StartFrom, TakesTheNewStreamsAndFluxesAndLeavesTheFlameAlone) {
  const auto old = initialFlame(drm(), counterflow(drm()), 0);
  auto problem = counterflow(drm(), 0.4, "O2: 0.25, N2: 0.75");
  problem.left.temperature = 400;
  const auto p = startFrom(named(drm(), old), drm(), problem, {});
  const std::size_t last = p.points() - 1;
  for (std::size_t k = 0; k < drm().numSpecies(); ++k) {
    EXPECT_EQ(p.massFractions(0)[k], problem.left.Y[k]);
    EXPECT_EQ(p.massFractions(last)[k], problem.right->Y[k]);
  }
  EXPECT_EQ(p.temperature(0), 400);
  EXPECT_EQ(p.global(leftMassFlux), problem.left.massFlux);
  EXPECT_EQ(p.at(last, FlameLayout::massFlux), -problem.right->massFlux);
  expectContinuous(drm(), problem, p);
  for (std::size_t i = 0; i <= last; ++i)
    for (double Y : p.massFractions(i)) EXPECT_GE(Y, 0.0);
  EXPECT_EQ(p.peakTemperature(), old.peakTemperature());
  // Twice the flux of the same gas in the same space needs twice the spreading and four times the pressure gradient.
  const auto faster = startFrom(named(drm(), old), drm(), counterflow(drm(), 0.4), {});
  EXPECT_NEAR(faster.global(pressureGradient) / old.global(pressureGradient), 4, 1e-10);
  EXPECT_NEAR(faster.at(20, FlameLayout::spread), 2 * old.at(20, FlameLayout::spread), 1e-9);
}

TEST(StartFrom, FitsTheNewLength) {
  const auto old = initialFlame(drm(), counterflow(drm()), 0);
  auto problem = counterflow(drm());
  problem.length = 0.01;
  auto p = startFrom(named(drm(), old), drm(), problem, {});
  EXPECT_EQ(p.points(), old.points());
  EXPECT_EQ(p.z.back(), 0.01);
  EXPECT_NEAR(p.at(20, FlameLayout::spread), 2 * old.at(20, FlameLayout::spread), 1e-9);
  expectContinuous(drm(), problem, p);

  auto burner = premixed(drm(), FlameType::Burner);
  const auto flame = initialFlame(drm(), burner, 0);
  for (double length : {0.012, 0.05}) {
    burner.length = length;
    p = startFrom(named(drm(), flame), drm(), burner, {});
    EXPECT_EQ(p.z.back(), length);
    EXPECT_EQ(p.temperature(10), flame.temperature(10));
    EXPECT_EQ(p.z[10], flame.z[10]);
    expectContinuous(drm(), burner, p);
  }
  auto free = premixed(drm(), FlameType::Free);
  free.length = 0.06;
  const auto wide = initialFlame(drm(), free, 0);
  free.length = 0.02;
  EXPECT_EQ(startFrom(named(drm(), wide), drm(), free, {}).z, wide.z) << "a widened domain stays";
}

TEST(StartFrom, RefusesWhatDoesNotFit) {
  const auto problem = counterflow(drm());
  auto wrong = named(drm(), initialFlame(drm(), problem, 0));
  for (auto& name : wrong.species) name = "not " + name;
  EXPECT_THROW(static_cast<void>(startFrom(wrong, drm(), problem, {})), InputError);
  wrong = named(drm(), initialFlame(drm(), problem, 0));
  wrong.species.pop_back();
  EXPECT_THROW(static_cast<void>(startFrom(wrong, drm(), problem, {})), InputError);
  // A flame without spreading cannot become one with it.
  const auto flat = named(drm(), initialFlame(drm(), premixed(drm(), FlameType::Free), 0));
  EXPECT_THROW(static_cast<void>(startFrom(flat, drm(), problem, {})), NumericsError);
}

}  // namespace
}  // namespace lampblack::test
