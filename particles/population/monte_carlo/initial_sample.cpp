#include "particles/population/monte_carlo/initial_sample.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/errors.hpp"

namespace lampblack::particles {
namespace {

// sum of c[k] x^k
double polynomial(const std::array<double, 8>& c, double x) {
  double sum = 0;
  for (std::size_t k = c.size(); k-- > 0;) sum = sum * x + c[k];
  return sum;
}

double logDeviation(const InitialPopulation& initial) {
  return 3 * std::log(initial.geometricDeviation);
}

double quantile(const InitialPopulation& initial, double probability) {
  if (initial.distribution == InitialPopulation::Distribution::exponential) {
    return -initial.volume * std::log1p(-probability);
  }
  return initial.volume * std::exp(logDeviation(initial) * normalQuantile(probability));
}

}  // namespace

double normalQuantile(double probability) {
  static constexpr std::array<double, 8> a{3.3871328727963666080e0, 1.3314166789178437745e2, 1.9715909503065514427e3,
                                           1.3731693765509461125e4, 4.5921953931549871457e4, 6.7265770927008700853e4,
                                           3.3430575583588128105e4, 2.5090809287301226727e3};
  static constexpr std::array<double, 8> b{1.0,
                                           4.2313330701600911252e1,
                                           6.8718700749205790830e2,
                                           5.3941960214247511077e3,
                                           2.1213794301586595867e4,
                                           3.9307895800092710610e4,
                                           2.8729085735721942674e4,
                                           5.2264952788528545610e3};
  static constexpr std::array<double, 8> c{
      1.42343711074968357734e0, 4.63033784615654529590e0,  5.76949722146069140550e0,  3.64784832476320460504e0,
      1.27045825245236838258e0, 2.41780725177450611770e-1, 2.27238449892691845833e-2, 7.74545014278341407640e-4};
  static constexpr std::array<double, 8> d{1.0,
                                           2.05319162663775882187e0,
                                           1.67638483018380384940e0,
                                           6.89767334985100004550e-1,
                                           1.48103976427480074590e-1,
                                           1.51986665636164571966e-2,
                                           5.47593808499534494600e-4,
                                           1.05075007164441684324e-9};
  static constexpr std::array<double, 8> e{
      6.65790464350110377720e0,  5.46378491116411436990e0,  1.78482653991729133580e0,  2.96560571828504891230e-1,
      2.65321895265761230930e-2, 1.24266094738807843860e-3, 2.71155556874348757815e-5, 2.01033439929228813265e-7};
  static constexpr std::array<double, 8> f{1.0,
                                           5.99832206555887937690e-1,
                                           1.36929880922735805310e-1,
                                           1.48753612908506148525e-2,
                                           7.86869131145613259100e-4,
                                           1.84631831751005468180e-5,
                                           1.42151175831644588870e-7,
                                           2.04426310338993978564e-15};
  const double q = probability - 0.5;
  if (std::abs(q) <= 0.425) {
    const double r = 0.180625 - q * q;
    return q * polynomial(a, r) / polynomial(b, r);
  }
  const double r = std::sqrt(-std::log(std::min(probability, 1 - probability)));
  const double tail =
      r <= 5 ? polynomial(c, r - 1.6) / polynomial(d, r - 1.6) : polynomial(e, r - 5) / polynomial(f, r - 5);
  return q < 0 ? -tail : tail;
}

double meanInitialVolume(const InitialPopulation& initial) {
  switch (initial.distribution) {
    case InitialPopulation::Distribution::none:
      return 0;
    case InitialPopulation::Distribution::monodisperse:
    case InitialPopulation::Distribution::exponential:
      return initial.volume;
    case InitialPopulation::Distribution::lognormal:
      break;
  }
  const double sigma = logDeviation(initial);
  return initial.volume * std::exp(0.5 * sigma * sigma);
}

std::vector<double> initialVolumes(const InitialPopulation& initial, std::size_t count, RandomStream& random) {
  if (initial.distribution == InitialPopulation::Distribution::none || initial.number == 0) return {};
  std::vector<double> volumes(count, initial.volume);
  if (initial.distribution == InitialPopulation::Distribution::monodisperse) return volumes;
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k) {
    // Rounding must not take the last one to 1, where the quantile is infinite.
    const double probability =
        std::min((static_cast<double>(k) + random.uniform()) / static_cast<double>(count), 1 - 0x1.0p-53);
    volumes[k] = quantile(initial, probability);
    sum += volumes[k];
  }
  const double factor = meanInitialVolume(initial) * static_cast<double>(count) / sum;
  for (double& v : volumes) v *= factor;
  return volumes;
}

double initialWeight(const InitialPopulation& initial, const MonteCarloOptions& options) {
  if (options.particles < 2) throw InputError("a Monte Carlo method needs at least two particles");
  const bool empty = initial.distribution == InitialPopulation::Distribution::none || initial.number == 0;
  const double number = empty ? options.expectedNumber : initial.number;
  if (!(number > 0)) {
    throw InputError("an ensemble that starts empty needs the number density at which it is full (expected number)");
  }
  return number / static_cast<double>(options.particles);
}

}  // namespace lampblack::particles
