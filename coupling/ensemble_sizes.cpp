#include "coupling/ensemble_sizes.hpp"

#include <algorithm>
#include <cmath>

#include "core/order_free_sums.hpp"
#include "particles/population/monte_carlo/weighted_deviation.hpp"

namespace lampblack::coupling {
namespace {

// Numbers of primaries: eight bins a factor of ten, the first with what has not coagulated; the last is without end.
const SizeBins primaryBins{0.0, 8.0, 64};

SootAggregate::Particle particleOf(const SootAggregate& type, const double* row) {
  const GivenParticle p = particleAt(row);
  return type.make(p.carbon, p.hydrogen, p.primaries);
}

}  // namespace

void addSizes(const RowSizes& of, const SizeBins& bins, std::span<const double> population, std::span<double> density) {
  of.rows.forEach(of.rows.of(population), [&](const double* row) {
    const std::size_t bin = bins.of(of.type.mobilityDiameter(particleOf(of.type, row)));
    if (bin < bins.count) density[bin] += row[packedNumberAt] / bins.width();
  });
}

double geometricDeviation(const RowSizes& of, std::span<const double> population) {
  WeightedDeviation deviation;
  of.rows.forEach(of.rows.of(population), [&](const double* row) {
    deviation.add(std::log(of.type.mobilityDiameter(particleOf(of.type, row))), row[packedNumberAt]);
  });
  return deviation.geometric();
}

EnsembleRegion::EnsembleRegion(const Mesh& mesh, const Vector3& from, const Vector3& to) : mesh_(mesh) {
  std::vector<PlacedValue> volumes;
  for (int c = 0; c < mesh.owned; ++c) {
    const Vector3& x = mesh.centre[static_cast<std::size_t>(c)];
    bool inside = true;
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(mesh.dimension); ++axis)
      inside = inside && from[axis] <= x[axis] && x[axis] <= to[axis];
    if (!inside) continue;
    cells_.push_back(c);
    volumes.push_back({0, mesh.volume[static_cast<std::size_t>(c)]});
  }
  volume_ = orderFreeSums(mesh.comm, 1, volumes)[0];
}

std::vector<Quantity> EnsembleRegion::sizeColumns() {
  return {{"diameter_low", "m", "mobility diameter, the lower edge of the bin"},
          {"diameter_high", "m", "mobility diameter, the upper edge of the bin"},
          {"size_distribution", "1/m^3", "dN/dlog10(d), mean over the region"}};
}

std::vector<double> EnsembleRegion::sizeRows(const RowSizes& of, const SizeBins& bins,
                                             std::span<const std::vector<double>> populations) const {
  std::vector<PlacedValue> values;
  std::vector<double> density(bins.count);
  for (const int c : cells_) {
    const auto cell = static_cast<std::size_t>(c);
    std::ranges::fill(density, 0.0);
    addSizes(of, bins, populations[cell], density);
    for (std::size_t b = 0; b < bins.count; ++b)
      if (density[b] > 0.0) values.push_back({b, mesh_.volume[cell] * density[b]});
  }
  const std::vector<double> sums = orderFreeSums(mesh_.comm, bins.count, values);
  std::vector<double> rows;
  for (std::size_t b = 0; b < bins.count; ++b)
    rows.insert(rows.end(), {bins.edge(b), bins.edge(b + 1), sums[b] / volume_});
  return rows;
}

std::vector<Quantity> EnsembleRegion::jointColumns() {
  return {{"primary_diameter_low", "m", "diameter of the primary particles, the lower edge of the bin"},
          {"primary_diameter_high", "m", "diameter of the primary particles, the upper edge of the bin"},
          {"primaries_low", "1", "primary particles in an aggregate, the lower edge of the bin"},
          {"primaries_high", "1", "primary particles in an aggregate, the upper edge of the bin"},
          {"number_density", "1/m^3", "particles of the bin, mean over the region"},
          {"mass_density", "kg/m^3", "mass of these, mean over the region"},
          {"surface_area", "m^2/m^3", "surface of these, mean over the region"}};
}

std::vector<double> EnsembleRegion::jointRows(const RowSizes& of, const SizeBins& bins,
                                              std::span<const std::vector<double>> populations) const {
  constexpr std::size_t amounts = 3;
  const std::size_t places = bins.count * primaryBins.count * amounts;
  std::vector<PlacedValue> values;
  std::vector<double> ofCell(places);
  std::vector<std::size_t> touched;
  for (const int c : cells_) {
    touched.clear();
    of.rows.forEach(of.rows.of(populations[static_cast<std::size_t>(c)]), [&](const double* row) {
      const SootAggregate::Particle p = particleOf(of.type, row);
      const double number = row[packedNumberAt];
      const std::size_t size = bins.of(of.type.primaryDiameter(p));
      if (size == bins.count) return;
      const std::size_t primaries = std::min(primaryBins.of(std::max(1.0, p.primaries)), primaryBins.count - 1);
      const std::size_t place = (size * primaryBins.count + primaries) * amounts;
      if (!(ofCell[place] > 0.0)) touched.push_back(place);
      ofCell[place] += number;
      ofCell[place + 1] += number * SootAggregate::mass(p);
      ofCell[place + 2] += number * of.type.surface(p);
    });
    for (const std::size_t place : touched)
      for (std::size_t a = 0; a < amounts; ++a) {
        values.push_back({place + a, mesh_.volume[static_cast<std::size_t>(c)] * ofCell[place + a]});
        ofCell[place + a] = 0.0;
      }
  }
  const std::vector<double> sums = orderFreeSums(mesh_.comm, places, values);
  std::vector<double> rows;
  for (std::size_t place = 0; place < places; place += amounts) {
    if (!(sums[place] > 0.0)) continue;
    const std::size_t size = place / amounts / primaryBins.count, primaries = place / amounts % primaryBins.count;
    rows.insert(rows.end(),
                {bins.edge(size), bins.edge(size + 1), primaryBins.edge(primaries), primaryBins.edge(primaries + 1)});
    for (std::size_t a = 0; a < amounts; ++a) rows.push_back(sums[place + a] / volume_);
  }
  return rows;
}

}  // namespace lampblack::coupling
