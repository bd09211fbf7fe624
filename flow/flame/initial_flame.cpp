#include "flow/flame/initial_flame.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "core/errors.hpp"
#include "flow/flame/burning_rate.hpp"
#include "flow/flame/flame_continuity.hpp"
#include "flow/flame/mixing_profile.hpp"
#include "flow/flame/stream_mixture.hpp"

namespace lampblack::flow {
namespace {

// Thicknesses of a free flame that its domain has at least, a third of them ahead of it: pressed against an end it
// would be cooled.
constexpr double leastRoom = 30;

// Points that are dense around `centre`, which is one of them, and grow apart in proportion to the distance from it.
std::vector<double> pointsAround(double centre, double width, double length, std::size_t points) {
  const double left = std::asinh(centre / width);
  const double right = std::asinh((length - centre) / width);
  const auto intervals = static_cast<double>(points - 1);
  const double share = std::clamp(std::round(intervals * left / (left + right)), 1.0, intervals - 1);
  std::vector<double> z;
  for (std::size_t i = 0; i < points; ++i) {
    const double step = static_cast<double>(i) - share;
    z.push_back(centre +
                width * (step < 0 ? -std::sinh(-step * left / share) : std::sinh(step * right / (intervals - share))));
  }
  z.front() = 0;
  z.back() = length;
  return z;
}

// Where a given temperature first is half-way to its largest.
double riseOf(const GivenTemperature& given) {
  if (given.T.size() < 2) return given.z.front();
  const double half = 0.5 * (given.T.front() + *std::ranges::max_element(given.T));
  std::size_t above = 1;
  while (above + 1 < given.T.size() && given.T[above] < half) ++above;
  const double step = given.T[above] - given.T[above - 1];
  const double share = step > 0 ? std::clamp((half - given.T[above - 1]) / step, 0.0, 1.0) : 1.0;
  return given.z[above - 1] + share * (given.z[above] - given.z[above - 1]);
}

class Start {
 public:
  Start(const Mechanism& mechanism, const FlameProblem& problem, std::size_t scalars,
        const InitialFlameOptions& options)
      : mechanism_(mechanism), problem_(problem), options_(options), thermo_(mechanism) {
    if (!(problem.length > 0)) throw InputError("flame: the length of the domain has to be positive");
    if (options.points < 5) throw InputError("flame: a first profile needs five points or more");
    profile_.layout = {mechanism.numSpecies(), scalars};
  }

  FlameProfile premixed(double speedFactor = 1);
  FlameProfile wall();
  void placeAtWall(const StreamMixture& mixture, double centre);
  FlameProfile counterflow();

 private:
  [[nodiscard]] StreamMixture ofOneStream() const {
    return options_.cold ? StreamMixture::cold(mechanism_, problem_.left, problem_.left)
                         : StreamMixture::premixed(mechanism_, problem_);
  }
  // Of a free flame of the stream on the left, kg/m2/s.
  [[nodiscard]] double burningFlux(double burnt) {
    if (!burningFlux_) burningFlux_ = burningRate(mechanism_, problem_.left, problem_.pressure, burnt);
    return *burningFlux_;
  }
  void setGrid(double centre, double width, double length) {
    profile_.z = pointsAround(centre, width, length, options_.points);
    profile_.x.assign(profile_.size(), 0.0);
    profile_.global(load) = 1;
  }
  void setGas(std::size_t i, const StreamMixture& mixture, double share) {
    double* Y = &profile_.at(i, FlameLayout::firstSpecies);
    profile_.at(i, FlameLayout::temperature) = mixture.at(share, {Y, profile_.layout.species});
  }
  [[nodiscard]] std::vector<double> densities() const {
    std::vector<double> density;
    for (std::size_t i = 0; i < profile_.points(); ++i)
      density.push_back(thermo_.density(profile_.temperature(i), problem_.pressure, profile_.massFractions(i)));
    return density;
  }

