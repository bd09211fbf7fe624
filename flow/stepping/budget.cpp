#include "flow/stepping/budget.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lampblack::flow {

std::vector<ConservedQuantity> massAndElements(const Mechanism& mechanism,
                                               const std::vector<std::vector<double>>& carriedMass) {
  ConservedQuantity mass{"mass", std::vector<double>(mechanism.numSpecies(), 1.0), {}};
  for (const auto& perElement : carriedMass) {
    double sum = 0.0;
    for (double m : perElement) sum += m;
    mass.perCarried.push_back(sum);
  }
  std::vector<ConservedQuantity> quantities{mass};
  for (std::size_t e = 0; e < mechanism.numElements(); ++e) {
    ConservedQuantity element{mechanism.elementName(e), {}, {}};
    for (std::size_t k = 0; k < mechanism.numSpecies(); ++k)
      element.perSpecies.push_back(mechanism.atoms(k, e) * mechanism.atomicWeight(e) / mechanism.molecularWeights()[k]);
    for (const auto& perElement : carriedMass) element.perCarried.push_back(perElement[e]);
    quantities.push_back(std::move(element));
  }
  return quantities;
}

Budget::Budget(const FlowContext& context, std::vector<ConservedQuantity> quantities, const State& start)
    : context_(context), quantities_(std::move(quantities)) {
  begin(start);
}

void Budget::begin(const State& start) {
  start_ = contents(start);
  inflow_.assign(quantities_.size(), 0.0);
  outflow_.assign(quantities_.size(), 0.0);
}

std::vector<double> Budget::contents(const State& state) const {
  const Mesh& m = context_.mesh;
  const int n = state.species;
  const int scalars = state.carriedCount();
  std::vector<double> species(n, 0.0);
  std::vector<double> carried(scalars, 0.0);
  for (int c = 0; c < m.owned; ++c) {
    for (int k = 0; k < n; ++k)
      species[k] += m.volume[c] * state.density[c] * state.Y[static_cast<std::size_t>(c) * n + k];
    for (int s = 0; s < scalars; ++s) carried[s] += m.volume[c] * state.carried[c * scalars + s];
  }
  std::vector<double> contents;
  for (const ConservedQuantity& q : quantities_) {
    double sum = 0.0;
    for (int k = 0; k < n; ++k) sum += q.perSpecies[k] * species[k];
    for (int s = 0; s < scalars; ++s) sum += q.perCarried[s] * carried[s];
    contents.push_back(sum);
  }
  MPI_Allreduce(MPI_IN_PLACE, contents.data(), static_cast<int>(contents.size()), MPI_DOUBLE, MPI_SUM, m.comm);
  return contents;
}

void Budget::saveOrLoad(StateArchive& archive) {
  archive.shared("budget_start", start_);
  archive.sums("budget_inflow", inflow_);
  archive.sums("budget_outflow", outflow_);
}

void Budget::addStep(const TransportOperator::BoundaryAmounts& amounts) {
  for (std::size_t i = 0; i < quantities_.size(); ++i) {
    const ConservedQuantity& q = quantities_[i];
    for (std::size_t k = 0; k < amounts.speciesIn.size(); ++k) {
      inflow_[i] += q.perSpecies[k] * amounts.speciesIn[k];
      outflow_[i] += q.perSpecies[k] * amounts.speciesOut[k];
    }
    for (std::size_t s = 0; s < amounts.carriedIn.size(); ++s) {
      inflow_[i] += q.perCarried[s] * amounts.carriedIn[s];
      outflow_[i] += q.perCarried[s] * amounts.carriedOut[s];
    }
  }
}

std::vector<Budget::Line> Budget::lines(const State& state) const {
  std::vector<double> inflow = inflow_;
  std::vector<double> outflow = outflow_;
  const int count = static_cast<int>(quantities_.size());
  MPI_Allreduce(MPI_IN_PLACE, inflow.data(), count, MPI_DOUBLE, MPI_SUM, context_.mesh.comm);
  MPI_Allreduce(MPI_IN_PLACE, outflow.data(), count, MPI_DOUBLE, MPI_SUM, context_.mesh.comm);
  const std::vector<double> now = contents(state);
  std::vector<Line> lines;
  for (std::size_t i = 0; i < quantities_.size(); ++i) {
    Line line{quantities_[i].name, now[i], inflow[i], outflow[i], 0.0};
    const double scale = std::max(inflow[i], start_[i]);
    if (scale > 0.0) line.error = std::abs(now[i] - start_[i] - inflow[i] + outflow[i]) / scale;
    lines.push_back(line);
  }
  return lines;
}

StateExtremes extremesOf(const FlowContext& context, const State& state) {
  double worst[3] = {0.0, 0.0, 0.0};  // all as maxima
  const auto n = static_cast<std::size_t>(state.species);
  for (int c = 0; c < context.mesh.owned; ++c) {
    worst[0] = std::max(worst[0], state.temperature[c]);
    double sum = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
      const double y = state.Y[c * n + k];
      sum += y;
      worst[1] = std::max(worst[1], -y);
    }
    worst[2] = std::max(worst[2], std::abs(sum - 1.0));
  }
  MPI_Allreduce(MPI_IN_PLACE, worst, 3, MPI_DOUBLE, MPI_MAX, context.mesh.comm);
  return {worst[0], -worst[1], worst[2]};
}

}  // namespace lampblack::flow
