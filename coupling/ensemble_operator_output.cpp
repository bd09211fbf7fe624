// What EnsembleOperator tells: its columns of the history, lines of the report, fields, averages, and what left the
// flow.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

#include "coupling/ensemble_operator.hpp"
#include "coupling/load_ahead.hpp"
#include "flow/peak.hpp"
#include "particles/models/particle_model.hpp"

namespace lampblack::coupling {
namespace {

// Of the amounts per volume.
ParticleProperties propertiesOf(std::span<const double> amount, const CellParticles& of) {
  const AmountPlaces at = of.amounts();
  ParticleProperties p;
  const double N = amount[AmountPlaces::number];
  if (!(N > 0.0)) return p;
  p.numberDensity = N;
  p.volumeFraction = of.volumeOf(amount);
  p.meanDiameter = std::cbrt(6.0 / constants::pi * p.volumeFraction / N);
  p.surfaceArea = amount[at.surface()];
  p.primaryDiameter = 6.0 * p.volumeFraction / amount[at.surface()];
  p.primariesPerAggregate = amount[at.primaries()] / N;
  p.mobilityDiameter = amount[at.diameters()] / N;
  p.gyrationDiameter = p.primaryDiameter * SootAggregate::collisionFactor(p.primariesPerAggregate);
  return p;
}

}  // namespace

std::vector<Quantity> EnsembleOperator::historyColumns() const {
  const std::string& name = particles_->material();
  return {{"peak_" + name + "_volume_fraction", "1", "largest volume fraction of " + name},
          {"ensembles", "1", "cells with particles"},
          {"numerical_particles", "1", "numerical particles in all cells"},
          {name + "_resampled", integralUnit(context_.mesh, "kg"),
           name + " that came and went with numerical particles since the start, zero in the mean"},
          {"transport_parts", "1", "parts that the particles' transport was divided into, two at least"},
          {"transport_limited", "1", "numerical particles whose probability to move was limited in the last step"},
          // With and without averages, so that a run may go on with them.
          {name + "_averages_since", "s", "when averages of the particles over time started; nan before"},
          {name + "_averaged_blocks", "1", "blocks of time in the averages of the particles"}};
}

std::vector<double> EnsembleOperator::historyValues(const State& state) {
  const Mesh& m = context_.mesh;
  const Peak peak = peakOf(m, [&](int cell) {
    const double* amount = &state.carried[amountsAt(state, cell)];
    return particles_->volumeOf({amount, amounts_.count()});
  });
  peak_ = peak.value;
  place_ = peak.place;
  std::array<double, 4> sums{0.0, 0.0, std::accumulate(resampled_.begin(), resampled_.end(), 0.0),
                             !hasMoved_ ? 0.0 : static_cast<double>(transport_.limited())};
  const ParticleRows& rows = particles_->rows();
  for (const std::vector<double>& population : populations_) {
    if (rows.isEmpty(population)) continue;
    sums[0] += 1.0;
    sums[1] += static_cast<double>(rows.count(rows.of(population)));
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, m.comm);
  const std::optional<double> since = statistics_ ? statistics_->since() : std::nullopt;
  return {peak_,
          sums[0],
          sums[1],
          sums[2],
          !hasMoved_ ? 0.0 : static_cast<double>(transport_.parts()),
          sums[3],
          since.value_or(std::numeric_limits<double>::quiet_NaN()),
          statistics_ ? static_cast<double>(statistics_->blocks()) : 0.0};
}

std::string EnsembleOperator::status() const {
  return fmt::format("fv {:.3g} ppm", 1e6 * peak_);
}

std::vector<std::string> EnsembleOperator::closingLines() const {
  std::vector<std::string> lines{fmt::format("peak {} volume fraction {:.4g} ppm at ({:.3f}, {:.3f}) mm",
                                             particles_->material(), 1e6 * peak_, 1e3 * place_[0], 1e3 * place_[1])};
  if (statistics_) std::ranges::copy(statistics_->closingLines(), std::back_inserter(lines));
  return lines;
}

void EnsembleOperator::fields(const State& state, const FieldSink& sink) const {
  const auto owned = static_cast<std::size_t>(context_.mesh.owned);
  const std::string& material = particles_->material();
  const ParticleRows& rows = particles_->rows();
  std::vector<double> column(owned);
  for (std::size_t s = 0; s < amounts_.count(); ++s) {
    for (std::size_t c = 0; c < owned; ++c) column[c] = state.carried[amountsAt(state, static_cast<int>(c)) + s];
    const CarriedScalar& scalar = state.scalars[first_ + s];
    sink({scalar.name, scalar.unit, scalar.description}, column);
  }
  std::vector<ParticleProperties> all;
  for (std::size_t c = 0; c < owned; ++c)
    all.push_back(propertiesOf({&state.carried[amountsAt(state, static_cast<int>(c))], amounts_.count()}, *particles_));
  for (const ParticlePropertyName& property : particlePropertyNames) {
    for (std::size_t c = 0; c < owned; ++c) column[c] = all[c].*property.value;
    sink({material + "_" + property.name, property.unit, property.description}, column);
  }
  for (std::size_t c = 0; c < owned; ++c) column[c] = static_cast<double>(rows.count(rows.of(populations_[c])));
  sink({"numerical_particles", "1", "numerical particles of the cell's ensemble"}, column);
  if (const std::string name = material + "_geometric_standard_deviation"; sink.wants(name)) {
    for (std::size_t c = 0; c < owned; ++c) column[c] = geometricDeviation(particles_->sizes(), populations_[c]);
    sink({name, "1", "of the mobility diameter, by number; 1 where there are no particles"}, column);
  }
  if (const std::string name = material + "_size_distribution"; options_.sizes && sink.wants(name)) {
    std::vector<double> sizes(owned * options_.bins.count, 0.0);
    for (std::size_t c = 0; c < owned; ++c)
      addSizes(particles_->sizes(), options_.bins, populations_[c],
               {&sizes[c * options_.bins.count], options_.bins.count});
    sink(
        {name, "1/m^3", fmt::format("dN/dlog10(d) by mobility diameter, in the bins of /{}_sizes/bin_edges", material)},
        sizes);
  }
  if (statistics_) statistics_->fields(sink);
}

std::vector<Operator::Dataset> EnsembleOperator::datasets() const {
  return {{{fmt::format("/{}_sizes/bin_edges", particles_->material()), "m",
            "mobility diameters between the bins of the size distributions"},
           options_.bins.edges()}};
}

std::vector<Operator::RegionTable> EnsembleOperator::regionTables() const {
  std::vector<RegionTable> tables{{"sizes", regionSizeColumns()}};
  // Of spheres one follows from the other.
  if (!particles_->sizes().type.coalescing()) tables.push_back({"joint", regionJointColumns()});
  return tables;
}

std::vector<double> EnsembleOperator::regionRows(std::size_t table, const MeshRegion& region) const {
  const auto rows = table == 0 ? regionSizeRows : regionJointRows;
  return rows(particles_->sizes(), options_.bins, region, populations_);
}

void EnsembleOperator::countOutflow() {
  std::ranges::fill(outflow_, 0.0);
  goneThrough_.assign(static_cast<std::size_t>(context_.mesh.boundaryFaces()), 0.0);
  std::vector<double> amounts(outflow_.size());
  auto face = transport_.goneThrough().begin();
  particles_->rows().forEach(transport_.gone(), [&](const double* row) {
    std::ranges::fill(amounts, 0.0);
    particles_->addAmounts(row, row[packedNumberAt], amounts);
    for (std::size_t i = 0; i < amounts.size(); ++i) outflow_[i] += amounts[i];
    double& mass = goneThrough_[static_cast<std::size_t>(*face++ - context_.mesh.interiorFaces)];
    for (std::size_t e = 0; e < amounts_.held; ++e) mass += amounts[amounts_.element(e)];
  });
}

void EnsembleOperator::addToStatistics(const State& state) {
  if (!statistics_) return;
  const auto amountsOf = [&](int cell) {
    const double* amount = &state.carried[amountsAt(state, cell)];
    return EnsembleStatistics::CellAmounts{
        amount[AmountPlaces::number], particles_->volumeOf({amount, amounts_.count()}), amount[amounts_.primaries()],
        amount[amounts_.surface()], amount[amounts_.diameters()]};
  };
  const auto sizesOf = [&](int cell, std::span<double> sizes) {
    loadAhead(populations_, cell + 1);
    addSizes(particles_->sizes(), options_.bins, populations_[cell], sizes);
  };
  statistics_->addStep(stepEnd_, lastStep_, {amountsOf, sizesOf});
}

}  // namespace lampblack::coupling
