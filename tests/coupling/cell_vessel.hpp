// A closed vessel of gas with ensembles in its cells, and transport.
#pragma once

#include <functional>
#include <initializer_list>
#include <memory>
#include <string>

#include "coupling/ensemble_operator.hpp"
#include "flow/stepping/budget.hpp"
#include "tests/coupling/closed_box.hpp"
#include "tests/every_module.hpp"
#include "tests/flow/flow_fixture.hpp"

namespace lampblack::test {

// A gas that soots.
inline Gas& ethylene() {
  static Gas gas("ethylene_bisetti2012_47.yaml");
  return gas;
}

struct CellVessel {
  CellVessel(Gas& gas, const std::function<Box::Local(const Vector3&)>& start, std::shared_ptr<CellParticles> kind,
             const EnsembleOperator::Options& o, MPI_Comm comm = MPI_COMM_WORLD,
             std::vector<ScalarBlock> carriedBefore = {})
      : box(closedBox(0.004, 6, 5), fourWalls(), {}, comm, gas),
        state(box.stateWith(withBlock(std::move(carriedBefore), *kind), start)),
        transport(box.context, state),
        particles(std::move(kind)),
        ensembles(box.context, transport, particles, o, at(state.block(particles->material()).first)) {
    transport.initialise(state, dt);
    begin();
  }
  static std::vector<ScalarBlock> withBlock(std::vector<ScalarBlock> blocks, const CellParticles& particles) {
    blocks.push_back({particles.material(), particles.scalars()});
    return blocks;
  }
  void begin() {
    for (Operator* op : std::initializer_list<Operator*>{&transport, &ensembles}) op->endStep(state);
    for (Operator* op : std::initializer_list<Operator*>{&transport, &ensembles}) op->endSweep(state);
  }
  void step(bool withGas = true) {
    if (withGas)
      transport.advance(state, time, dt);
    else
      state.keepStart();
    ensembles.advance(state, time, dt);
    begin();
    time += dt;
  }
  void saveOrLoad(StateArchive& archive) {
    state.saveOrLoad(archive);
    transport.saveOrLoad(archive);
    ensembles.saveOrLoad(archive);
  }
  static constexpr double dt = 2e-5;
  double time = 0.0;
  Box box;
  State state;
  TransportOperator transport;
  std::shared_ptr<CellParticles> particles;
  EnsembleOperator ensembles;

  // kg of gas and particles, per radian or metre depth: "mass", or an element.
  [[nodiscard]] double contentOf(const std::string& quantity) const {
    const Mechanism& mechanism = box.context.mechanism;
    const Budget budget(box.context, massAndElements(mechanism, particles->unitElements(mechanism)), state);
    for (const Budget::Line& line : budget.lines(state))
      if (line.name == quantity) return line.content;
    return 0.0;
  }
};

}  // namespace lampblack::test
