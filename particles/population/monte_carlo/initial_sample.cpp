#include "particles/population/monte_carlo/initial_sample.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/errors.hpp"
#include "numerics/dense_lu.hpp"
#include "particles/population/exact_solutions/initial_distribution.hpp"

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

// Where the integral of x^order exp(-x) reaches a part of its whole.
double gammaQuantile(int order, double probability) {
  if (order == 0) return -std::log1p(-probability);
  double low = 0, high = 60 + order;  // beyond, nothing is left of a probability in double precision
  while (high - low > 1e-15 * high) {
    const double x = 0.5 * (low + high);
    double term = std::exp(-x), above = term;
    for (int j = 1; j <= order; ++j) above += term *= x / j;
    if (x == low || x == high) break;
    (above > 1 - probability ? low : high) = x;
  }
  return 0.5 * (low + high);
}

// The rows of a table have a share of a moment each; where they together reach a part of it.
double tableQuantile(const InitialPopulation& table, int order, double probability) {
  double wanted = probability * initialMoment(table, order);
  for (const SizeInterval& interval : table.intervals) {
    const double held = intervalMoment(interval, order);
    if (wanted >= held && &interval != &table.intervals.back()) {
      wanted -= held;
      continue;
    }
    const double part = std::clamp(wanted / held, 0.0, 1.0), span = std::log(interval.to / interval.from);
    return interval.from *
           (order == 0 ? std::exp(part * span) : std::pow(1 + part * std::expm1(order * span), 1.0 / order));
  }
  return table.volume;
}

// The volume below which a part of a moment of one mode lies; the number is the moment of order 0.
double quantile(const InitialPopulation& mode, int order, double probability) {
  switch (mode.distribution) {
    case InitialPopulation::Distribution::exponential:
      return mode.volume * gammaQuantile(order, probability);
    case InitialPopulation::Distribution::table:
      return tableQuantile(mode, order, probability);
    case InitialPopulation::Distribution::lognormal: {
      const double sigma = logDeviation(mode);
      return mode.volume * std::exp(sigma * (order * sigma + normalQuantile(probability)));
    }
    default:
      return mode.volume;
  }
}

bool isEqual(const InitialPopulation& mode) {
  return mode.distribution == InitialPopulation::Distribution::monodisperse;
}

// The end of the largest part that a random number from 0 to 1 may ask for: there the quantile is infinite.
constexpr double largestProbability = 1 - 0x1.0p-53;

// Parts of a whole side by side, with a length each.
class Parts {
 public:
  explicit Parts(const std::vector<double>& lengths) {
    for (const double length : lengths) ends_.push_back((ends_.empty() ? 0 : ends_.back()) + length);
  }
  struct Place {
    std::size_t part;
    double within;  // 0 to 1
  };
  // At a share of the whole.
  [[nodiscard]] Place at(double share) const {
    const double place = share * ends_.back();
    const auto found = std::min(std::upper_bound(ends_.begin(), ends_.end(), place), ends_.end() - 1);
    const double begin = found == ends_.begin() ? 0 : *(found - 1);
    return {static_cast<std::size_t>(found - ends_.begin()),
            std::clamp((place - begin) / (*found - begin), 0.0, largestProbability)};
  }

 private:
  std::vector<double> ends_;
};

constexpr std::size_t orders = 4;  // M_0 to M_3
using Moments = std::array<double, orders>;

// The shares of v^k / M_k in their sum over k, and the sum.
struct Shares {
  Moments part{};
  double sum = 0;
  Shares(double volume, const Moments& moments) {
    double power = 1;
    for (std::size_t k = 0; k < orders; ++k, power *= volume) sum += part[k] = power / moments[k];
    for (double& one : part) one /= sum;
  }
};

Moments momentsOf(std::span<const InitialParticle> particles) {
  Moments sums{};
  for (const auto& [volume, weight] : particles) {
    double term = weight;
    for (double& sum : sums) {
      sum += term;
      term *= volume;
    }
  }
  return sums;
}

