#include "flow/flame/burning_rate.hpp"

#include <cmath>
#include <optional>
#include <vector>

#include "chemistry/reactor/network_solver.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"

namespace lampblack::flow {
namespace {

// A reactor burns where it is warmer than this share of the way to the equilibrium. It goes out by itself at 0.7 to
// 0.8; where the stream ignites by itself it never does, and this is the end.
constexpr double leastProgress = 0.5;
constexpr double coarseStep = 4;  // of residence times, down to where the reactor is out; then halved twice
constexpr int mostSteps = 12;

// Of methane at 0.05 to 40 atm in air and oxygen, within a factor of 1.8.
constexpr double fasterThanReactor = 1.5;

// 0.4 m/s as of stoichiometric methane and air at 300 K and 1 atm, with an activation temperature of 15000 K in the
// burnt gas and the usual powers of temperature and pressure.
double usualSpeed(double unburnt, double burnt, double pressure) {
  return 0.4 * std::exp(-7500.0 * (1 / burnt - 1 / 2230.0)) * std::pow(unburnt / 300, 1.6) *
         std::pow(pressure / constants::oneAtmosphere, -0.3);
}

class BlowOut {
 public:
  BlowOut(const Mechanism& mechanism, const FlameStream& stream, double pressure, double burnt)
      : mechanism_(mechanism), least_(stream.temperature + leastProgress * (burnt - stream.temperature)) {
    network_.pressure = pressure;
    network_.reactors.resize(1);
    network_.inflows.push_back({0, 1.0, stream.temperature, stream.Y});
    const NetworkStart fromEquilibrium;
    start_.given = startOf(mechanism, network_, fromEquilibrium);
  }

  // The state at the shortest residence time at which the reactor burns.
  std::optional<ReactorSteadyState> find(double firstTime) {
    std::optional<ReactorSteadyState> last = burning(firstTime);
    double step = last ? 1 / coarseStep : coarseStep;
    double time = firstTime;
    if (!last) {
      for (int i = 0; i < mostSteps && !last; ++i) last = burning(time *= step);
    } else {
      for (int i = 0; i < mostSteps; ++i) {
        const auto next = burning(time * step);
        if (!next) break;
        last = next;
        time *= step;
      }
    }
    for (int halvings = 0; last && halvings < 2; ++halvings) {
      step = std::sqrt(std::min(step, 1 / step));
      if (const auto next = burning(time * step)) {
        last = next;
        time *= step;
      }
    }
    return last;
  }

 private:
  std::optional<ReactorSteadyState> burning(double residenceTime) {
    network_.reactors[0].residenceTime = residenceTime;
    try {
      ReactorSteadyState state = solveNetwork(mechanism_, network_, start_)[0];
      if (state.state.temperature > least_) return state;
    } catch (const NumericsError&) {
      // Near its end a reactor does not come to rest: as good as out.
    }
    return std::nullopt;
  }

  const Mechanism& mechanism_;
  double least_;
  ReactorNetwork network_;
  NetworkStart start_;
};

}  // namespace

double conductivityOverCp(double T) {
  return 2.58e-5 * std::pow(T / 298.0, 0.7);
}

double burningRate(const Mechanism& mechanism, const FlameStream& stream, double pressure, double burnt) {
  const Thermo thermo(mechanism);
  const double density = thermo.density(stream.temperature, pressure, stream.Y);
  const double usual = density * usualSpeed(stream.temperature, burnt, pressure);
  const double warm = 0.5 * (stream.temperature + burnt);
  const double time = density * stream.temperature / warm * conductivityOverCp(warm) / (usual * usual);
  const auto reactor = BlowOut(mechanism, stream, pressure, burnt).find(time);
  if (!reactor) return usual;
  return fasterThanReactor *
         std::sqrt(reactor->density * conductivityOverCp(reactor->state.temperature) / reactor->residenceTime);
}

}  // namespace lampblack::flow
