#include "app/problems/reactor/reactor_ensemble_columns.hpp"

#include <algorithm>
#include <utility>

#include "app/problems/reactor/reactor_output.hpp"

namespace lampblack::app {

bool keepsEnergy(const ReactorCase& reactorCase) {
  const ReactorKind& kind = *reactorCase.kind;
  return kind.network() == nullptr && !reactorCase.profile && !kind.isGiven();
}

std::vector<Quantity> ensembleColumns(const ReactorCase& reactorCase, bool hasElements) {
  std::vector<Quantity> ofReactor{{"temperature", "K", "gas temperature"},
                                  {"pressure", "Pa", "pressure"},
                                  {"density", "kg/m^3", "density of gas and particles"}};
  for (Quantity& column : reactorCase.ensemble->make(0)->columns()) ofReactor.push_back(std::move(column));
  ofReactor.push_back({reactorCase.ensemble->material + "_mass_exchanged", "kg/m^3",
                       "mass of particles by what they exchanged with the gas; differs from theirs by numerical "
                       "particles that come and go, zero in the mean"});
  if (hasElements)
    ofReactor.push_back({"element_imbalance", "1",
                         (reactorCase.kind->network() != nullptr)
                             ? "largest relative difference of an element in gas and particles from "
                               "what flows in"
                             : "largest relative change of an element in gas and particles"});
  if (keepsEnergy(reactorCase))
    ofReactor.push_back({"energy_imbalance", "1", "change of the energy of gas and particles over cp T"});
  for (auto& column : speciesColumns(*reactorCase.mechanism, reactorCase.output))
    ofReactor.push_back(std::move(column));
  std::vector<Quantity> columns = reactorCase.kind->placeColumns();
  for (std::size_t r = 0; r < reactorCase.kind->reactors(); ++r)
    for (const Quantity& column : ofReactor)
      columns.push_back({reactorCase.kind->prefix(r) + column.name, column.unit, column.description});
  return columns;
}

std::vector<std::size_t> shownColumns(const ReactorCase& reactorCase, const std::vector<Quantity>& all) {
  std::vector<std::size_t> columns;
  const std::string& material = reactorCase.ensemble->material;
  for (std::size_t r = 0; r < reactorCase.kind->reactors(); ++r)
    for (const std::string& name : {std::string("temperature"), material + "_volume_fraction",
                                    material + "_number_density", material + "_mean_diameter"}) {
      const auto found = std::find_if(all.begin(), all.end(),
                                      [&](const Quantity& c) { return c.name == reactorCase.kind->prefix(r) + name; });
      columns.push_back(static_cast<std::size_t>(found - all.begin()));
    }
  return columns;
}

}  // namespace lampblack::app
