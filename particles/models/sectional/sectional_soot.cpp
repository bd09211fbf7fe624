#include "particles/models/sectional/sectional_soot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "particles/models/sectional/sectional_soot_impl.hpp"

namespace lampblack::particles {
namespace {

std::vector<double> makePivots(const SectionalSootOptions& options) {
  if (options.sections < 2 || options.sections > 400) {
    throw InputError(fmt::format("soot: {} sections, from 2 to 400 are possible", options.sections));
  }
  if (!(options.factor > 1)) throw InputError("soot: the masses of neighbouring sections need a ratio above 1");
  const double nucleus = options.nucleusCarbon > 0 ? options.nucleusCarbon : SectionPah::smallestNucleus(options);
  const double first = nucleus * options.soot.carbonWeight / constants::avogadro;
  std::vector<double> pivots;
  for (std::size_t i = 0; i < options.sections; ++i)
    pivots.push_back(first * std::pow(options.factor, static_cast<double>(i)));
  return pivots;
}

// Typical numbers per kg of gas: a hundredth of a percent of soot carbon in a section, but no more than 1e17
// aggregates.
double typicalNumber(double pivot) {
  return std::min(1e17, 1e-4 / pivot);
}

std::vector<double> emptyNumbers(std::span<const double> pivots) {
  std::vector<double> numbers;
  for (const double m : pivots) numbers.push_back(1e-10 * typicalNumber(m) * 0.2);  // in gas of 0.2 kg/m3
  return numbers;
}

std::size_t meltingSections(std::span<const double> pivots, const SectionalSootOptions& options) {
  const double d = options.coalescenceDiameter;
  const double mass = constants::pi / 6 * options.soot.sootDensity * d * d * d;
  return static_cast<std::size_t>(std::lower_bound(pivots.begin(), pivots.end(), mass) - pivots.begin());
}

void check(const SectionalSootOptions& options) {
  const auto require = [](bool fine, const char* message) {
    if (!fine) throw InputError(message);
  };
  require(options.kernel == CollisionKernelType::transition || options.kernel == CollisionKernelType::freeMolecular,
          "soot: sections coagulate by the transition or the free-molecular kernel");
  require(options.soot.sootDensity > 0, "soot: the density of soot has to be above zero");
  require(options.nucleationFactor >= 0 && options.condensationEfficiency >= 0 && options.coalescenceDiameter >= 0 &&
              options.nucleusCarbon >= 0 && options.fragmentation.factor >= 0 && options.carbonisationRate >= 0,
          "soot: factors, rates and sizes of the sections may not be negative");
  require(options.fragmentation.fractalDimension > 0, "soot: the fractal dimension has to be above zero");
  require(!(options.fragmentation.active && options.aggregation == SectionalSootOptions::Aggregation::spheres),
          "soot: spheres cannot break up; fragmentation needs aggregates");
}

}  // namespace

SectionalSoot::Impl::Impl(const SectionalSootOptions& wanted)
    : options(wanted),
      pivots(makePivots(wanted)),
      carbonMass(wanted.soot.carbonWeight / constants::avogadro),
      spheres(wanted.aggregation == SectionalSootOptions::Aggregation::spheres),
      withHydrogen(wanted.carbonisation),
      sections(wanted.sections),
      pahs(wanted.soot.pah.size()),
      species(sootSpecies(wanted.soot)),
      numberScale(emptyNumbers(pivots)),
      shapes(pivots, wanted.soot.sootDensity, numberScale, spheres),
      pairs(pivots, wanted.factor, meltingSections(pivots, wanted)),
      pah(wanted, pivots) {
  check(options);
  constexpr double usualPrimary = 7.7e-21;  // kg, 20 nm
  for (std::size_t i = 0; i < sections; ++i) {
    scalars.push_back({fmt::format("section_{:02}_aggregates", i + 1),
                       "1/m^3",
                       fmt::format("soot aggregates of {:.4g} nm (sphere of equal volume)", 1e9 * shapes.sphere[i]),
                       typicalNumber(pivots[i]),
                       {{"C", pivots[i]}}});
  }
  for (std::size_t i = 0; i < sections && !spheres; ++i) {
    scalars.push_back({fmt::format("section_{:02}_primaries", i + 1), "1/m^3",
                       fmt::format("primary particles of the aggregates of section {}", i + 1),
                       typicalNumber(pivots[i]) * std::max(1.0, pivots[i] / usualPrimary)});
  }
  if (withHydrogen) scalars.push_back({"hydrogen", "kg/m^3", "hydrogen of soot", 1e-5, {{"H", 1}}});

  // Half an aggregate lies `below` pivots lower or up to one higher than that.
  auto below = static_cast<std::size_t>(std::ceil(std::log(2.0) / std::log(options.factor) - 1e-9));
  below = std::max<std::size_t>(below, 1);
  const double low = std::pow(options.factor, -static_cast<double>(below)), high = low * options.factor;
  halves.below = below;
  halves.number[0] = (high - 0.5) / (high - low);
  halves.number[1] = 1 - halves.number[0];
  halves.primaries[0] = halves.number[0] * low / 0.5;
  halves.primaries[1] = halves.number[1] * high / 0.5;

  state.aggregates.assign(sections, 0);
  state.primaries.assign(spheres ? 0 : sections, 0);
  state.breaking = state.aggregates;
  const bool limited = options.growthScheme == SectionalSootOptions::GrowthScheme::limited;
  state.up = SectionFlux(pivots, true, limited);
  state.down = SectionFlux(pivots, false, limited);
  state.uptake = spareUptake = pah.makeUptake();
  fullRow.assign(scalars.size() + species.size(), 0);
  perSection.fill(state.aggregates);
}

SectionalSoot::Impl::Surface SectionalSoot::Impl::surface(const SurfaceChemistry& chemistry, const SootSpeciesArray& c,
                                                          double alpha) {
  const SurfaceRates rates = chemistry.rates(c, alpha);
  return {rates.growth * c[C2H2], rates.oxidationO2 * c[O2], rates.oxidationOH * c[OH]};
}

double SectionalSoot::Impl::meanSize(double carbon, double number) const {
  const double atoms = (carbon + numberScale[0] * pivots[0]) / ((number + numberScale[0]) * carbonMass);
  return std::max(atoms, 2.0);
}

double SectionalSoot::Impl::sizeNumber() const {
  if (options.activeSites == SectionalSootOptions::ActiveSites::aggregate) return state.number;
  double number = 0;
  for (std::size_t i = 0; i < sections; ++i) number += state.aggregates[i] * shapes.primariesEach[i];
  return number;
}

SectionPairs::Gas SectionalSoot::Impl::collisionGas(const ParticleGas& gas) const {
  return {freeMolecularPrefactor(gas.temperature, options.soot.vanDerWaals),
          continuumPrefactor(gas.temperature, gas.viscosity), options.kernel == CollisionKernelType::transition};
}

void SectionalSoot::Impl::prepareSections(std::span<const double> densities) {
  State& s = state;
  s.number = s.carbon = 0;
  for (std::size_t i = 0; i < sections; ++i) {
    s.aggregates[i] = std::max(densities[i], 0.0);
    s.number += s.aggregates[i];
    s.carbon += s.aggregates[i] * pivots[i];
  }
  for (std::size_t i = 0; i < s.primaries.size(); ++i) s.primaries[i] = std::max(densities[sections + i], 0.0);
  s.hydrogen = withHydrogen ? std::max(densities[hydrogenScalar()], 0.0) : 0;
  shapes.update(s.aggregates, s.primaries);
}

void SectionalSoot::Impl::prepare(const ParticleGas& gas, std::span<const double> densities) {
  requirePhysical(gas, "soot sections");
  State& s = state;
  prepareSections(densities);
  s.temperature = gas.temperature;
  for (std::size_t k = 0; k < species.size(); ++k) s.gas[k] = std::max(gas.concentrations[k], 0.0);
  shapes.updateGas(2 * meanFreePath(gas));

  const SurfaceChemistry chemistry(options.soot, gas.temperature);
  s.size = meanSize(s.carbon, sizeNumber());
  s.alpha = chemistry.alpha(s.size);
  s.surface = surface(chemistry, s.gas, s.alpha);
  pah.evaluate(gas.temperature, {&s.gas[fixed], pahs}, shapes, s.aggregates, s.uptake);

  const double weight = options.soot.carbonWeight;
  const double growing = 2 * weight * s.surface.growth;                                   // kg/m2/s
  const double oxidising = weight * (2 * s.surface.oxidationO2 + s.surface.oxidationOH);  // kg/m2/s
  double growingArea = 0, area = 0;
  s.condensed = 0;
  for (std::size_t i = 0; i < sections; ++i) {
    const bool last = i + 1 == sections;
    s.up.perAggregate[i] = last ? 0 : growing * shapes.area[i] + s.uptake.condensation[i];
    s.down.perAggregate[i] = oxidising * shapes.area[i];
    s.breaking[i] = i < halves.below ? 0 : oxidising * options.fragmentation.perOxidation(shapes.primariesEach[i])[0];
    const double here = shapes.area[i] * s.aggregates[i];
    area += here;
    if (!last) growingArea += here;
    s.condensed += s.uptake.condensation[i] * s.aggregates[i];
  }
  s.up.update(s.aggregates);
  s.down.update(s.aggregates);
  s.growth = s.surface.growth * growingArea;
  s.byO2 = s.surface.oxidationO2 * area;
  s.byOH = s.surface.oxidationOH * area;
  s.dehydrogenation = withHydrogen ? options.carbonisationRate * std::exp(-options.carbonisationEnergy /
                                                                          (constants::gasConstant * gas.temperature))
                                   : 0;
}

void SectionalSoot::Impl::sources(std::span<double> rates, std::span<double> exchange) {
  const State& s = state;
  std::fill(rates.begin(), rates.end(), 0);
  std::fill(exchange.begin(), exchange.end(), 0);
  const auto fN = rates.subspan(0, sections), fP = rates.subspan(sections, s.primaries.size());
  if (options.soot.coagulation) pairs.addRates(s.aggregates, s.primaries, fN, fP);
  const auto move = [&](std::span<const double> y, std::span<double> f, bool primaries) {
    for (std::size_t i = 0; i < sections; ++i) {
      const double up = s.up.frequency[i] * y[i], down = s.down.frequency[i] * y[i];
      f[i] -= up + down;
      if (i + 1 < sections) f[i + 1] += up;
      if (i > 0) f[i - 1] += down;
      if (s.breaking[i] == 0) continue;
      const double broken = s.breaking[i] * y[i], pieces = primaries ? broken : 2 * broken;
      const double* share = primaries ? halves.primaries : halves.number;
      f[i] -= broken;
      f[i - halves.below] += share[0] * pieces;
      f[i - halves.below + 1] += share[1] * pieces;
    }
    for (std::size_t k = 0; k < s.uptake.kinds; ++k) {
      const auto& nuclei = s.uptake.nuclei[k];
      f[nuclei.lower] += nuclei.share * nuclei.rate;
      f[nuclei.lower + 1] += (1 - nuclei.share) * nuclei.rate;
    }
  };
  move(s.aggregates, fN, false);
  if (!spheres) move(s.primaries, fP, true);

  double hydrogen = 0;  // mol/m3/s that PAH bring
  for (std::size_t k = 0; k < pahs; ++k) {
    exchange[fixed + k] = -s.uptake.consumption[k];
    hydrogen += options.soot.pah[k].hydrogen * s.uptake.consumption[k];
  }
  double released = hydrogen;
  if (withHydrogen) {
    const double weight = options.soot.hydrogenWeight, oxidised = options.soot.carbonWeight * (2 * s.byO2 + s.byOH);
    const double share = s.carbon > 0 ? oxidised / s.carbon : 0;
    const double lost = s.hydrogen * (share + s.dehydrogenation);
    rates[hydrogenScalar()] = hydrogen * weight - lost;
    released = lost / weight;
  }
  exchange[H] = s.byOH;
  exchange[H2] = s.growth + 0.5 * released;
  exchange[OH] = -s.byOH;
  exchange[O2] = -s.byO2;
  exchange[C2H2] = -s.growth;
  exchange[CO] = 2 * s.byO2 + s.byOH;
}

SectionalSoot::SectionalSoot(const SectionalSootOptions& options) : impl_(std::make_unique<Impl>(options)) {}

SectionalSoot::~SectionalSoot() = default;

const std::vector<std::string>& SectionalSoot::gasSpecies() const {
  return impl_->species;
}

const std::vector<ParticleScalar>& SectionalSoot::scalars() const {
  return impl_->scalars;
}

std::size_t SectionalSoot::sections() const {
  return impl_->sections;
}

std::span<const double> SectionalSoot::pivots() const {
  return impl_->pivots;
}

const SectionalSootOptions& SectionalSoot::options() const {
  return impl_->options;
}

void SectionalSoot::sources(const ParticleGas& gas, std::span<const double> densities, std::span<double> rates,
                            std::span<double> exchange) const {
  impl_->prepare(gas, densities);
  impl_->pairs.updateKernels(impl_->shapes, impl_->collisionGas(gas));
  impl_->sources(rates, exchange);
}

void SectionalSoot::addSpheres(double count, double volume, std::span<double> densities) const {
  const std::vector<double>& pivots = impl_->pivots;
  const double carbon = volume * impl_->options.soot.sootDensity;
  const auto add = [&](std::size_t section, double particles) {
    densities[section] += particles;
    if (!impl_->spheres) densities[impl_->sections + section] += particles;
  };
  if (carbon <= pivots.front()) return add(0, count * carbon / pivots.front());
  if (carbon >= pivots.back()) return add(pivots.size() - 1, count * carbon / pivots.back());
  const auto upper = static_cast<std::size_t>(std::ranges::upper_bound(pivots, carbon) - pivots.begin());
  const double part = (carbon - pivots[upper - 1]) / (pivots[upper] - pivots[upper - 1]);
  add(upper - 1, (1.0 - part) * count);
  add(upper, part * count);
}

}  // namespace lampblack::particles
