#include "particles/population/model/population_model.hpp"

namespace lampblack {

void check(const PopulationModel&, const InitialPopulation&) {}

}  // namespace lampblack
