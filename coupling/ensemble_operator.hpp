// Stochastic ensembles of particles in the cells of a flow, one in each owned cell where there are particles or what
// they could come of: a process of the flow beside transport and chemistry. In each step the particles move between the
// cells for half of its time (EnsembleTransport), then each cell's population changes in the gas of the cell
// (CellParticles), on any rank (WorkSharing), then the particles move on: seen between the steps, where one process
// follows the other, a steady state errs by the square of the step. What a population takes from the gas and gives to
// it is booked to the cell, species, mass and enthalpy.
//
// The populations are kept packed, those of soot 32 bytes a particle, and are unpacked one after the other into one a
// rank. Those that arrive in the second half of a step stand behind the others until the next step merges them.
//
// Coupling. Without `average` the exchange of a step is booked at its end, at once. With it the exchange goes into a
// reserve of the cell, and the gas's transport and chemistry have what is in the reserve over the time `average` as a
// constant source: the noise of few particles reaches the gas smoothed, a steady state does not depend on the step, and
// atoms and enthalpy are those of gas, particles and reserve together, to round-off. docs/theory/ensembles_in_cells.md.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/modules.hpp"
#include "coupling/cell_particles.hpp"
#include "coupling/ensemble_sizes.hpp"
#include "coupling/ensemble_statistics.hpp"
#include "coupling/ensemble_transport.hpp"
#include "coupling/mean_exchange.hpp"
#include "flow/models/gas_exchange.hpp"
#include "flow/models/shared_cell_work.hpp"
#include "flow/operator.hpp"
#include "flow/stepping/transport_operator.hpp"

namespace lampblack::coupling {

class EnsembleOperator : public Operator {
 public:
  enum class Exchange {
    TwoWay,  // the gas loses what the particles take
    OneWay   // the gas does not know of the particles
  };
  struct Options {
    Exchange exchange = Exchange::TwoWay;
    double average = 0.0;  // s
    // s. From this time on the gas is frozen: the caller advances no other operator, and the exchange stays in the
    // reserve.
    std::optional<double> frozenFrom = {};
    bool diffusion = true;
    bool secondOrder = true;
    bool shareWork = true;
    // Most numerical particles of a cell, where there is most soot and where there is next to none: in between the
    // first times the root of the cell's share of the largest number or volume per volume of any cell, the larger of
    // the two. Zero: as many everywhere as the population has.
    std::size_t particles = 0, particlesAtEdges = 0;
    int sweeps = 1;          // of a step
    std::uint64_t seed = 1;  // of transport
    SizeBins bins;           // of size distributions
    bool sizes = true;       // whether they are fields
    std::optional<EnsembleStatistics::Options> statistics;
    // Whether gas and particles change in turn (beginGas(), beginParticles()), the gas first; the averages then start
    // by themselves in each turn of the particles.
    bool inTurn = false;
  };
  // kg of each element of the mechanism in a unit of each amount.
  [[nodiscard]] static std::vector<std::vector<double>> unitElements(const Mechanism& mechanism,
                                                                     const CellParticles& particles, Exchange exchange);
  // Absorption coefficient (1/m) of particles of these amounts.
  [[nodiscard]] static double absorption(const CellParticles& particles, Exchange exchange, double temperature,
                                         std::span<const double> amounts);

  // `flow` moves the gas, before this operator in every sweep. The amounts of the particles (AmountPlaces) stand in
  // State::carried from `first` on.
  EnsembleOperator(const FlowContext& context, const TransportOperator& flow, std::shared_ptr<CellParticles> particles,
                   Options options, std::size_t first = 0);

  [[nodiscard]] const char* name() const override { return "ensembles"; }
  void advance(State& state, double time, double dt) override;
  void endSweep(State& state) override;
  void endStep(State& state) override;
  void saveOrLoad(StateArchive& archive) override;

  [[nodiscard]] std::vector<Quantity> historyColumns() const override;
  [[nodiscard]] std::vector<double> historyValues(const State& state) override;
  [[nodiscard]] std::string status() const override;
  [[nodiscard]] std::vector<std::string> closingLines() const override;
  [[nodiscard]] std::optional<Imbalance> imbalance() const override { return work_.imbalance(); }
  void beginRun() override { work_.beginRun(); }
  void fields(const State& state, const FieldSink& sink) const override;
  // Edges of the bins of sizes.
  [[nodiscard]] std::vector<Dataset> datasets() const override;
  // Sizes, and of aggregates their primaries.
  [[nodiscard]] std::vector<RegionTable> regionTables() const override;
  [[nodiscard]] std::vector<double> regionRows(std::size_t table, const MeshRegion& region) const override;
  // In a frozen gas.
  [[nodiscard]] bool holdsOthers(double time) const override {
    return turn_ == Turn::Particles || (options_.frozenFrom && time >= *options_.frozenFrom);
  }
  // What the particles take in the mean, while it is the gas's turn.
  void addRates(const State& state, State::Balance& rates) override;
  void addSlopes(const State& state, const Slopes& slopes) override;
  [[nodiscard]] bool isStochastic() const override { return true; }
  void addCost(const Mesh&, CellCost& cost) const override { work_.addCost(cost); }

