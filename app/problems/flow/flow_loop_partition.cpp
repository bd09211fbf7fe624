// How a flow's run partitions its mesh anew, by what its cells cost.
#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/problems/flow/flow_loop.hpp"
#include "app/problems/flow/flow_mesh.hpp"
#include "app/run/warnings.hpp"
#include "core/errors.hpp"
#include "io/block_exchange.hpp"
#include "io/redistribution.hpp"

namespace lampblack::app {

Mesh FlowLoop::partitionedBy(const std::vector<double>& weights) {
  const StateNumbers numbers = stateNumbers(domain_->mesh);
  return makeMesh(comm_, case_, BlockExchange(comm_, numbers.cells, numbers.totalCells).toBlock(weights, 1));
}

void FlowLoop::replaceMesh(Mesh mesh) {
  residual_.reset();
  iteration_.reset();
  domain_.reset();  // before there is another
  domain_ =
      std::make_unique<FlowDomain>(std::move(mesh), case_, thermo_, transport_, withFailedCellFiles(case_.chemistry));
  domain_->beginBudget(case_);
  operators_ = domain_->operators;
  operators_.insert(operators_.end(), added_.begin(), added_.end());
  tables_->moveTo(domain_->context);
  steadiness_.moveTo(domain_->context);
  gases_.moveTo(domain_->context);
  costs_ = CellCosts(domain_->mesh);
  backup_ = StateBackup(domain_->mesh.owned, domain_->mesh.faces);
}

void FlowLoop::repartitionIfUneven(Outputs& outputs) {
  if (!repartitions_ || !costs_.isDue()) return;
  const Timers::Scope scope(timers_, "partition");
  const double before = imbalanceOf(comm_, costs_.average());
  if (before <= *case_.repartition) return;
  const auto tell = [&](const std::string& text) {
    outputs.progress.finish();
    if (domain_->mesh.rank == 0) fmt::print("step {}: {}\n", steps_, text);
  };
  std::optional<Mesh> next;
  try {
    next = partitionedBy(costs_.weights());
  } catch (const InputError& error) {  // of all ranks: a mesh file that is not there any more
    repartitions_ = false;
    outputs.progress.finish();
    printWarnings(
        {fmt::format("the mesh stays as it is partitioned, though the busiest rank's cost is {:.2f} of the "
                     "mean: {}",
                     before, error.what())});
    return;
  }
  const StateNumbers from = stateNumbers(domain_->mesh), to = stateNumbers(*next);
  const Redistribution movement(comm_, from.cells, to.cells, to.totalCells);
  CellCost cost(next->owned);
  cost.own = movement(costs_.average().own, 1);
  cost.shared = movement(costs_.average().shared, 1);
  const double after = imbalanceOf(comm_, cost);
  // Pieces have at least a cell; one dear cell has nothing to be balanced with.
  const bool helps = after - 1.0 < 0.75 * (before - 1.0);
  costs_.recordRepartition(helps);
  if (!helps) return;
  moveTo(std::move(*next), costs_.weights());
  outputs.results.renumber(to.cells);
  tell(fmt::format("the mesh is partitioned anew: the busiest rank had {:.2f} of the mean cost and has {:.2f}", before,
                   after));
}

void FlowLoop::repartition(const std::vector<double>& weights) {
  moveTo(partitionedBy(weights), weights);
}

void FlowLoop::moveTo(Mesh mesh, const std::vector<double>& weights) {
  const auto owners = [this](StateArchive& archive) {
    saveOrLoadParts(archive);
    costs_.saveOrLoad(archive);
    steadiness_.saveOrLoad(archive);
    gases_.saveOrLoad(archive, "gases_");
  };
  StateBackup moving(domain_->mesh.owned, domain_->mesh.faces);
  moving.save(owners);
  std::vector<double> moved;
  {
    const StateNumbers from = stateNumbers(domain_->mesh), to = stateNumbers(mesh);
    const Redistribution ofCells(comm_, from.cells, to.cells, to.totalCells);
    const Redistribution ofFaces(comm_, from.faces, to.faces, to.totalFaces);
    moved = ofCells(weights, 1);
    moving.rearrange(mesh.owned, mesh.faces, ofCells, ofFaces, ofCells);
  }
  replaceMesh(std::move(mesh));
  moving.restore(owners);
  resumeFromLoadedState();
  costs_.adopt(domain_->mesh.ranks, std::move(moved));
}

}  // namespace lampblack::app
