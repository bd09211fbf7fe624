#include "particles/ensemble.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/errors.hpp"
#include "particles/ensemble_medium.hpp"
#include "particles/sphere.hpp"

namespace lampblack {
namespace {

constexpr std::uint32_t streamPurpose = 0x534f4f54;  // soot ensembles
constexpr std::size_t savedHeader = 14;
constexpr double savedVersion = 1;

}  // namespace

Ensemble::Ensemble(EnsembleOptions options)
    : options_(std::move(options)),
      dimers_(options_.soot),
      random_(options_.seed, options_.owner, streamPurpose),
      initialVolume_(static_cast<double>(options_.capacity) / options_.expectedNumberDensity),
      sampleVolume_(initialVolume_) {
  if (options_.capacity < 2) throw InputError("soot ensemble: the capacity needs to be at least 2");
  if (!(options_.expectedNumberDensity > 0) || !(options_.splitTolerance > 0)) {
    throw InputError("soot ensemble: expected number density and split tolerance need to be positive");
  }
  masses_.reserve(options_.capacity);
  hydrogen_.reserve(options_.capacity);
  diameters_.reserve(options_.capacity);
}

void Ensemble::initialise(std::span<const double> masses, double hydrogenMassFraction, double numberDensity) {
  if (masses.size() > options_.capacity || masses.empty() || !(numberDensity > 0)) {
    throw InputError(fmt::format("soot ensemble: {} particles at {} 1/m3 do not fit a capacity of {}", masses.size(),
                                 numberDensity, options_.capacity));
  }
  restart();
  for (const double mass : masses) {
    if (!(mass > 0)) throw InputError(fmt::format("soot ensemble: a particle of mass {} kg", mass));
    masses_.push_back(mass);
    hydrogen_.push_back(mass * hydrogenMassFraction);
    diameters_.push_back(sphereDiameter(mass / options_.soot.sootDensity));
  }
  sampleVolume_ = static_cast<double>(masses.size()) / numberDensity;
  filled_ = 2 * masses.size() > options_.capacity;
}

void Ensemble::restart() {
  masses_.clear();
  hydrogen_.clear();
  diameters_.clear();
  sampleVolume_ = initialVolume_;
  filled_ = false;
}

void Ensemble::removeParticle(std::size_t i) {
  masses_[i] = masses_.back();
  hydrogen_[i] = hydrogen_.back();
  diameters_[i] = diameters_.back();
  masses_.pop_back();
  hydrogen_.pop_back();
  diameters_.pop_back();
}

bool Ensemble::depleted(std::size_t particles) const {
  return filled_ && particles > 0 && 2 * particles <= options_.capacity;
}

bool Ensemble::doubleIfDepleted() {
  const std::size_t n = size();
  if (!depleted(n)) return false;
  for (auto* values : {&masses_, &hydrogen_, &diameters_}) {
    values->resize(2 * n);
    std::copy_n(values->begin(), n, values->begin() + static_cast<std::ptrdiff_t>(n));
  }
  sampleVolume_ *= 2;
  ++counters_.doublings;
  return true;
}

CollisionKernelOptions Ensemble::kernelOptions(const SootGasState& gas) const {
  CollisionKernelOptions kernel;
  switch (options_.kernel) {
    case CoagulationKernel::transition:
      kernel.type = CollisionKernelType::transition;
      break;
    case CoagulationKernel::freeMolecular:
      kernel.type = CollisionKernelType::freeMolecular;
      break;
    case CoagulationKernel::constant:
      kernel.type = CollisionKernelType::constant;
      kernel.rate = options_.verificationScale;
      break;
    case CoagulationKernel::additive:
      kernel.type = CollisionKernelType::additive;
      kernel.rate = options_.verificationScale * options_.soot.sootDensity;  // of volumes
      break;
  }
  kernel.gas = gas.kernelGas();
  kernel.enhancement = options_.soot.vanDerWaals;
  return kernel;
}

void Ensemble::advance(const SootGasState& given, double dilutionRate, double dt) {
  if (!(dt > 0)) return;
  if (given.pah.size() != dimers_.size()) throw std::invalid_argument("soot: PAH concentrations and PAH list differ");
  SootGasState gas = given;  // with what transport left negative as zero; PAH by the dimer model itself
  for (const auto species : {&SootGasState::H, &SootGasState::H2, &SootGasState::OH, &SootGasState::H2O,
                             &SootGasState::O2, &SootGasState::C2H2}) {
    gas.*species = std::max(gas.*species, 0.0);
  }
  if (!(gas.temperature > 0) || !(gas.pressure > 0) || !(gas.viscosity > 0) || !(gas.meanMolecularWeight > 0)) {
    throw NumericsError(fmt::format("soot ensemble {}: gas at T = {} K, p = {} Pa, viscosity {} Pa s, W = {} kg/mol",
                                    options_.owner, gas.temperature, gas.pressure, gas.viscosity,
                                    gas.meanMolecularWeight));
  }
  const SootModelOptions& soot = options_.soot;
  PahArray consumption{};
  if (dimers_.consumes()) {
    dimers_.lossRates(gas.temperature, gas.pah, consumption);
    for (std::size_t i = 0; i < dimers_.size(); ++i) consumption[i] *= std::max(gas.pah[i], 0.0);
  }
  Medium medium{gas,
                SurfaceChemistry(soot, gas.temperature),
                dimers_.production(gas.temperature, {consumption.data(), dimers_.size()}),
                0,
                freeMolecularPrefactor(gas.temperature, soot.vanDerWaals),
                0,
                0,
                0,
                0,
                false,
                false,
                CollisionKernel(kernelOptions(gas))};
  if (medium.dimer.rate > 0) {
    medium.selfCollision = soot.inception ? medium.dimer.selfCollision : 0;
    medium.nucleusMass = 2 * medium.dimer.mass;
    medium.nucleusHydrogen = 2 * medium.dimer.hydrogen * soot.hydrogenWeight / constants::avogadro;
    medium.dimerHydrogenFraction = medium.nucleusHydrogen / medium.nucleusMass;
    medium.nucleusDiameter = sphereDiameter(medium.nucleusMass / soot.sootDensity);
    medium.condensing = soot.condensation;
  }
  const SurfaceRates most = medium.surface.rates(gas, 1.0);
  medium.surfaceActive = most.growth * gas.C2H2 > 0 || most.oxidationO2 * gas.O2 > 0 || most.oxidationOH * gas.OH > 0;

  double remaining = dt;
  while (remaining > 0) {
    if (size() == 0 && !(medium.selfCollision > 0)) {
      restart();
      return;
    }
    const double step = splitStep(medium, dilutionRate, remaining);
    const bool last = step >= remaining;
    sampleVolume_ *= std::exp(0.5 * dilutionRate * step);
    grow(medium, 0.5 * step);
    jump(medium, step);
    grow(medium, 0.5 * step);
    sampleVolume_ *= std::exp(0.5 * dilutionRate * step);
    ++counters_.splitSteps;
    remaining = last ? 0 : remaining - step;
  }
}

double Ensemble::massDensity() const {
  double sum = 0;
  for (const double m : masses_) sum += m;
  return sum / sampleVolume_;
}

double Ensemble::hydrogenDensity() const {
  double sum = 0;
  for (const double h : hydrogen_) sum += h;
  return sum / sampleVolume_;
}

double Ensemble::moment(double order) const {
  double sum = 0;
  for (const double m : masses_) sum += std::pow(m / options_.soot.sootDensity, order);
  return sum / sampleVolume_;
}

double Ensemble::meanDiameter() const {
  double sum = 0;
  for (const double d : diameters_) sum += d;
  return size() > 0 ? sum / static_cast<double>(size()) : 0;
}

double Ensemble::geometricStandardDeviation() const {
  if (size() == 0) return 1;
  const double n = static_cast<double>(size());
  double mean = 0, variance = 0;
  for (const double d : diameters_) mean += std::log(d) / n;
  for (const double d : diameters_) variance += (std::log(d) - mean) * (std::log(d) - mean) / n;
  return std::exp(std::sqrt(variance));
}

std::vector<double> Ensemble::sizeDistribution(double logMin, double logMax, std::size_t bins) const {
  std::vector<double> density(bins, 0);
  const double width = (logMax - logMin) / static_cast<double>(bins);
  for (const double d : diameters_) {
    const double x = (std::log10(d) - logMin) / width;
    if (x >= 0 && x < static_cast<double>(bins)) density[static_cast<std::size_t>(x)] += 1 / (sampleVolume_ * width);
  }
  return density;
}

std::vector<double> Ensemble::save() const {
  const auto exact = [](std::uint64_t count) { return static_cast<double>(count); };  // below 2^53
  const std::size_t n = size();
  std::vector<double> state = {savedVersion,
                               exact(options_.capacity),
                               exact(n),
                               sampleVolume_,
                               initialVolume_,
                               filled_ ? 1.0 : 0.0,
                               exact(random_.position()),
                               exact(counters_.coagulations),
                               exact(counters_.fictitious),
                               exact(counters_.inceptions),
                               exact(counters_.doublings),
                               exact(counters_.contractions),
                               exact(counters_.oxidised),
                               exact(counters_.splitSteps)};
  state.reserve(savedHeader + 3 * n);
  // Diameters too: growth integrates them, so that they are not exactly a function of the masses.
  for (const auto* values : {&masses_, &hydrogen_, &diameters_})
    state.insert(state.end(), values->begin(), values->end());
  return state;
}

void Ensemble::restore(std::span<const double> state) {
  const auto count = [&](std::size_t k) { return static_cast<std::uint64_t>(state[k]); };
  if (state.size() < savedHeader || state[0] != savedVersion || count(1) != options_.capacity ||
      count(2) > options_.capacity || state.size() != savedHeader + 3 * count(2)) {
    throw InputError("soot ensemble: the saved state is not of an ensemble of this capacity");
  }
  const auto n = static_cast<std::size_t>(state[2]);
  sampleVolume_ = state[3];
  initialVolume_ = state[4];
  filled_ = state[5] != 0;
  random_.seek(count(6));
  counters_ = {count(7), count(8), count(9), count(10), count(11), count(12), count(13)};
  const auto values = state.subspan(savedHeader);
  masses_.assign(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(n));
  hydrogen_.assign(values.begin() + static_cast<std::ptrdiff_t>(n),
                   values.begin() + static_cast<std::ptrdiff_t>(2 * n));
  diameters_.assign(values.begin() + static_cast<std::ptrdiff_t>(2 * n), values.end());
}

}  // namespace lampblack
