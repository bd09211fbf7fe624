// MOMIC and HMOM against stochastic soot in one gas, with the same chemistry: what closures cost. The particles know no
// approximation but their finite number; they are spheres, as MOMIC's are, while HMOM's are aggregates.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/modules.hpp"
#include "moment_model_fixtures.hpp"
#include "particles/models/moments/hmom.hpp"
#include "particles/models/moments/momic_soot.hpp"

namespace lampblack::particles {
namespace {

using test::FlameGas;
using test::ModelGas;

struct Result {
  double number = 0, volumeFraction = 0;
};

Result resultOf(const SootModel& model, const ModelGas& gas, double time) {
  const std::vector<double> y = gas.integrate(model, std::vector<double>(model.scalars().size(), 0.0), time, 1e-6);
  const ParticleProperties p = model.properties(gas.gas, y);
  return {p.numberDensity, p.volumeFraction};
}

// Inception, condensation, growth, oxidation and coagulation from nothing.
TEST(MomentModels, AgreeWithParticlesWhereThereIsOneMaximum) {
  SootModelOptions soot = test::naphthalene();
  soot.alpha = 0.2;
  const FlameGas flame(1700, 1e-3, 0.03, 2e-4, 0.08, 1e-4, 0.03, {2e-6});
  const ModelGas gas(flame, soot);
  constexpr int repeats = 4;
  const std::vector<double> times{1e-3, 5e-3};
  std::vector<Result> mean(2), square(2);
  for (int r = 0; r < repeats; ++r) {
    EnsembleOptions options;
    options.particles = 1024;
    options.owner = static_cast<std::uint64_t>(r);
    options.soot = soot;
    const auto particles = makeEnsemble(options);
    for (std::size_t t = 0; t < 2; ++t) {
      particles->advance(flame.state, 0, t == 0 ? times[0] : times[1] - times[0]);
      const double n = particles->totals().number, v = particles->volumeFraction();
      mean[t].number += n / repeats;
      mean[t].volumeFraction += v / repeats;
      square[t].number += n * n / repeats;
      square[t].volumeFraction += v * v / repeats;
    }
  }
  const auto deviation = [&](double first, double second) {  // of the mean, relative
    return std::sqrt(std::max(0.0, second / (first * first) - 1) / (repeats - 1));
  };
  for (std::size_t t = 0; t < 2; ++t) {
    const double ofNumber = deviation(mean[t].number, square[t].number);
    const double ofVolume = deviation(mean[t].volumeFraction, square[t].volumeFraction);
    // MOMIC: 1.2 % as in pure coagulation. The t distribution of four samples is wide: 6 deviations.
    const Result momic = resultOf(MomicSoot({soot, 6}), gas, times[t]);
    EXPECT_NEAR(momic.number / mean[t].number, 1, 0.012 + 6 * ofNumber);
    EXPECT_NEAR(momic.volumeFraction / mean[t].volumeFraction, 1, 0.012 + 6 * ofVolume);
    // HMOM: two sizes only, and aggregates with more surface (measured: -3 % in number, +9 % in volume at 5 ms).
    const Result hmom = resultOf(HmomSoot({soot}), gas, times[t]);
    EXPECT_NEAR(hmom.number / mean[t].number, 1, 0.05 + 6 * ofNumber);
    EXPECT_NEAR(hmom.volumeFraction / mean[t].volumeFraction, 1, 0.12 + 6 * ofVolume);
  }
}

}  // namespace
}  // namespace lampblack::particles
