#include "coupling/split_gas.hpp"

namespace lampblack::coupling {

using Kept = SplitReactor::Gas::Kept;

SplitReactor::Gas splitGas(ClosedReactor& reactor, ReactorSystem::Held held) {
  SplitReactor::Gas gas;
  gas.system = &reactor;
  gas.density = [&reactor](double t, const double* y) { return reactor.density(t, y); };
  gas.pressure = [&reactor](double t, const double* y) { return reactor.pressure(t, y); };
  if (held == ReactorSystem::Held::Density) gas.kept = {Kept::internalEnergy};
  return gas;
}

SplitReactor::Gas splitGas(PlugFlow& flow, double pressure) {
  SplitReactor::Gas gas;
  gas.system = &flow;
  gas.density = [&flow](double, const double* y) { return flow.density(y); };
  gas.pressure = [pressure](double, const double*) { return pressure; };
  gas.timePerUnit = [&flow](const double* y) { return 1 / flow.velocity(y); };
  return gas;
}

SplitReactor::Gas splitGas(NetworkSystem& system) {
  SplitReactor::Gas gas;
  gas.system = &system;
  gas.density = [&system](double, const double* block) { return system.density(block); };
  gas.pressure = [&system](double, const double*) { return system.network().pressure; };
  gas.kept.clear();
  for (const StirredReactor& reactor : system.network().reactors)
    gas.kept.push_back(reactor.temperature ? Kept::temperature : Kept::enthalpy);
  return gas;
}

SplitReactor::Gas splitGas(GasAlong& along) {
  SplitReactor::Gas gas;
  gas.system = &along;
  gas.density = [&along](double t, const double* y) { return along.density(t, y); };
  gas.pressure = [&along](double t, const double*) { return along.pressure(t); };
  gas.kept = {Kept::temperature};
  gas.nextStop = [&along](double t) { return along.nextRow(t); };
  gas.held = along.held();
  return gas;
}

}  // namespace lampblack::coupling
