// Gas and particles of a reactor by splitting and by predictor and corrector against both in the same equations:
// orders, and steps much longer than the life of the species that particles take. Without chance: the particles are the
// toy's, whose growth in a gas that does not change is exact.
#include <gtest/gtest.h>

#include <cmath>

#include "chemistry/reactor/closed_reactor.hpp"
#include "core/errors.hpp"
#include "coupling/split_gas.hpp"
#include "tests/chemistry/measured.hpp"
#include "tests/coupling/toy_particles.hpp"
#include "tests/every_module.hpp"

namespace lampblack::coupling {
namespace {

using test::ethylene;
using test::Toy;

constexpr double couplingEnd = 2e-4, couplingTolerance = 1e-11;  // s

class CoupledToy {
 public:
  // `rate` (1/s): of the toy, at an infinite temperature; at 1900 K acetylene is taken at 3.7e-4 of it.
  explicit CoupledToy(double rate) : toy_(ethylene(), rate, 15000, 50) {
    test::ToyPhase phase(toy_);
    ClosedReactor whole(ethylene(), gas_, ReactorSystem::Held::Pressure, std::nullopt, &phase);
    const auto y = test::integrated(whole, whole.initialState(), couplingEnd, couplingTolerance);
    exact_ = y[ethylene().numSpecies() + 1] * test::ToyPhase::unit;
  }
  // Relative error of the carbon in particles after `count` equal steps; infinite where they cannot go on.
  [[nodiscard]] double error(bool predicted, std::size_t count) const {
    ParticlesAtRest atRest;
    ExchangeInGas inGas(ethylene(), SplitParticles::sootElements(), {toy_.acetylene});
    ClosedReactor reactor(ethylene(), gas_, ReactorSystem::Held::Pressure, std::nullopt,
                          predicted ? static_cast<CarriedPhase*>(&inGas) : &atRest);
    SplitReactor::Gas own = splitGas(reactor, ReactorSystem::Held::Pressure);
    own.expected = predicted ? &inGas : nullptr;
    SplitReactor::Options options;
    options.integrator = {couplingTolerance, 1e-6 * couplingTolerance, 0, 1000000};
    options.fixedStep = true;
    options.largestStep = couplingEnd / static_cast<double>(count);
    test::ToySplit particles(toy_);
    particles.knowsItsRate = true;
    SplitReactor split(ethylene(), own, particles, options);
    split.start(0, reactor.initialState());
    try {
      split.advance(couplingEnd);
    } catch (const NumericsError&) {
      return HUGE_VAL;
    }
    return std::abs(split.state()[ethylene().numSpecies() + 1] / exact_ - 1);
  }

 private:
  Toy toy_;
  GasState gas_ = test::gasOf(ethylene(), 1900, "C2H2: 0.02, A1: 0.03, H2: 0.02, N2: 0.93");
  double exact_ = 0;
};

TEST(ReactorCoupling, BothAreOfSecondOrder) {
  const CoupledToy toy(4e6);
  for (const bool predicted : {false, true}) {
    double last = 0;
    for (const std::size_t count : {32, 64, 128}) {
      const double error = toy.error(predicted, count);
      test::measured(predicted ? "predicted" : "split", error);
      if (last > 0) {
        EXPECT_NEAR(std::log2(last / error), 2, 0.25) << count;
      }
      last = error;
    }
  }
}

// Acetylene lives for 0.67 or 0.067 us, steps are 12.5 and 3.1 us.
TEST(ReactorCoupling, PredictionStandsStepsLongerThanASpeciesLives) {
  for (const double rate : {4e9, 4e10}) {
    const CoupledToy toy(rate);
    for (const std::size_t count : {16, 64}) {
      const double predicted = toy.error(true, count), split = toy.error(false, count);
      test::measured("predicted", predicted);
      test::measured("split", split);
      EXPECT_LT(predicted, 0.1 * split) << rate << ", " << count << " steps";
    }
    EXPECT_LT(toy.error(true, 64), 2e-3) << rate;
  }
}

}  // namespace
}  // namespace lampblack::coupling
