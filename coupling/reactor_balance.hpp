// What a reactor holds per kg of gas and particles: elements, enthalpy, internal energy. Those of a closed reactor, and
// of a plug flow along its way, do not change.
#pragma once

#include <span>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/reactor/network_solver.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/modules.hpp"
#include "coupling/reactor_particles.hpp"

namespace lampblack::coupling {

class ReactorBalance {
 public:
  // `unitElements`: kg of each element in a unit of each amount. Mechanism and phase have to live as long.
  ReactorBalance(const Mechanism& mechanism, CarriedPhase& phase, std::vector<std::vector<double>> unitElements);

  // kg/kg of each element; Y and amounts as the unknowns of the reactor.
  [[nodiscard]] std::vector<double> elements(std::span<const double> Y, std::span<const double> amounts) const;
  [[nodiscard]] double enthalpy(double T, std::span<const double> Y, std::span<const double> amounts);        // J/kg
  [[nodiscard]] double internalEnergy(double T, std::span<const double> Y, std::span<const double> amounts);  // J/kg

 private:
  [[nodiscard]] double carriedEnthalpy(double T, std::span<const double> amounts);

  const Mechanism& mechanism_;
  CarriedPhase& phase_;
  std::vector<std::vector<double>> unitElements_;
  Thermo thermo_;
  std::vector<double> h_, slope_;
};

// The largest difference of an element between the two, relative to what `first` has of it; of elements that are more
// than round-off in the whole, as a solver leaves a trace of those that are not there.
[[nodiscard]] double largestImbalance(std::span<const double> first, std::span<const double> second);

// What comes into a reactor of a steady network less what leaves it.
struct SteadyBalance {
  double elements = 0;  // the largest difference of an element, relative to what comes in
  double energy = 0;    // relative to M cp T; zero where the temperature is given
};

// In the order of the reactors.
[[nodiscard]] std::vector<SteadyBalance> steadyBalances(const Mechanism& mechanism, ReactorParticles& particles,
                                                        const ReactorNetwork& network,
                                                        const std::vector<ReactorSteadyState>& states);

}  // namespace lampblack::coupling