// Changes the weights by factors near one so that the particles hold given moments: 1 + sum over k of c_k times the
// share k of a particle, which lies between 0 and 1 (calibration of survey weights; Deville and Särndal 1992). Where
// the shares are nearly the same for all particles, as in a narrow distribution, a ridge keeps the c_k small; number
// and volume are then made exact by one factor on all weights and one on all volumes.
void calibrate(std::span<InitialParticle> particles, const Moments& all, const Moments& target) {
  constexpr double ridge = 1e-4;
  numerics::DenseLu matrix(orders);
  const Moments held = momentsOf(particles);
  Moments factors{};
  for (std::size_t k = 0; k < orders; ++k) {
    factors[k] = (target[k] - held[k]) / all[k];
    matrix.column(k)[k] = ridge;
  }
  for (const auto& [volume, weight] : particles) {
    const Shares shares(volume, all);
    for (std::size_t j = 0; j < orders; ++j)
      for (std::size_t k = 0; k < orders; ++k)
        matrix.column(j)[k] += weight * shares.sum * shares.part[j] * shares.part[k];
  }
  if (!matrix.factorise()) return;
  matrix.solve(factors.data());
  for (auto& [volume, weight] : particles) {
    const Shares shares(volume, all);
    double factor = 1;
    for (std::size_t k = 0; k < orders; ++k) factor += factors[k] * shares.part[k];
    weight *= std::max(factor, 0.5);
  }
  const Moments now = momentsOf(particles);
  const double number = target[0] / now[0], size = target[1] / (now[1] * number);
  for (auto& [volume, weight] : particles) {
    weight *= number;
    volume *= size;
  }
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

std::vector<InitialMember> initialMembers(const InitialPopulation& initial, std::size_t count, RandomStream& random) {
  if (initial.distribution == InitialPopulation::Distribution::none || initial.number == 0) return {};
  std::vector<InitialMember> members(count, {initial.volume, 0});
  if (isEqual(initial)) return members;
  const auto modes = modesOf(initial);
  std::vector<double> numbers;
  for (const InitialPopulation& mode : modes) numbers.push_back(mode.number);
  const Parts parts(numbers);
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k) {
    // Rounding must not take the last one to 1.
    const double probability =
        std::min((static_cast<double>(k) + random.uniform()) / static_cast<double>(count), largestProbability);
    const Parts::Place place = modes.size() == 1 ? Parts::Place{0, probability} : parts.at(probability);
    members[k] = {quantile(modes[place.part], 0, place.within), place.part};
    sum += members[k].volume;
  }
  if (std::ranges::all_of(modes, isEqual)) return members;  // there are no particles but of these volumes
  const double factor = meanInitialVolume(initial) * static_cast<double>(count) / sum;
  for (InitialMember& member : members) member.volume *= factor;
  return members;
}

std::vector<double> initialVolumes(const InitialPopulation& initial, std::size_t count, RandomStream& random) {
  std::vector<double> volumes;
  for (const InitialMember& member : initialMembers(initial, count, random)) volumes.push_back(member.volume);
  if (modesOf(initial).size() > 1) std::ranges::sort(volumes);
  return volumes;
}

std::vector<InitialParticle> initialParticles(const InitialPopulation& initial, std::size_t count,
                                              InitialWeights weights, RandomStream& random) {
  std::vector<InitialParticle> particles;
  if (weights == InitialWeights::equal || isEqual(initial) || !(initial.number > 0)) {
    for (const double v : initialVolumes(initial, count, random))
      particles.push_back({v, initial.number / static_cast<double>(count)});
    return particles;
  }
  const auto modes = modesOf(initial);
  Moments all{};
  for (std::size_t k = 0; k < orders; ++k) all[k] = initialMoment(initial, static_cast<double>(k));
  // Of each mode and moment its share in the moments of all.
  std::vector<double> lengths;
  for (const InitialPopulation& mode : modes)
    for (std::size_t k = 0; k < orders; ++k) lengths.push_back(initialMoment(mode, static_cast<double>(k)) / all[k]);
  const Parts parts(lengths);
  std::vector<std::vector<InitialParticle>> members(modes.size());
  for (std::size_t i = 0; i < count; ++i) {
    const double probability =
        std::min((static_cast<double>(i) + random.uniform()) / static_cast<double>(count), largestProbability);
    const Parts::Place place = parts.at(probability);
    const std::size_t mode = place.part / orders;
    const double v = quantile(modes[mode], static_cast<int>(place.part % orders), place.within);
    members[mode].push_back({v, orders / (Shares(v, all).sum * static_cast<double>(count))});
  }
  // Equal particles have their mode's number, the others together what is left of all moments.
  Moments target = all;
  std::vector<InitialParticle> others;
  for (std::size_t mode = 0; mode < modes.size(); ++mode) {
    if (!isEqual(modes[mode])) {
      others.insert(others.end(), members[mode].begin(), members[mode].end());
      continue;
    }
    for (const InitialParticle& particle : members[mode])
      particles.push_back({particle.volume, modes[mode].number / static_cast<double>(members[mode].size())});
  }
  if (!others.empty()) {
    const Moments equal = momentsOf(particles);
    for (std::size_t k = 0; k < orders; ++k) target[k] -= equal[k];
    calibrate(others, all, target);
    particles.insert(particles.end(), others.begin(), others.end());
  }
  std::ranges::sort(particles, {}, &InitialParticle::volume);
  return particles;
}

double meanInitialVolume(const InitialPopulation& initial) {
  return initial.number > 0 ? initialMoment(initial, 1) / initial.number : 0;
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
