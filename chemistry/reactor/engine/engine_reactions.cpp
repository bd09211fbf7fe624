#include "chemistry/reactor/engine/engine_reactions.hpp"

#include <algorithm>
#include <array>

#include "core/work_sharing.hpp"

namespace lampblack::chemistry {
namespace {

// What travels before the mass fractions, there and back.
constexpr std::size_t sentValues = 4, returnedValues = 4;

}  // namespace

EngineReactions::EngineReactions(MPI_Comm comm, const Mechanism& mechanism, const Thermo& thermo,
                                 const ConstantPressureReactor::Options& options)
    : comm_(comm), reactor_(mechanism, options), formation_(mechanism.numSpecies()) {
  MPI_Comm_rank(comm, &rank_);
  MPI_Comm_size(comm, &ranks_);
  thermo.speciesEnthalpies(formationTemperature, formation_);
}

EngineReactions::Work EngineReactions::advance(double duration, EngineGas& gas, const std::vector<char>& isDone) {
  const std::size_t species = gas.species, width = returnedValues + species;
  const auto ranks = static_cast<std::size_t>(ranks_), rank = static_cast<std::size_t>(rank_);
  std::vector<std::size_t> own;
  for (std::size_t i = rank; i < gas.count(); i += ranks)
    if (isDone[i] == 0) own.push_back(i);
  rows_.assign(gas.count() * width, 0);

  WorkSharing::Items items;
  for (const std::size_t i : own) items.cost.push_back(gas.cost[i]);
  items.groupSize = 256;
  items.pack = [&](std::size_t item, std::vector<double>& input) {
    const std::size_t i = own[item];
    input = {duration, gas.pressure, gas.temperature[i], gas.firstStep[i]};
    input.insert(input.end(), gas.Y(i).begin(), gas.Y(i).end());
  };
  items.advanceGroup = [&](std::span<const std::span<const double>> inputs, std::span<std::vector<double>> outputs) {
    std::vector<ConstantPressureReactor::Cell> cells(inputs.size());
    std::vector<ConstantPressureReactor::Result> results(inputs.size());
    for (std::size_t c = 0; c < inputs.size(); ++c) {
      outputs[c].resize(width);
      std::ranges::copy(inputs[c].subspan(sentValues), outputs[c].begin() + returnedValues);
      cells[c].pressure = inputs[c][1];
      cells[c].temperature = inputs[c][2];
      cells[c].initialStep = inputs[c][3];
      cells[c].Y = std::span(outputs[c]).subspan(returnedValues);
    }
    reactor_.advance(cells, inputs.front()[0], results);
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const std::array<double, returnedValues> head{cells[c].temperature, cells[c].initialStep, results[c].work,
                                                    static_cast<double>(results[c].steps)};
      std::ranges::copy(head, outputs[c].begin());
    }
  };
  items.unpack = [&](std::size_t item, std::span<const double> output) {
    std::ranges::copy(output, rows_.begin() + static_cast<std::ptrdiff_t>(own[item] * width));
  };
  items.work = [](std::span<const double> output) { return output[2]; };
  WorkSharing(comm_, ranks_ > 1).run(items);
  // Each row is of one rank, and zero on the others.
  if (ranks_ > 1) MPI_Allreduce(MPI_IN_PLACE, rows_.data(), static_cast<int>(rows_.size()), MPI_DOUBLE, MPI_SUM, comm_);

  Work done;
  for (std::size_t i = 0; i < gas.count(); ++i) {
    if (isDone[i] != 0) continue;
    const std::span<const double> row = std::span<const double>(rows_).subspan(i * width, width);
    gas.temperature[i] = row[0];
    gas.firstStep[i] = row[1];
    gas.cost[i] = row[2] > 0 ? row[2] : 1;
    done.steps += row[3];
    for (std::size_t k = 0; k < species; ++k) {
      const double Y = row[returnedValues + k];
      done.heat -= gas.mass[i] * formation_[k] * (Y - gas.Y(i)[k]);
      gas.Y(i)[k] = Y;
    }
  }
  return done;
}

}  // namespace lampblack::chemistry
