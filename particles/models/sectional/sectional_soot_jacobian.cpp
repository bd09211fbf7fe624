// The analytic Jacobian of SectionalSoot: coagulation by pairs; growth, oxidation and break-up along the sections; and
// what couples all sections, alpha(mu_1), dimers and hydrogen, as products of a column and a row. The six dependences
// of the surface rates on the gas, the PAH and the temperature are central differences.
#include <algorithm>
#include <cmath>

#include "particles/models/sectional/sectional_soot_impl.hpp"

namespace lampblack::particles {
namespace {

// Where the quantities that exchange is made of are kept: one row each, by all columns.
enum Events : std::size_t { growth, byO2, byOH, firstConsumption };

}  // namespace

// One row or column of the Jacobian being made.
struct SectionalSoot::Impl::Assembly {
  Impl& m;
  double* J;
  std::size_t ld;
  double* events;

  [[nodiscard]] std::size_t rows() const { return m.sections * (m.spheres ? 1 : 2); }

  // A row of aggregates and, where there are primaries, their row times `ratio`.
  void add(std::size_t c, std::size_t row, double value, double ratio) {
    J[row * ld + c] += value;
    if (!m.spheres) J[(m.sections + row) * ld + c] += value * ratio;
  }
  // More carbon G (kg/m3/s) gained (up) or lost by the aggregates of section i, with primaries as they are there.
  void addFlux(std::size_t c, std::size_t i, const SectionFlux& flux, bool up, double G) {
    if (G == 0) return;
    flux.forInfluence(i, [&](std::size_t k, double byG) {
      const double ratio = m.primaryRatio(k), number = byG * G;
      add(c, k, -number, ratio);
      if (up && k + 1 < m.sections) add(c, k + 1, number, ratio);
      if (!up && k > 0) add(c, k - 1, number, ratio);
    });
  }
  // Aggregates (1/m3/s), and primaries, of section i that break.
  void addBreaking(std::size_t c, std::size_t i, double number, double primaries) {
    if (number == 0 && primaries == 0) return;
    const std::size_t n = m.sections, low = i - m.halves.below;
    J[i * ld + c] -= number;
    J[low * ld + c] += 2 * number * m.halves.number[0];
    J[(low + 1) * ld + c] += 2 * number * m.halves.number[1];
    if (m.spheres) return;
    J[(n + i) * ld + c] -= primaries;
    J[(n + low) * ld + c] += primaries * m.halves.primaries[0];
    J[(n + low + 1) * ld + c] += primaries * m.halves.primaries[1];
  }
  // More primaries in what moves from section i by growth and oxidation (1/m3 of the primaries of the section).
  void addPrimaries(std::size_t c, std::size_t i, double primaries) {
    const std::size_t n = m.sections;
    const double up = m.state.up.frequency[i] * primaries, down = m.state.down.frequency[i] * primaries;
    J[(n + i) * ld + c] -= up + down;
    if (i + 1 < n) J[(n + i + 1) * ld + c] += up;
    if (i > 0) J[(n + i - 1) * ld + c] += down;
  }
  void addNuclei(std::size_t c, const SectionPah::Nuclei& nuclei, double factor) {
    for (int kind = 0; kind < (m.spheres ? 1 : 2); ++kind) {
      double* at = J + c + (kind == 0 ? 0 : m.sections * ld);
      at[nuclei.lower * ld] += factor * nuclei.share * nuclei.rate;
      at[(nuclei.lower + 1) * ld] += factor * (1 - nuclei.share) * nuclei.rate;
    }
  }
};

void SectionalSoot::Impl::addSections(Assembly& a) {
  const State& s = state;
  const double weight = options.soot.carbonWeight;
  const double growing = 2 * weight * s.surface.growth;
  const double oxidising = weight * (2 * s.surface.oxidationO2 + s.surface.oxidationOH);
  double* events = a.events;
  const std::size_t ld = a.ld;
  for (std::size_t i = 0; i < sections; ++i) {
    const double N = s.aggregates[i], P = spheres ? 0 : s.primaries[i];
    const bool last = i + 1 == sections;
    const double area = shapes.area[i], areaSlope = shapes.areaSlope[i];
    const auto column = [&](std::size_t c, double byDensity, double N1, double P1) {
      const double dArea = N1 * area + N * areaSlope * byDensity;
      if (!last) {
        a.addFlux(c, i, s.up, true,
                  growing * dArea + N1 * s.uptake.condensation[i] + N * s.uptake.slope[i] * byDensity);
        events[growth * ld + c] += s.surface.growth * dArea;
      }
      a.addFlux(c, i, s.down, false, oxidising * dArea);
      events[byO2 * ld + c] += s.surface.oxidationO2 * dArea;
      events[byOH * ld + c] += s.surface.oxidationOH * dArea;
      const double more =
          i < halves.below ? 0 : oxidising * options.fragmentation.perOxidation(shapes.primariesEach[i])[1] * byDensity;
      a.addBreaking(c, i, s.breaking[i] * N1 + more * N, s.breaking[i] * P1 + more * P);
      if (!spheres) a.addPrimaries(c, i, P1 - N1 * primaryRatio(i));
    };
    column(i, spheres ? 0 : shapes.byAggregates[i], 1, 0);
    if (!spheres) column(sections + i, shapes.byPrimaries[i], 0, 1);
  }
  if (!pah.consumptionByAggregates()) return;
  for (std::size_t k = 0; k < pahs; ++k) {
    std::vector<double>&each = perSection[0], &slope = perSection[1];
    std::fill(each.begin(), each.end(), 0);
    std::fill(slope.begin(), slope.end(), 0);
    pah.addConsumption(s.temperature, s.gas[fixed + k], shapes, k, each, slope);
    double* row = events + (firstConsumption + k) * ld;
    for (std::size_t i = 0; i < sections; ++i) {
      row[i] += each[i] + s.aggregates[i] * slope[i] * shapes.byAggregates[i];
      if (!spheres) row[sections + i] += s.aggregates[i] * slope[i] * shapes.byPrimaries[i];
    }
  }
}

// Column `c` by the flux of growth and of oxidation, kg/m2/s, and their events, times those given.
void SectionalSoot::Impl::addSurface(Assembly& a, std::size_t c, const Surface& by) {
  const State& s = state;
  const double weight = options.soot.carbonWeight;
  const double growing = 2 * weight * by.growth, oxidising = weight * (2 * by.oxidationO2 + by.oxidationOH);
  double area = 0;
  for (std::size_t i = 0; i < sections; ++i) {
    const double here = shapes.area[i] * s.aggregates[i];
    if (i + 1 < sections) a.addFlux(c, i, s.up, true, growing * here);
    a.addFlux(c, i, s.down, false, oxidising * here);
    if (i >= halves.below && options.fragmentation.active) {
      const double broken = oxidising * options.fragmentation.perOxidation(shapes.primariesEach[i])[0];
      a.addBreaking(c, i, broken * s.aggregates[i], broken * s.primaries[i]);
    }
    if (i + 1 == sections) a.events[growth * a.ld + c] += by.growth * area;
    area += here;
  }
  a.events[byO2 * a.ld + c] += by.oxidationO2 * area;
  a.events[byOH * a.ld + c] += by.oxidationOH * area;
}

// All columns by one quantity: `column` holds the derivatives by it (as made by the above in a column of its own),
// `row` its derivatives by the densities.
void SectionalSoot::Impl::addProduct(Assembly& a, std::size_t column, std::span<const double> row) {
  const auto add = [&](double* values) {
    const double factor = values[column];
    values[column] = 0;
    if (factor == 0) return;
    for (std::size_t c = 0; c < row.size(); ++c) values[c] += factor * row[c];
  };
  for (std::size_t r = 0; r < a.rows(); ++r) add(a.J + r * a.ld);
  for (std::size_t r = 0; r < firstConsumption + pahs; ++r) add(a.events + r * a.ld);
}

void SectionalSoot::Impl::addActiveSites(Assembly& a, const SurfaceChemistry& chemistry, std::size_t spare) {
  const State& s = state;
  if (options.soot.alpha || !(s.alpha > 0) || s.size <= 2) return;
  constexpr double step = 1e-4;
  const double slope = (chemistry.alpha(s.size * (1 + step)) - chemistry.alpha(s.size * (1 - step))) /
                       (2 * step * s.size * s.alpha);  // of ln alpha
  if (slope == 0) return;
  const bool primaries = options.activeSites == SectionalSootOptions::ActiveSites::primary;
  const double number = sizeNumber() + numberScale[0];
  std::vector<double>& row = fullRow;
  for (std::size_t i = 0; i < sections; ++i) {
    const double byN = primaries ? shapes.primariesEach[i] + s.aggregates[i] * shapes.byAggregates[i] : 1;
    row[i] = slope * (pivots[i] / carbonMass - s.size * byN) / number;
    if (!spheres)
      row[sections + i] = primaries ? -slope * s.size * s.aggregates[i] * shapes.byPrimaries[i] / number : 0;
  }
  addSurface(a, spare, {s.surface.growth, s.surface.oxidationO2, 0});
  addProduct(a, spare, {row.data(), a.rows()});
}

void SectionalSoot::Impl::addDimers(Assembly& a, std::size_t spare) {
  const State& s = state;
  const auto& uptake = s.uptake;
  if (!(uptake.dimers > 0)) return;
  std::vector<double>& row = fullRow;
  for (std::size_t i = 0; i < sections; ++i) {
    const double byEach = uptake.bySum * s.aggregates[i] * uptake.collisionSlope[i];
    row[i] = uptake.bySum * uptake.collision[i] + byEach * shapes.byAggregates[i];
    if (!spheres) row[sections + i] = byEach * shapes.byPrimaries[i];
  }
  for (std::size_t i = 0; i + 1 < sections; ++i) {
    a.addFlux(spare, i, s.up, true, uptake.condensation[i] * s.aggregates[i]);
  }
  for (std::size_t k = 0; k < uptake.kinds; ++k) a.addNuclei(spare, uptake.nuclei[k], 2);
  addProduct(a, spare, {row.data(), a.rows()});
}

void SectionalSoot::Impl::addGas(Assembly& a, const SurfaceChemistry& chemistry) {
  State& s = state;
  const std::size_t first = numberScalars();
  double scale = 0;
  // No rate depends on CO, which is only made.
  for (std::size_t k = 0; k < CO; ++k) scale += s.gas[k];
  for (std::size_t k = 0; k < CO && scale > 0; ++k) {
    const double c = s.gas[k], h = 1e-5 * (c + 1e-5 * scale), low = std::max(c - h, 0.0);
    auto gas = s.gas;
    gas[k] = c + h;
    const Surface upper = surface(chemistry, gas, s.alpha);
    gas[k] = low;
    const Surface lower = surface(chemistry, gas, s.alpha);
    const double over = 1 / (c + h - low);
    addSurface(a, first + k,
               {over * (upper.growth - lower.growth), over * (upper.oxidationO2 - lower.oxidationO2),
                over * (upper.oxidationOH - lower.oxidationOH)});
  }
  double pahScale = 1e-12;
  for (std::size_t k = 0; k < pahs; ++k) pahScale = std::max(pahScale, s.gas[fixed + k]);
  for (std::size_t k = 0; k < pahs; ++k) {
    const std::size_t c = first + fixed + k;
    const double at = s.gas[fixed + k], h = 1e-5 * (at + 1e-4 * pahScale), low = std::max(at - h, 0.0);
    auto changed = s.gas;
    for (const bool upper : {true, false}) {
      changed[fixed + k] = upper ? at + h : low;
      pah.evaluate(s.temperature, {&changed[fixed], pahs}, shapes, s.aggregates, spareUptake);
      const double over = (upper ? 1 : -1) / (at + h - low);
      for (std::size_t i = 0; i + 1 < sections; ++i)
        a.addFlux(c, i, s.up, true, over * spareUptake.condensation[i] * s.aggregates[i]);
      for (std::size_t q = 0; q < spareUptake.kinds; ++q) a.addNuclei(c, spareUptake.nuclei[q], over);
      for (std::size_t q = 0; q < pahs; ++q)
        a.events[(firstConsumption + q) * a.ld + c] += over * spareUptake.consumption[q];
    }
  }
}

// Rows of hydrogen and of the gas species, from those of the events.
void SectionalSoot::Impl::addExchange(Assembly& a) {
  const State& s = state;
  const std::size_t scalarCount = numberScalars(), columns = scalarCount + species.size();
  const double hydrogenWeight = options.soot.hydrogenWeight, carbonWeight = options.soot.carbonWeight;
  const auto row = [&](std::size_t gasSpecies) { return a.J + (scalarCount + gasSpecies) * a.ld; };
  const double over = s.carbon > 0 ? 1 / s.carbon : 0;
  const double share = over * carbonWeight * (2 * s.byO2 + s.byOH);
  for (std::size_t c = 0; c < columns; ++c) {
    const auto event = [&](std::size_t e) { return a.events[e * a.ld + c]; };
    double hydrogen = 0;
    for (std::size_t k = 0; k < pahs; ++k) {
      row(fixed + k)[c] = -event(firstConsumption + k);
      hydrogen += options.soot.pah[k].hydrogen * event(firstConsumption + k);
    }
    double released = hydrogen;
    if (withHydrogen) {
      const double carbon = c < sections ? pivots[c] : 0;
      const double lost = s.hydrogen * over * (carbonWeight * (2 * event(byO2) + event(byOH)) - share * carbon) +
                          (c == hydrogenScalar() ? share + s.dehydrogenation : 0);
      a.J[hydrogenScalar() * a.ld + c] = hydrogen * hydrogenWeight - lost;
      released = lost / hydrogenWeight;
    }
    row(H)[c] = event(byOH);
    row(H2)[c] = event(growth) + 0.5 * released;
    row(OH)[c] = -event(byOH);
    row(O2)[c] = -event(byO2);
    row(C2H2)[c] = -event(growth);
    row(CO)[c] = 2 * event(byO2) + event(byOH);
  }
}

void SectionalSoot::Impl::jacobian(const ParticleGas& gas, std::span<const double> densities,
                                   std::span<double> values) {
  const std::size_t scalarCount = numberScalars(), unknowns = scalarCount + species.size(), ld = unknowns + 1;
  std::fill(values.begin(), values.end(), 0);
  work.assign((firstConsumption + pahs) * ld, 0);
  Assembly a{*this, values.data(), ld, work.data()};
  prepare(gas, densities);
  if (options.soot.coagulation) {
    pairs.updateKernels(shapes, collisionGas(gas));
    if (!spheres) pairs.updateSlopes(shapes, collisionGas(gas));
    pairs.addJacobian(shapes, state.aggregates, state.primaries, a.J, ld);
  }
  const SurfaceChemistry chemistry(options.soot, gas.temperature);
  addSections(a);
  addActiveSites(a, chemistry, unknowns);
  addDimers(a, unknowns);
  addGas(a, chemistry);
  addExchange(a);
  // What counts as zero has no influence.
  for (std::size_t c = 0; c < unknowns; ++c) {
    if ((c < scalarCount ? densities[c] : gas.concentrations[c - scalarCount]) >= 0) continue;
    for (std::size_t r = 0; r < unknowns; ++r) a.J[r * ld + c] = 0;
  }

  const double h = 1e-5 * gas.temperature;
  fullRow.resize(unknowns);
  const std::span<double> rates(fullRow.data(), unknowns);
  for (const bool upper : {true, false}) {
    ParticleGas changed = gas;
    changed.temperature += upper ? h : -h;
    prepare(changed, densities);
    pairs.updateKernels(shapes, collisionGas(changed));
    sources(rates.first(scalarCount), rates.subspan(scalarCount));
    const double over = (upper ? 0.5 : -0.5) / h;
    for (std::size_t r = 0; r < unknowns; ++r) a.J[r * ld + unknowns] += over * rates[r];
  }
}

void SectionalSoot::jacobian(const ParticleGas& gas, std::span<const double> densities,
                             std::span<double> values) const {
  impl_->jacobian(gas, densities, values);
}

}  // namespace lampblack::particles
