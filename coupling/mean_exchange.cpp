#include "coupling/mean_exchange.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace lampblack::coupling {

namespace {

// Of the way to new rates. With a soot whose nuclei go as the square of what it takes, the whole way diverges where it
// takes more than half, and half of it halves what is left or better. From then on by what the last one did.
constexpr double firstWay = 0.5, leastWay = 0.3, wholeWay = 1.0;

}  // namespace

MeanExchange::MeanExchange(const FlowContext& context, std::span<const std::size_t> species)
    : context_(context),
      species_(species.begin(), species.end()),
      made_(static_cast<std::size_t>(context.mesh.owned) * width()),
      taken_(made_.size()),
      lacked_(made_.size()),
      way_(0.0) {}

void MeanExchange::approach(const State& state, std::span<const double> gained, double time) {
  const auto W = context_.mechanism.molecularWeights();
  std::vector<double> made(made_.size()), taken(made_.size()), lacks(made_.size());
  for (std::size_t c = 0; c * width() < made_.size(); ++c) {
    const std::size_t at = c * width();
    for (std::size_t i = 0; i < species_.size(); ++i) {
      const double rate = gained[at + i] * W[species_[i]] / time;
      const double Y = state.Y[c * static_cast<std::size_t>(state.species) + species_[i]];
      const bool isTaken = rate < 0.0 && Y > 0.0;
      made[at + i] = isTaken ? 0.0 : rate;
      taken[at + i] = isTaken ? -rate / Y : 0.0;
      lacks[at + i] = rate - (made_[at + i] - taken_[at + i] * Y);
    }
    made[at + species_.size()] = gained[at + species_.size()] / time;
  }
  way_ = nextWay(lacks);
  for (std::size_t i = 0; i < made_.size(); ++i) {
    made_[i] += way_ * (made[i] - made_[i]);
    taken_[i] += way_ * (taken[i] - taken_[i]);
  }
  lacked_ = std::move(lacks);
}

// Aitken's relaxation in the form of Irons and Tuck (1969).
double MeanExchange::nextWay(std::span<const double> lacks) const {
  if (!(way_ > 0.0)) return firstWay;
  std::array<double, 2> products{};
  for (std::size_t i = 0; i < lacks.size(); ++i) {
    const double change = context_.mesh.volume[i / width()] * (lacks[i] - lacked_[i]);
    products[0] += change * lacked_[i];
    products[1] += change * (lacks[i] - lacked_[i]);
  }
  MPI_Allreduce(MPI_IN_PLACE, products.data(), 2, MPI_DOUBLE, MPI_SUM, context_.mesh.comm);
  return products[1] > 0.0 ? std::clamp(-way_ * products[0] / products[1], leastWay, wholeWay) : wholeWay;
}

void MeanExchange::addTo(const State& state, State::Balance& balance) const {
  for (std::size_t c = 0; c * width() < made_.size(); ++c) {
    const std::size_t at = c * width();
    const double* Y = &state.Y[c * static_cast<std::size_t>(state.species)];
    for (std::size_t i = 0; i < species_.size(); ++i)
      balance.exchange(c, species_[i], made_[at + i] - taken_[at + i] * Y[species_[i]]);
    balance.enthalpy[c] += made_[at + species_.size()];
  }
}

void MeanExchange::addSlopes(const Operator::Slopes& slopes, int species) const {
  if (slopes.gas.empty()) return;
  const std::size_t rows = static_cast<std::size_t>(species) + 1;
  for (std::size_t c = 0; c * width() < made_.size(); ++c)
    for (std::size_t i = 0; i < species_.size(); ++i)
      slopes.gas[(c * rows + species_[i]) * rows + species_[i]] -= taken_[c * width() + i];
}

void MeanExchange::saveOrLoad(StateArchive& archive) {
  archive.cells("mean_exchange_made", made_, static_cast<int>(width()));
  archive.cells("mean_exchange_taken", taken_, static_cast<int>(width()));
  archive.cells("mean_exchange_lacked", lacked_, static_cast<int>(width()));
  archive.shared("mean_exchange_way", way_);
}

}  // namespace lampblack::coupling