  const Mechanism& mechanism_;
  const FlameProblem& problem_;
  InitialFlameOptions options_;
  Thermo thermo_;
  FlameProfile profile_;
  std::optional<double> burningFlux_;
};

// `speedFactor`: on a guess of the speed of a free flame.
FlameProfile Start::premixed(double speedFactor) {
  const bool free = problem_.type == FlameType::Free;
  const FlameStream& stream = problem_.left;
  if (free && options_.cold) throw InputError("flame: a flame that propagates cannot start cold");
  const StreamMixture mixture = ofOneStream();
  if (!free && !(stream.massFlux > 0)) throw InputError("flame: the mass flux through a burner has to be positive");
  const double natural = options_.cold ? stream.massFlux : speedFactor * burningFlux(mixture.hottest());
  const double flux = stream.massFlux > 0 ? stream.massFlux : natural;
  // Four diffusive thicknesses of the half-burnt gas from 12 to 88 % of the way. On a burner that is slower than the
  // flame the flame comes as close as it is thin.
  double thickness =
      4 * conductivityOverCp(0.5 * (stream.temperature + mixture.hottest())) / (free ? flux : std::max(flux, natural));
  const double length = free ? std::max(problem_.length, leastRoom * thickness) : problem_.length;
  thickness = std::min(thickness, length / 6);
  const double centre = free ? length / 3 : std::min(1.5 * thickness, length / 3);
  setGrid(centre, 0.5 * thickness, length);
  const auto step = [&](double z) { return std::tanh(2 * (z - centre) / thickness); };
  for (std::size_t i = 0; i < profile_.points(); ++i) {
    const double burnt = (step(profile_.z[i]) - step(0)) / (step(length) - step(0));
    setGas(i, mixture, 1 - burnt);
    if (problem_.given) profile_.at(i, FlameLayout::temperature) = problem_.given->at(profile_.z[i]);
  }
  if (!problem_.given) profile_.at(0, FlameLayout::temperature) = stream.temperature;
  setMassFlux(profile_, densities(), flux);
  return profile_;
}

FlameProfile Start::wall() {
  const StreamMixture mixture = ofOneStream();
  const double length = problem_.length;
  if (options_.cold) {
    placeAtWall(mixture, 0.6 * length);
    return profile_;
  }
  if (problem_.given) {
    placeAtWall(mixture, std::clamp(riseOf(*problem_.given), 0.05 * length, 0.8 * length));
    return profile_;
  }
  // Where the stream, slowed down, is as fast as the flame.
  const double burning = burningFlux(mixture.hottest());
  double low = 0.05 * length, high = 0.8 * length;
  for (int halvings = 0; halvings < 6; ++halvings) {
    const double centre = 0.5 * (low + high);
    placeAtWall(mixture, centre);
    std::size_t front = 0;
    while (front + 2 < profile_.points() && profile_.z[front + 1] < centre) ++front;
    (profile_.at(front, FlameLayout::massFlux) > burning ? low : high) = centre;
  }
  return profile_;
}

// A flame around `centre`, and a cold layer at the wall.
void Start::placeAtWall(const StreamMixture& mixture, double centre) {
  const FlameStream& stream = problem_.left;
  const double length = problem_.length;
  const double streamDensity = thermo_.density(stream.temperature, problem_.pressure, stream.Y);
  const bool potential = problem_.nozzles == FlameNozzles::Potential;
  // A plug flow against a wall has u = U (1 - (z/L)^2), V = U z/L^2.
  const double strain = potential ? problem_.strainRate : stream.massFlux / (streamDensity * length);
  if (!(strain > 0)) throw InputError("flame: the stream has to flow towards the wall (mass flux or strain rate)");
  const double warm = 0.5 * (stream.temperature + mixture.hottest());
  const double warmDensity = streamDensity * stream.temperature / warm;
  const double layer = std::min(std::sqrt(conductivityOverCp(warm) / (warmDensity * strain)), length / 6);
  const double thickness = std::min(length / 8, 1.5 * centre);
  setGrid(options_.cold ? length - layer : centre, options_.cold ? layer : thickness, length);
  const auto step = [&](double z) { return std::tanh(2 * (z - centre) / thickness); };
  for (std::size_t i = 0; i < profile_.points(); ++i) {
    const double z = profile_.z[i];
    setGas(i, mixture, 1 - (step(z) - step(0)) / (step(length) - step(0)));
    double& T = profile_.at(i, FlameLayout::temperature);
    T = problem_.wallTemperature +
        (T - problem_.wallTemperature) * std::tanh((length - z) / layer) / std::tanh(length / layer);
    if (problem_.given) T = problem_.given->at(z);
  }
  if (!problem_.given) profile_.at(0, FlameLayout::temperature) = stream.temperature;
  const auto density = densities();
  for (std::size_t i = 0; i < profile_.points(); ++i) {
    const double z = profile_.z[i];
    profile_.at(i, FlameLayout::spread) =
        strain * (potential ? 1 : z / length) * std::sqrt(streamDensity / density[i]) * std::tanh((length - z) / layer);
  }
  profile_.global(pressureGradient) = -streamDensity * strain * strain;
  if (potential) {
    setMassFlux(profile_, density, 0);
    setMassFlux(profile_, density, -profile_.at(profile_.points() - 1, FlameLayout::massFlux));
    profile_.at(profile_.points() - 1, FlameLayout::massFlux) = 0;
  } else {
    scaleSpreading(profile_, density, stream.massFlux, 0);
  }
}

FlameProfile Start::counterflow() {
  const FlameStream& left = problem_.left;
  const FlameStream& right = *problem_.right;
  const bool potential = problem_.nozzles == FlameNozzles::Potential;
  if (potential && !(problem_.strainRate > 0)) throw InputError("flame: the strain rate has to be positive");
  if (potential && !(problem_.stagnationPlane > 0 && problem_.stagnationPlane < problem_.length))
    throw InputError("flame: the stagnation plane has to be inside the domain");
  if (!potential && !(left.massFlux > 0 && right.massFlux > 0))
    throw InputError("flame: both streams of a counterflow have to flow into the domain");
  const auto mixture = options_.cold ? StreamMixture::cold(mechanism_, left, right)
                                     : StreamMixture::counterflow(mechanism_, left, right, problem_.pressure);

  // Temperature and density by share, tabulated: both are asked for often.
  constexpr std::size_t entries = 400;
  std::vector<double> temperature, density;
  std::vector<double> Y(mechanism_.numSpecies());
  for (std::size_t i = 0; i <= entries; ++i) {
    temperature.push_back(mixture.at(static_cast<double>(i) / entries, Y));
    density.push_back(thermo_.density(temperature.back(), problem_.pressure, Y));
  }
  const auto look = [](const std::vector<double>& table, double share) {
    const double place = std::clamp(share, 0.0, 1.0) * entries;
    const auto i = std::min(static_cast<std::size_t>(place), entries - 1);
    return table[i] + (place - static_cast<double>(i)) * (table[i + 1] - table[i]);
  };
  OpposedStreams streams{
      problem_.length, left.massFlux, right.massFlux, potential, problem_.strainRate, problem_.stagnationPlane, {}, {}};
  streams.density = [&](double share) { return look(density, share); };
  streams.conductivityOverCp = [&](double share) { return conductivityOverCp(look(temperature, share)); };
  const MixingProfile mixing = mixOpposedStreams(streams);

  // Where it is hottest (mixed half and half, if cold), and the width of the layer by its steepest place.
  const double wanted = options_.cold ? 0.5 : std::clamp(mixture.hottestShare(), 0.01, 0.99);
  double steepest = 0, centre = 0.5 * problem_.length;
  for (std::size_t i = 0; i + 1 < mixing.z.size(); ++i) {
    steepest = std::max(steepest, (mixing.share[i] - mixing.share[i + 1]) / (mixing.z[i + 1] - mixing.z[i]));
    if (mixing.share[i] >= wanted && mixing.share[i + 1] < wanted) centre = 0.5 * (mixing.z[i] + mixing.z[i + 1]);
  }
  setGrid(std::clamp(centre, 0.02 * problem_.length, 0.98 * problem_.length), 0.5 / steepest, problem_.length);
  for (std::size_t i = 0; i < profile_.points(); ++i) {
    setGas(i, mixture, mixing.shareAt(profile_.z[i]));
    profile_.at(i, FlameLayout::spread) = mixing.spreadAt(profile_.z[i]);
  }
  profile_.at(0, FlameLayout::temperature) = left.temperature;
  profile_.at(profile_.points() - 1, FlameLayout::temperature) = right.temperature;
  profile_.global(pressureGradient) = mixing.lambda;
  if (potential) {
    setMassFlux(profile_, densities(), mixing.leftFlux);
  } else {
    scaleSpreading(profile_, densities(), left.massFlux, -right.massFlux);
  }
  return profile_;
}

}  // namespace

FlameProfile initialFlame(const Mechanism& mechanism, const FlameProblem& problem, std::size_t scalars,
                          const InitialFlameOptions& options) {
  if (problem.type == FlameType::Counterflow && !problem.right)
    throw InputError("flame: a counterflow needs a stream at the right end");
  InitialFlameOptions possible = options;
  if (problem.type != FlameType::Free && !inertReason(mechanism, problem).empty()) possible.cold = true;
  Start start(mechanism, problem, scalars, possible);
  switch (problem.type) {
    case FlameType::Wall:
      return start.wall();
    case FlameType::Counterflow:
      return start.counterflow();
    default:
      return start.premixed();
  }
}

std::vector<FlameProfile> initialFlames(const Mechanism& mechanism, const FlameProblem& problem, std::size_t scalars,
                                        const InitialFlameOptions& options) {
  std::vector<FlameProfile> starts;
  if (problem.type != FlameType::Free || problem.left.massFlux > 0) {
    starts.push_back(initialFlame(mechanism, problem, scalars, options));
    return starts;
  }
  Start start(mechanism, problem, scalars, options);
  for (const double factor : {1.0, 4.0, 0.25, 16.0, 1.0 / 16}) starts.push_back(start.premixed(factor));
  return starts;
}

}  // namespace lampblack::flow
