#include "app/problems/flame/flame_soot_output.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lampblack::app {
std::vector<NamedNumber> namedSootNumbers(const FlameFields& gas, const FlameSootFields& soot) {
  const std::vector<double>& fraction = soot.property("volume_fraction").values;
  const std::vector<double>& number = soot.property("number_density").values;
  const auto sootiest = static_cast<std::size_t>(std::max_element(fraction.begin(), fraction.end()) - fraction.begin());
  double column = 0;
  for (std::size_t i = 0; i + 1 < fraction.size(); ++i)
    column += 0.5 * (gas.z[i + 1] - gas.z[i]) * (fraction[i] + fraction[i + 1]);
  return {{"maximum_volume_fraction", "1", fraction[sootiest]},
          {"position_of_maximum_volume_fraction", "m", gas.z[sootiest]},
          {"integrated_volume_fraction", "m", column},
          {"maximum_number_density", "1/m^3", *std::max_element(number.begin(), number.end())},
          {"mean_diameter_at_maximum_volume_fraction", "m", soot.property("mean_diameter").values[sootiest]}};
}

void writeFlameSoot(ResultsWriter& results, const FlameSootFields& soot) {
  const auto write = [&](const std::string& folder, const std::vector<FlameSootFields::Field>& fields) {
    for (const FlameSootFields::Field& field : fields)
      results.dataset(folder + field.name, {static_cast<std::int64_t>(field.values.size())}, field.values, field.unit,
                      field.description);
  };
  write("/flame/soot/", soot.properties);
  write("/flame/soot/processes/", soot.processes);
  write("/flame/soot/scalars/", soot.scalars);
  if (soot.diameter.empty()) return;
  const auto sizes = static_cast<std::int64_t>(soot.diameter.size());
  results.dataset("/flame/soot/diameter", {sizes}, soot.diameter, "m", "diameters of the size distribution");
  results.dataset("/flame/soot/size_distribution",
                  {static_cast<std::int64_t>(soot.sizeDistribution.size()) / sizes, sizes}, soot.sizeDistribution,
                  "1/m^3", "dN/dlog10 d of each point");
}

}  // namespace lampblack::app
