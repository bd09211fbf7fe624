#include "chemistry/reactor/burning_branch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "chemistry/reactor/network_solver.hpp"
#include "core/errors.hpp"

namespace lampblack::chemistry {
namespace {

// A reactor certainly burns where it is warmer than this share of the way to the equilibrium.
constexpr double kProgress = 0.5;
constexpr double kLeastRise = 1;  // K, by burning: with less there is nothing to go out
// The way to larger reactors in which the transient from the equilibrium burns.
constexpr double kCoarseStep = 4;
constexpr int kMostCoarseSteps = 10;
// Steps back along the branch: ratios of sizes.
constexpr double kFirstStep = 2, kLastStep = 1.005;
// A step that cools a reactor by more of the rise by burning has left the branch, however short it is: at the end of a
// branch the temperature falls as a square root, and where what flows in ignites by itself it falls smoothly.
constexpr double kJump = 0.1;

}  // namespace

SteadyState networkAtRest(NetworkSystem& system, const std::vector<double>& start) {
  double slowest = 0;
  for (std::size_t r = 0; r < system.network().reactors.size(); ++r)
    slowest = std::max(slowest, system.residenceTime(start.data(), r));
  return findSteadyState(system, start, slowest);
}

BurningBranch::BurningBranch(const Mechanism& mechanism, ReactorNetwork network)
    : mechanism_(mechanism), network_(std::move(network)), blockSize_(mechanism.numSpecies() + 1) {
  for (InflowStream& stream : network_.inflows) stream.carried.clear();
  fresh_ = startOf(mechanism_, network_, {.burnt = false}).temperature;
  burnt_ = startOf(mechanism_, network_, {.burnt = true}).temperature;
}

bool BurningBranch::isCold(const std::vector<double>& y, std::size_t reactor, std::size_t carried) const {
  if (network_.reactors[reactor].temperature || burnt_ < fresh_ + kLeastRise) return false;
  return y[reactor * (blockSize_ + carried) + blockSize_ - 1] < fresh_ + kProgress * (burnt_ - fresh_);
}

std::size_t BurningBranch::cold(const std::vector<double>& y, std::size_t carried) const {
  std::size_t count = 0;
  for (std::size_t r = 0; r < network_.reactors.size(); ++r) count += isCold(y, r, carried) ? 1 : 0;
  return count;
}

ReactorNetwork BurningBranch::scaled(double size) const {
  ReactorNetwork network = network_;
  for (StirredReactor& reactor : network.reactors) {
    if (reactor.volume) *reactor.volume *= size;
    if (reactor.residenceTime) *reactor.residenceTime *= size;
  }
  return network;
}

std::optional<std::vector<double>> BurningBranch::atRest(double size, const std::vector<double>& start) const {
  NetworkSystem system(mechanism_, scaled(size));
  try {
    return networkAtRest(system, start).y;
  } catch (const NumericsError&) {
    return std::nullopt;  // near its end a reactor may not come to rest: as good as out
  }
}

bool BurningBranch::isJump(const std::vector<double>& from, const std::vector<double>& to) const {
  for (std::size_t r = 0; r < network_.reactors.size(); ++r) {
    const std::size_t T = (r + 1) * blockSize_ - 1;
    if (from[T] - to[T] > kJump * (burnt_ - fresh_)) return true;
  }
  return false;
}

std::optional<BurningBranch::State> BurningBranch::inLargerReactors(std::size_t mostCold) const {
  const std::vector<double> equilibrium = startUnknowns(mechanism_, network_, {.burnt = true});
  double size = 1;
  for (int i = 0; i < kMostCoarseSteps; ++i) {
    size *= kCoarseStep;
    if (auto y = atRest(size, equilibrium); y && cold(*y) <= mostCold) return State{size, std::move(*y)};
  }
  return std::nullopt;
}

BurningBranch::Result BurningBranch::follow(std::size_t mostCold) const {
  std::optional<State> last = inLargerReactors(mostCold);
  if (!last) return {};
  double step = kFirstStep;
  while (last->size > 1 && step > kLastStep) {
    const double size = std::max(1.0, last->size / step);
    auto y = atRest(size, last->y);
    if (y && (!isJump(last->y, *y) || (mostCold > 0 && cold(*y) <= mostCold)))
      last = State{size, std::move(*y)};
    else
      step = std::sqrt(step);
  }
  Result result;
  if (last->size == 1) {
    result.y = std::move(last->y);
    return result;
  }
  const NetworkSystem system(mechanism_, scaled(last->size));
  for (std::size_t r = 0; r < network_.reactors.size(); ++r)
    result.lastResidenceTimes.push_back(system.residenceTime(last->y.data(), r));
  return result;
}

}  // namespace lampblack::chemistry
