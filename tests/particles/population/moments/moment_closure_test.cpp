// How good the closures are where they are approximations. The bounds are what
// docs/theory/population_balance/moments.md promises, above what was measured there; references are exact solutions or
// sections.
#include "particles/population/model/particle_type.hpp"
#include "particles/population/model/sphere.hpp"
#include "particles/population/sectional/sectional_options.hpp"
#include "tests/every_module.hpp"
#include "tests/particles/population/moments/moment_fixtures.hpp"

namespace lampblack::test {
namespace {

constexpr double number = 1e18, volume = 1e-27;  // 1/m3, m3

struct Bound {
  Closure closure;
  double tolerance;
};

TEST(MomentClosure, EqualParticlesMeetAtTheirKernel) {
  // The first moments change as they do for equal particles: dM0/dt = -K N^2/2, dM2/dt = K N^2 v^2. After a part 1e-6
  // of a collision time the closures cannot tell more.
  const Sphere sphere(1800);
  for (const auto type : {CollisionKernelType::freeMolecular, CollisionKernelType::continuum,
                          CollisionKernelType::transition, CollisionKernelType::shear}) {
    const auto model = coagulating(type);
    const CollisionKernel kernel(*model.coagulation);
    const auto properties = kernelProperties(kernel, sphere, sphere.make(volume));
    const double rate = kernel.value(properties, properties) * number;
    for (const auto& closure : everyClosure()) {
      const auto solver = makeMoments(model, equalStart(number, volume), closure.options);
      solver->advance(1e-6 / rate);
      EXPECT_NEAR((1 - solver->moments()[0] / number) / 0.5e-6, 1, 1e-5) << closure.name;
      EXPECT_NEAR((solver->moments()[2] / (number * volume * volume) - 1) / 1e-6, 1, 1e-5) << closure.name;
    }
  }
}

TEST(MomentClosure, NumberAndWidthOfCoagulatingPopulations) {
  // To the self-preserving distribution of both limits, against 200 sections: their own error is 0.2 % in M2 (it falls
  // with the square of the spacing), far less in M0.
  const std::vector<Bound> bounds{{{"QMOM 2", qmom(2)}, 0.065},   {{"QMOM 3", qmom(3)}, 0.035},
                                  {{"QMOM 4", qmom(4)}, 0.025},   {{"MOMIC 4", momic(4)}, 0.015},
                                  {{"MOMIC 6", momic(6)}, 0.015}, {{"MOMIC 8", momic(8)}, 0.015}};
  for (const auto type :
       {CollisionKernelType::freeMolecular, CollisionKernelType::transition, CollisionKernelType::continuum}) {
    const auto model = coagulating(type);
    SectionalOptions options;
    options.sections = 200;
    options.smallest = volume / 4;
    options.spacing = std::pow(2.0, 0.2);
    const double time = type == CollisionKernelType::continuum ? 1e-4 : 1e-2;
    const auto sections = makeSectional(model, equalStart(number, volume), options);
    sections->advance(time);
    const auto expected = sections->moments();
    double previous = 1;
    for (const auto& [closure, tolerance] : bounds) {
      const auto solver = makeMoments(model, equalStart(number, volume), closure.options);
      solver->advance(time);
      const auto m = solver->moments();
      const double error = std::abs(m[0] / expected[0] - 1);
      EXPECT_LT(error, tolerance) << closure.name;
      EXPECT_LT(std::abs(m[2] / expected[2] - 1), 0.02) << closure.name;
      if (closure.options.method != MomentMethod::qmom) continue;
      EXPECT_LT(error, previous) << closure.name;  // more nodes help
      previous = error;
    }
  }
}

TEST(MomentClosure, NucleiAmongTheirOffspring) {
  // While the distribution has one maximum.
  auto model = coagulating(CollisionKernelType::freeMolecular);
  model.nucleation = steadyNuclei(1e20, volume);
  SectionalOptions options;
  options.sections = 150;
  options.smallest = volume;
  options.spacing = std::pow(2.0, 0.2);
  const auto sections = makeSectional(model, {}, options);
  sections->advance(1e-2);
  for (const auto& [closure, tolerance] :
       {Bound{{"QMOM 2", qmom(2)}, 0.015}, Bound{{"QMOM 4", qmom(4)}, 0.005}, Bound{{"MOMIC 6", momic(6)}, 0.02}}) {
    const auto solver = makeMoments(model, {}, closure.options);
    solver->advance(1e-2);
    EXPECT_NEAR(solver->moments()[0] / sections->moments()[0], 1, tolerance) << closure.name;
    EXPECT_NEAR(solver->moments()[1] / sections->moments()[1], 1, 1e-7) << closure.name;
  }
}

void expectWithin(const PopulationModel& model, const InitialPopulation& initial, double time, std::size_t moment,
                  const std::vector<Bound>& bounds) {
  const auto exact = exactSolution(model, initial);
  ASSERT_TRUE(exact);
  const double expected = exact->moments(time)[moment].value();
  for (const auto& [closure, tolerance] : bounds) {
    const auto solver = makeMoments(model, initial, closure.options);
    solver->advance(time);
    EXPECT_NEAR(solver->moments()[moment] / expected, 1, tolerance) << exact->name() << ", " << closure.name;
  }
}

TEST(MomentClosure, SurfaceGrowthAndOxidation) {
  PopulationModel model;
  model.growth.surfaceGrowth = 0.1;
  expectWithin(model, exponentialStart(), 5, 1,
               {{{"QMOM 2", qmom(2)}, 0.03}, {{"QMOM 4", qmom(4)}, 0.01}, {{"MOMIC 6", momic(6)}, 0.003}});
  model.growth.surfaceGrowth = 0;
  model.growth.oxidation = 0.1;
  model.growth.smallestVolume = 0.01;
  expectWithin(model, logNormalStart(1, 1, 1.2), 2, 1,
               {{{"QMOM 2", qmom(2)}, 0.01}, {{"QMOM 4", qmom(4)}, 0.002}, {{"MOMIC 6", momic(6)}, 1e-4}});
}

TEST(MomentClosure, BreakageAndDepositionThatDependOnTheSize) {
  PopulationModel breaking;
  breaking.breakage = BreakageOptions{.rate = 1, .exponent = 1, .daughters = BreakageOptions::Daughters::uniform};
  // The number follows from the volume alone; the square does not.
  expectWithin(breaking, exponentialStart(), 10, 0, {{{"QMOM 2", qmom(2)}, 1e-6}, {{"QMOM 3", qmom(3)}, 1e-6}});
  expectWithin(breaking, exponentialStart(), 10, 2,
               {{{"QMOM 2", qmom(2)}, 0.2}, {{"QMOM 3", qmom(3)}, 0.1}, {{"QMOM 4", qmom(4)}, 0.06}});
  PopulationModel depositing;
  depositing.deposition = DepositionOptions{.rate = 1, .exponent = -1.0 / 3};
  expectWithin(depositing, logNormalStart(1, 1, 1.3), 2, 0,
               {{{"QMOM 2", qmom(2)}, 0.05}, {{"QMOM 4", qmom(4)}, 0.025}, {{"MOMIC 6", momic(6)}, 1e-5}});
}

TEST(MomentClosure, BothInversionsTakeTheSamePath) {
  auto model = coagulating(CollisionKernelType::transitionFuchs);
  model.nucleation = steadyNuclei(1e20, volume);
  model.growth.surfaceGrowth = 1e-8;
  const auto first = makeMoments(model, {}, qmom(3));
  const auto second = makeMoments(model, {}, qmom(3, QuadratureInversion::productDifference));
  first->advance(1e-2);
  second->advance(1e-2);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(first->moments()[k] / second->moments()[k], 1, 1e-5) << k;
  EXPECT_GT(first->geometricDeviation(), 1.2);
}

}  // namespace
}  // namespace lampblack::test
