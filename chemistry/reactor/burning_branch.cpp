#include "chemistry/reactor/burning_branch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "chemistry/reactor/network_solver.hpp"
#include "core/errors.hpp"

namespace lampblack::chemistry {
namespace {

// A reactor burns where it is warmer than this share of the way to the equilibrium. Burning branches end at 0.7 to 0.8.
constexpr double kProgress = 0.5;
constexpr double kLeastRise = 1;  // K, by burning: with less there is nothing to go out
// The way to larger reactors in which the transient from the equilibrium burns.
constexpr double kCoarseStep = 4;
constexpr int kMostCoarseSteps = 10;
// Steps back along the branch: ratios of sizes.
constexpr double kFirstStep = 2, kLastStep = 1.005;
// A drop in the last step of less than this share of the rise by burning is no end of a branch: where what flows in
// ignites by itself the temperature falls smoothly with the size.
constexpr double kSmooth = 0.1;

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

// Sum of the temperatures that are not given, K.
double BurningBranch::warmth(const std::vector<double>& y) const {
  double sum = 0;
  for (std::size_t r = 0; r < network_.reactors.size(); ++r)
    if (!network_.reactors[r].temperature) sum += y[(r + 1) * blockSize_ - 1];
  return sum;
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
  std::optional<std::vector<double>> beyond;  // the end of the last step that went out
  while (last->size > 1 && step > kLastStep) {
    const double size = std::max(1.0, last->size / step);
    auto y = atRest(size, last->y);
    if (y && cold(*y) <= mostCold) {
      last = State{size, std::move(*y)};
    } else {
      beyond = std::move(y);
      step = std::sqrt(step);
    }
  }
  Result result;
  if (last->size == 1) {
    result.y = std::move(last->y);
    return result;
  }
  result.smooth = beyond && warmth(last->y) - warmth(*beyond) < kSmooth * (burnt_ - fresh_);
  if (result.smooth) return result;
  const NetworkSystem system(mechanism_, scaled(last->size));
  for (std::size_t r = 0; r < network_.reactors.size(); ++r)
    result.lastResidenceTimes.push_back(system.residenceTime(last->y.data(), r));
  return result;
}

}  // namespace lampblack::chemistry
