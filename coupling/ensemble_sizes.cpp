#include "coupling/ensemble_sizes.hpp"

#include <algorithm>

#include "core/order_free_sums.hpp"

namespace lampblack::coupling {
namespace {

// Numbers of primaries: eight bins a factor of ten, the first with what has not coagulated; the last is without end.
const SizeBins primaryBins{0.0, 8.0, 64};

}  // namespace

std::vector<Quantity> regionSizeColumns() {
  return {{"diameter_low", "m", "mobility diameter, the lower edge of the bin"},
          {"diameter_high", "m", "mobility diameter, the upper edge of the bin"},
          {"size_distribution", "1/m^3", "dN/dlog10(d), mean over the region"}};
}

std::vector<double> regionSizeRows(const RowSizes& of, const SizeBins& bins, const MeshRegion& region,
                                   std::span<const std::vector<double>> populations) {
  std::vector<PlacedValue> values;
  std::vector<double> density(bins.count);
  for (const int c : region.cells()) {
    const auto cell = static_cast<std::size_t>(c);
    std::ranges::fill(density, 0.0);
    addSizes(of, bins, populations[cell], density);
    for (std::size_t b = 0; b < bins.count; ++b)
      if (density[b] > 0.0) values.push_back({b, region.mesh().volume[cell] * density[b]});
  }
  const std::vector<double> sums = orderFreeSums(region.mesh().comm, bins.count, values);
  std::vector<double> rows;
  for (std::size_t b = 0; b < bins.count; ++b)
    rows.insert(rows.end(), {bins.edge(b), bins.edge(b + 1), sums[b] / region.volume()});
  return rows;
}

std::vector<Quantity> regionJointColumns() {
  return {{"primary_diameter_low", "m", "diameter of the primary particles, the lower edge of the bin"},
          {"primary_diameter_high", "m", "diameter of the primary particles, the upper edge of the bin"},
          {"primaries_low", "1", "primary particles in an aggregate, the lower edge of the bin"},
          {"primaries_high", "1", "primary particles in an aggregate, the upper edge of the bin"},
          {"number_density", "1/m^3", "particles of the bin, mean over the region"},
          {"mass_density", "kg/m^3", "mass of these, mean over the region"},
          {"surface_area", "m^2/m^3", "surface of these, mean over the region"}};
}

std::vector<double> regionJointRows(const RowSizes& of, const SizeBins& bins, const MeshRegion& region,
                                    std::span<const std::vector<double>> populations) {
  constexpr std::size_t amounts = 3;
  const std::size_t places = bins.count * primaryBins.count * amounts;
  std::vector<PlacedValue> values;
  std::vector<double> ofCell(places);
  std::vector<std::size_t> touched;
  for (const int c : region.cells()) {
    touched.clear();
    of.rows.forEach(of.rows.of(populations[static_cast<std::size_t>(c)]), [&](const double* row) {
      const SootAggregate::Particle p = of.particle(row);
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
        values.push_back({place + a, region.mesh().volume[static_cast<std::size_t>(c)] * ofCell[place + a]});
        ofCell[place + a] = 0.0;
      }
  }
  const std::vector<double> sums = orderFreeSums(region.mesh().comm, places, values);
  std::vector<double> rows;
  for (std::size_t place = 0; place < places; place += amounts) {
    if (!(sums[place] > 0.0)) continue;
    const std::size_t size = place / amounts / primaryBins.count, primaries = place / amounts % primaryBins.count;
    rows.insert(rows.end(),
                {bins.edge(size), bins.edge(size + 1), primaryBins.edge(primaries), primaryBins.edge(primaries + 1)});
    for (std::size_t a = 0; a < amounts; ++a) rows.push_back(sums[place + a] / region.volume());
  }
  return rows;
}

}  // namespace lampblack::coupling
