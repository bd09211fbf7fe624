// The equations of the gas of a case whose particles are ensembles, for one repeat.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "app/problems/reactor/reactor_kind.hpp"
#include "core/modules.hpp"
#include "coupling/split_reactor.hpp"

namespace lampblack::app {

SplitReactor::Options splitOptions(const ReactorCase& reactorCase);

class EnsembleGas {
 public:
  // The case has to live as long. `population`: as ReactorKind::repeatGas.
  explicit EnsembleGas(const ReactorCase& reactorCase, SplitParticles* population = nullptr);
  EnsembleGas(const EnsembleGas&) = delete;
  EnsembleGas& operator=(const EnsembleGas&) = delete;

  [[nodiscard]] const SplitReactor::Gas& gas() const { return made_.gas; }
  [[nodiscard]] const std::vector<double>& start() const { return made_.start; }
  [[nodiscard]] ParticlesAtRest& particles() { return *particles_; }
  // s, where the unknowns are y at x
  [[nodiscard]] double time(double x, std::span<const double> y) const { return made_.time(x, y); }

 private:
  const ReactorCase& case_;
  std::unique_ptr<ParticlesAtRest> particles_;
  RepeatGas made_;
};

}  // namespace lampblack::app
