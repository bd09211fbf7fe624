#include "chemistry/reactor/reactor_lanes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "chemistry/reactor/reactor_lanes_tables.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "numerics/rosenbrock_solver.hpp"

namespace lampblack::chemistry {

namespace {

constexpr std::size_t kLanes = batchLanes;

ReactorLanesTarget targetOf(BatchKinetics::Instructions instructions) {
  switch (instructions) {
#if defined(__x86_64__)
    case BatchKinetics::Instructions::Avx512:
      return reactorLanesAvx512();
    case BatchKinetics::Instructions::Avx2:
      return reactorLanesAvx2();
#else
    case BatchKinetics::Instructions::Avx512:
    case BatchKinetics::Instructions::Avx2:
#endif
    case BatchKinetics::Instructions::Generic:
      break;
  }
  return reactorLanesGeneric();
}

// One value of every row.
void put(std::span<const double> values, double* rows, std::size_t lane) {
  for (std::size_t i = 0; i < values.size(); ++i) rows[i * kLanes + lane] = values[i];
}

void take(const double* rows, std::size_t lane, std::span<double> values) {
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = rows[i * kLanes + lane];
}

}  // namespace

struct ReactorLanes::Impl {
  Impl(const Mechanism& mechanism, double leastFraction, BatchKinetics::Instructions instructions)
      : tables(mechanism, leastFraction), target(targetOf(instructions)) {}

  // A reactor on its way in a lane.
  struct LaneStep {
    Reactor* reactor = nullptr;
    double reached = 0, stepSize = 0;
    bool isRejected = false, isLast = false;
  };

  void load(const Reactor& reactor, std::size_t lane) const;
  bool prepareStep(LaneStep& laneStep, std::size_t lane, const Tolerance& tolerance) const;
  bool finishStep(LaneStep& laneStep, std::size_t lane) const;

  ReactorLanesTables tables;
  ReactorLanesTarget target;
  std::array<LaneStep, kLanes> laneSteps;
};

void ReactorLanes::Impl::load(const Reactor& reactor, std::size_t lane) const {
  const ReactorLanesWork& work = tables.work();
  work.pressure[lane] = reactor.pressure;
  work.heating[lane] = reactor.heating;
  work.rateFactor[lane] = reactor.rateFactor;
  put(reactor.state, work.y, lane);
  if (!reactor.source.empty()) return put(reactor.source, work.source, lane);
  for (std::size_t k = 0; k < tables.view().numSpecies; ++k) work.source[k * kLanes + lane] = 0;
}

// As RosenbrockSolver: false where no more steps may be taken.
bool ReactorLanes::Impl::prepareStep(LaneStep& laneStep, std::size_t lane, const Tolerance& tolerance) const {
  Reactor& reactor = *laneStep.reactor;
  const double dt = reactor.duration;
  reactor.nextStep = laneStep.stepSize;
  if (reactor.steps + reactor.rejected >= tolerance.maximumSteps ||
      laneStep.stepSize < RosenbrockSolver::smallestStep * dt) {
    reactor.outcome = Reactor::Outcome::TooManySteps;
    return false;
  }
  laneStep.isLast = laneStep.reached + laneStep.stepSize >= dt * (1 - RosenbrockSolver::roundOff);
  if (laneStep.isLast) laneStep.stepSize = dt - laneStep.reached;
  tables.work().stepSize[lane] = laneStep.stepSize;
  return true;
}

// False where the reactor leaves the lane.
bool ReactorLanes::Impl::finishStep(LaneStep& laneStep, std::size_t lane) const {
  const ReactorLanesWork& work = tables.work();
  Reactor& reactor = *laneStep.reactor;
  const double sum = work.errorSum[lane];
  if (work.isGood[lane] != 1 || !std::isfinite(sum)) {
    reactor.outcome = Reactor::Outcome::Left;
    return false;
  }
  const auto unknowns = static_cast<double>(reactor.state.size());
  const auto next = RosenbrockSolver::nextStep(laneStep.stepSize, std::sqrt(sum / unknowns), laneStep.isRejected);
  laneStep.isRejected = next.isRejected;
  reactor.nextStep = next.size;
  if (next.isRejected) {
    ++reactor.rejected;
  } else {
    ++reactor.steps;
    if (laneStep.isLast) {
      take(work.end, lane, reactor.state);
      reactor.outcome = Reactor::Outcome::Arrived;
      return false;
    }
    laneStep.reached += laneStep.stepSize;
    for (std::size_t i = lane; i < reactor.state.size() * kLanes; i += kLanes) work.y[i] = work.end[i];
  }
  laneStep.stepSize = next.size;
  return true;
}

bool ReactorLanes::covers(const Mechanism& mechanism) {
  return ReactorLanesTables::covers(mechanism);
}

ReactorLanes::ReactorLanes(const Mechanism& mechanism, double leastFraction, BatchKinetics::Instructions instructions) {
  BatchKinetics::demand(instructions);
  impl_ = std::make_unique<Impl>(mechanism, leastFraction, instructions);
}
ReactorLanes::~ReactorLanes() = default;
ReactorLanes::ReactorLanes(ReactorLanes&&) noexcept = default;
ReactorLanes& ReactorLanes::operator=(ReactorLanes&&) noexcept = default;

void ReactorLanes::largestChemicalRates(std::span<const Reactor> reactors, std::span<double> largest) {
  auto& self = *impl_;
  const ReactorLanesWork& work = self.tables.work();
  const std::size_t n = self.tables.view().numSpecies;
  for (std::size_t first = 0; first < reactors.size(); first += kLanes) {
    const std::size_t count = std::min(kLanes, reactors.size() - first);
    for (std::size_t lane = 0; lane < count; ++lane) self.load(reactors[first + lane], lane);
    self.target.chemicalRates(self.tables.view(), work);
    for (std::size_t lane = 0; lane < count; ++lane) {
      double most = 0;
      for (std::size_t k = 0; k < n; ++k) {
        const double size = std::abs(work.f[k * kLanes + lane]);
        most = size <= most ? most : size;  // not a number if one of them is none
      }
      largest[first + lane] = work.isGood[lane] == 1 ? most : std::numeric_limits<double>::quiet_NaN();
    }
  }
}

void ReactorLanes::advance(std::span<Reactor> reactors, const Tolerance& tolerance) {
  auto& self = *impl_;
  const double smallest = tolerance.absolute / tolerance.relative;
  std::size_t next = 0;
  const auto enter = [&](Impl::LaneStep& laneStep, std::size_t lane) {
    laneStep = {};
    if (next == reactors.size()) return;
    laneStep.reactor = &reactors[next++];
    Reactor& reactor = *laneStep.reactor;
    reactor.steps = reactor.rejected = 0;
    laneStep.stepSize = reactor.firstStep > 0 ? std::min(reactor.firstStep, reactor.duration) : reactor.duration;
    self.load(reactor, lane);
  };
  for (std::size_t lane = 0; lane < kLanes; ++lane) enter(self.laneSteps[lane], lane);
  for (;;) {
    bool anyone = false;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      auto& laneStep = self.laneSteps[lane];
      while (laneStep.reactor != nullptr && !self.prepareStep(laneStep, lane, tolerance)) enter(laneStep, lane);
      anyone = anyone || laneStep.reactor != nullptr;
    }
    if (!anyone) return;
    self.target.step(self.tables.view(), self.tables.work(), {tolerance.relative, smallest, 1.0});
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      auto& laneStep = self.laneSteps[lane];
      if (laneStep.reactor != nullptr && !self.finishStep(laneStep, lane)) enter(laneStep, lane);
    }
  }
}

}  // namespace lampblack::chemistry
