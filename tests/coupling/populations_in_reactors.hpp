// Populations of each kind in a reactor, and what they are besides.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "coupling/reactor_population.hpp"
#include "particles/ensemble/soot_ensemble.hpp"
#include "particles/trees/tree_ensemble.hpp"
#include "particles/trees/tree_population.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

struct ReactorTrees : ReactorPopulation {
  ReactorTrees(const Mechanism& mechanism, const TreeOptions& options, GasViscosity viscosity,
               const std::vector<TreeStart>& start)
      : ReactorPopulation(std::make_unique<TreeEnsemble>(mechanism, options, start), viscosity) {}
  [[nodiscard]] TreePopulation& trees() const { return dynamic_cast<TreeEnsemble&>(population()).trees(); }
};

struct ReactorSoot : ReactorPopulation {
  ReactorSoot(const Mechanism& mechanism, const EnsembleOptions& options)
      : ReactorPopulation(std::make_unique<SootEnsemble>(mechanism, options)) {}
  [[nodiscard]] Ensemble& ensemble() const { return dynamic_cast<SootEnsemble&>(population()).ensemble(); }
};

}  // namespace lampblack::test
