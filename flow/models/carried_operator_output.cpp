// What CarriedOperator tells: its columns of the history, lines of the report, fields.
#include <fmt/format.h>

#include <algorithm>

#include "core/errors.hpp"
#include "core/first_error.hpp"
#include "flow/models/carried_operator.hpp"
#include "flow/peak.hpp"

namespace lampblack::flow {

std::vector<Quantity> CarriedOperator::historyColumns() const {
  const std::string material = model_.material();
  return {{"peak_" + material + "_volume_fraction", "1", "largest volume fraction of " + material},
          {material + "_at_limit", "1",
           "largest volume fraction in particles that cannot grow any more, over the largest of all"},
          {material + "_solver_steps", "1", "internal steps of its stiff solver over all cells since the start"}};
}

std::vector<double> CarriedOperator::historyValues(const State& state) {
  const Mesh& m = context_.mesh;
  const Peak peak = peakOf(m, [&](int c) { return model_.volumeFraction(densities(state, c)); });
  place_ = peak.place;
  double atLimit = 0.0;
  for (int c = 0; c < m.owned; ++c) atLimit = std::max(atLimit, model_.volumeFractionAtLimit(densities(state, c)));
  MPI_Allreduce(MPI_IN_PLACE, &atLimit, 1, MPI_DOUBLE, MPI_MAX, m.comm);
  auto steps = static_cast<double>(steps_);
  MPI_Allreduce(MPI_IN_PLACE, &steps, 1, MPI_DOUBLE, MPI_SUM, m.comm);
  peak_ = peak.value;
  partAtLimit_ = peak_ > 0.0 ? atLimit / peak_ : 0.0;
  return {peak_, partAtLimit_, steps};
}

void CarriedOperator::checkResult() const {
  if (partAtLimit_ <= options_.allowedAtLimit) return;
  raiseTogether(context_.mesh.comm,
                NumericsError(fmt::format("a fraction {:.2g} of the largest volume fraction of {} is in the largest "
                                          "particles of the model; the limit is {:.2g}. {}",
                                          partAtLimit_, model_.material(), options_.allowedAtLimit, options_.advice)));
}

std::string CarriedOperator::status() const {
  return fmt::format("fv {:.3g} ppm", 1e6 * peak_);
}

std::vector<std::string> CarriedOperator::closingLines() const {
  return {fmt::format("peak {} volume fraction {:.4g} ppm at ({:.3f}, {:.3f}) mm", model_.material(), 1e6 * peak_,
                      1e3 * place_[0], 1e3 * place_[1])};
}

void CarriedOperator::fields(const State& state, const FieldSink& sink) const {
  const auto owned = static_cast<std::size_t>(context_.mesh.owned);
  std::vector<double> column(owned), concentrations;
  for (std::size_t s = first_; s < first_ + scalars_; ++s) {
    for (std::size_t c = 0; c < owned; ++c) column[c] = state.carried[c * state.scalars.size() + s];
    sink({state.scalars[s].name, state.scalars[s].unit, state.scalars[s].description}, column);
  }
  const std::vector<Quantity> properties = model_.properties();
  std::vector<double> values(properties.size()), all(properties.size() * owned);
  for (std::size_t c = 0; c < owned; ++c) {
    const int cell = static_cast<int>(c);
    const ParticleGas gas =
        gasOfCell(context_, state, cell, viscosityOf(state, cell), model_.exchanged(), concentrations);
    model_.evaluateProperties(gas, densities(state, cell), values);
    for (std::size_t p = 0; p < properties.size(); ++p) all[p * owned + c] = values[p];
  }
  for (std::size_t p = 0; p < properties.size(); ++p)
    sink({model_.material() + "_" + properties[p].name, properties[p].unit, properties[p].description},
         {&all[p * owned], owned});
}

}  // namespace lampblack::flow
