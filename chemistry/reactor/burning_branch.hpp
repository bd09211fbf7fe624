// The burning steady states of stirred reactors where the transient from the equilibrium of what flows in goes out
// though they burn: near its end the burning branch draws in only what is near it. The branch is followed from larger
// reactors (longer residence times at the same mass flows) down to the given sizes. Method: docs/theory/reactors.md.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/reactor/reactor_network.hpp"
#include "chemistry/reactor/steady_state.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

// From a start (unknowns of NetworkSystem) to rest, by the longest residence time. NumericsError as findSteadyState.
SteadyState networkAtRest(NetworkSystem& system, const std::vector<double>& start);

// Reactors of one network without a carried phase; where the temperature is given there is nothing to burn or go out.
class BurningBranch {
 public:
  // The mechanism has to live as long.
  BurningBranch(const Mechanism& mechanism, ReactorNetwork network);

  // Whether a reactor is cold though what flows in could burn: short of half the way to its equilibrium; and how many
  // are. `y`: unknowns of NetworkSystem, each reactor's followed by `carried` amounts that do not matter.
  [[nodiscard]] bool isCold(const std::vector<double>& y, std::size_t reactor, std::size_t carried = 0) const;
  [[nodiscard]] std::size_t cold(const std::vector<double>& y, std::size_t carried = 0) const;

  struct Result {
    // The state at the given sizes, cold only where it has become so without a jump; empty: none.
    std::vector<double> y;
    // Where the branch ends above the given sizes: the residence times (s) of the last burning state.
    std::vector<double> lastResidenceTimes;
  };
  // From a state of larger reactors with at most `mostCold` cold ones, so many of which may go out on the way.
  [[nodiscard]] Result follow(std::size_t mostCold) const;

 private:
  struct State {
    double size = 1;  // of the given volumes and residence times
    std::vector<double> y;
  };
  [[nodiscard]] ReactorNetwork scaled(double size) const;
  [[nodiscard]] std::optional<std::vector<double>> atRest(double size, const std::vector<double>& start) const;
  [[nodiscard]] std::optional<State> inLargerReactors(std::size_t mostCold) const;
  [[nodiscard]] bool isJump(const std::vector<double>& from, const std::vector<double>& to) const;

  const Mechanism& mechanism_;
  ReactorNetwork network_;
  std::size_t blockSize_;
  double fresh_ = 0, burnt_ = 0;  // K, of what flows in and of its equilibrium
};

}  // namespace lampblack::chemistry
