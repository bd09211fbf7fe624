// Ensembles of soot for the cells of a flow.
#pragma once

#include <cstdint>
#include <memory>

#include "coupling/cell_soot.hpp"
#include "coupling/ensemble_operator.hpp"
#include "tests/coupling/cell_vessel.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

using Exchange = EnsembleOperator::Exchange;

struct SootOptions : EnsembleOperator::Options {
  EnsembleOptions ensemble;
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
