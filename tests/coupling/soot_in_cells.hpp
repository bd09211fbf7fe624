// Ensembles of soot for the cells of a flow.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "coupling/ensemble_operator.hpp"
#include "particles/ensemble/soot_ensemble.hpp"
#include "tests/coupling/cell_vessel.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

using Exchange = EnsembleOperator::Exchange;

struct SootOptions : EnsembleOperator::Options {
  EnsembleOptions ensemble;
};
struct CellSoot : CellParticles {
  // Of State::carried, as AmountPlaces has them.
  enum Amount : std::size_t { number, carbon, hydrogen, primaries, surface, diameters, owedC, owedH, owedO };
  CellSoot(const Mechanism& mechanism, const EnsembleOptions& options)
      : CellParticles(mechanism, std::make_shared<SootEnsemble>(mechanism, options)) {}
  [[nodiscard]] std::vector<double> packed(std::span<const GivenParticle> particles, std::uint64_t cell) const {
    EnsembleOptions own = dynamic_cast<const SootEnsemble&>(population()).ensemble().options();
    own.owner = cell;
    const auto ensemble = makeEnsemble(own);
    ensemble->initialise(particles);
    return ensemble->pack();
  }
};
inline std::shared_ptr<CellSoot> sootOf(const SootOptions& o) {
  return std::make_shared<CellSoot>(ethylene().mechanism, o.ensemble);
}

inline std::uint64_t numberOf(const Mesh& mesh, int cell) {
  return static_cast<std::uint64_t>(mesh.naturalCell[at(cell)]);
}

inline SootOptions sootOptions(EnsembleOperator::Exchange exchange, double average = 0.0) {
  SootOptions o;
  o.ensemble.method = EnsembleMethod::sammc;
  o.ensemble.particles = 60;
  o.ensemble.seed = o.seed = 5;
  o.ensemble.splitTolerance = 0.2;
  o.ensemble.leastNumberDensity = 1e12;
  o.ensemble.soot.pah = {{"A2", 10, 8, 2e-3}};
  o.ensemble.soot.carbonWeight = ethylene().mechanism.atomicWeight(ethylene().mechanism.elementIndex("C"));
  o.ensemble.soot.hydrogenWeight = ethylene().mechanism.atomicWeight(ethylene().mechanism.elementIndex("H"));
  o.exchange = exchange;
  o.average = average;
  return o;
}

}  // namespace lampblack::test