  // Is called at the end of each step: each amount that came with numerical particles that come and go, and that left
  // through the boundary in it, of this rank's cells, per metre depth or radian.
  using Watcher = std::function<void(std::span<const double> resampled, std::span<const double> gone)>;
  void watchAmounts(Watcher watcher) { watchers_.push_back(std::move(watcher)); }
  // Is called at the end of each step of dt (s): kg that left through each boundary face in it, per metre depth or
  // radian.
  using FaceWatcher = std::function<void(double dt, std::span<const double> gone)>;
  void watchFaces(FaceWatcher watcher) { faceWatchers_.push_back(std::move(watcher)); }
  [[nodiscard]] const CellParticles& particles() const { return *particles_; }
  // Averages over time; null without.
  [[nodiscard]] const EnsembleStatistics* statistics() const { return statistics_ ? &*statistics_ : nullptr; }
  // Gas and particles in turn. In the gas's turn the particles rest, and the gas has what they took in the mean of
  // their last turn (nothing before the first); in theirs the gas rests, and what they take of it is averaged from when
  // they are stationary on, or from a time (s) on. Between them what the state has of the particles are their mean
  // amounts. `block` (s): of the averages.
  void beginParticles(State& state, double block, std::optional<double> averagedFrom = {});
  void beginGas(State& state);
  // Blocks that the averages of the particles' turn have so far.
  [[nodiscard]] std::size_t averagedBlocks() const { return statistics_->blocks(); }
  // Packed, of the owned cells, with what has arrived since; empty where there is none.
  [[nodiscard]] const std::vector<std::vector<double>>& populations() const { return populations_; }
  // Replaces the population of an owned cell by a packed one.
  void initialise(State& state, int cell, std::vector<double> population);

 private:
  // A reserve: mol/m3 of each exchanged species, then J/m3.
  [[nodiscard]] std::size_t reserveWidth() const { return particles_->species().size() + 1; }
  [[nodiscard]] ParticleGas gasOf(const State& state, int cell, std::vector<double>& concentrations) const;
  // How a cell travels to whoever advances its particles: behind it the concentrations, the population, and what has
  // arrived.
  struct Packed {
    CarrierGas gas;
    double arrived;  // how many values
    double room;     // for numerical particles; zero: as it is
  };
  // And how it comes back: behind it what CellParticles::Change has, and the population.
  struct Result {
    double cost;
  };
  // Collective. Of the cells, by what they have.
  void findRooms(const State& state);
  Packed pack(const State& state, int cell, RowWriter rows);
  Result solve(double dt, const SharedCellWork::Task<Packed>& task, RowWriter rows);
  void take(State& state, int cell, bool isHeld, std::span<const double> rows);
  // The first of a cell's amounts.
  [[nodiscard]] std::size_t amountsAt(const State& state, int cell) const {
    return static_cast<std::size_t>(cell) * state.scalars.size() + first_;
  }
  void setAmounts(State& state, int cell) const;
  // The packed population of a cell, to put particles behind it.
  std::vector<double>& openPopulation(int cell);
  void move(const State& state, double dt, EnsembleTransport::Half half);
  // Moves the particles that arrived in the previous step out of the populations.
  void separateArrivals();
  // Puts the particles that arrived behind the populations. Collective.
  void storeArrivals(State& state);
  void setOwed(State& state, int cell) const;
  void countOutflow();
  void addToStatistics(const State& state);
  void addToMeans(const State& state);
  void beginAverages(double block, std::optional<double> from);
  void saveOrLoadTurn(StateArchive& archive);

  const FlowContext& context_;
  const TransportOperator& flow_;
  Options options_;
  std::shared_ptr<CellParticles> particles_;
  AmountPlaces amounts_;
  std::size_t first_;
  EnsembleTransport transport_;
  GasExchange exchange_;
  SharedCellWork work_;
  std::vector<std::vector<double>> populations_, arrived_;
  std::vector<double> rooms_;    // for numerical particles, of each cell; empty: as the population has it
  std::vector<double> waiting_;  // how many of the last values of a population have arrived since it was advanced
  std::vector<double> reserve_;  // of the owned cells
  std::vector<double> rate_;     // what the balance has of it, per s
  // What several sweeps of a step begin with.
  std::vector<std::vector<double>> startPopulations_;
  std::vector<double> startWaiting_, startReserve_;
  std::vector<double> startResampled_;
  bool inStep_ = false;
  bool hasMoved_ = false;            // in the present turn
  double lastStep_ = 0.0;            // s
  double stepEnd_ = 0.0;             // s
  std::int64_t steps_ = 0;           // since the start
  std::vector<double> outflow_;      // of the step, each amount, per metre depth or radian
  std::vector<double> goneThrough_;  // kg of the step, boundary faces
  std::vector<Watcher> watchers_;
  std::vector<FaceWatcher> faceWatchers_;
  // Of each element, by numerical particles that come and go: kg per metre depth or radian, since the start and before
  // this step.
  std::vector<double> resampled_, resampledBefore_;
  std::vector<double> concentrations_;
  std::optional<EnsembleStatistics> statistics_;
  enum class Turn { Both, Gas, Particles };
  Turn turn_;
  std::optional<MeanExchange> meanExchange_;  // where they change in turn, with exchange both ways
  // Of the present turn of the particles, since the averages have started: s; the integrals over time of the amounts of
  // the owned cells; the reserve that they started with, empty before.
  double averagedTime_ = 0.0;
  std::vector<double> amountSums_, reserveBefore_;
  // Of the last row.
  double peak_ = 0.0;
  Vector3 place_{};
};

}  // namespace lampblack::coupling
