// The gas of a cylinder from one time to another: mixing, loss of heat, injection, reactions and the piston's
// compression one after the other, of second order in the step (docs/theory/engine.md).
#pragma once

#include <mpi.h>

#include <cstdint>
#include <functional>
#include <optional>

#include "chemistry/reactor/engine/engine_carried.hpp"
#include "chemistry/reactor/engine/engine_gas.hpp"
#include "chemistry/reactor/engine/engine_heat.hpp"
#include "chemistry/reactor/engine/engine_indicators.hpp"
#include "chemistry/reactor/engine/engine_injection.hpp"
#include "chemistry/reactor/engine/engine_mixing.hpp"
#include "chemistry/reactor/engine/engine_reactions.hpp"
#include "chemistry/reactor/engine/engine_table.hpp"
#include "core/modules.hpp"
#include "core/state_archive.hpp"

namespace lampblack::chemistry {

struct EngineOptions {
  std::function<double(double time)> volume;  // m3

  EngineMixingModel mixing = EngineMixingModel::none;
  double mixingConstant = 2;
  EngineTable mixingTime;  // s

  EngineHeatLaw heat;
  double jumpConstant = 0;                 // of EngineHeatLoss
  double wallTemperature = 400;            // K
  double bore = 0;                         // m
  double pistonSpeed = 0;                  // m/s, mean
  double displacement = 0, clearance = 0;  // m3
  double endArea = 0;                      // m2, of head and piston
  double motoredExponent = 1.35;           // of the pressure without combustion

  std::optional<EngineInjection::Options> injection;
  EngineTable injectionRate;  // kg/s

  bool reacts = true;
  ConstantPressureReactor::Options reactions;

  double step = 0;                  // s
  double pressureTolerance = 0.1;   // a step that changes the pressure by a larger part is halved
  double temperatureTolerance = 0;  // K, of a particle by reactions; 0: none
  int mostHalvings = 6;
  std::uint64_t seed = 1, repeat = 0;
};

// What has been done since the start.
struct EngineLedger {
  double work = 0;                                // J, on the piston
  double heat = 0;                                // J, to the walls
  double chemical = 0;                            // J, set free
  double injectedMass = 0, injectedEnthalpy = 0;  // kg, J
  double carriedEnthalpy = 0;                     // J, that the gas has given to what it carries
  double chemistrySteps = 0;
  double largestDefect = 0;  // of the volume, by which reactions grew otherwise than foreseen: the error of a step
  std::int64_t steps = 0, rejected = 0;
  std::int64_t tooLarge = 0;  // steps that were taken as they could not be halved further
};

class EngineCylinder {
 public:
  // `mechanism` and `thermo` have to live as long.
  EngineCylinder(MPI_Comm comm, const Mechanism& mechanism, const Thermo& thermo, EngineOptions options);

  // From the next start() on the gas carries this, none at the start; it has to live as long.
  void carry(EngineCarried& carried) { carried_ = &carried; }
  // The gas has the volume of that time, to round-off, afterwards. Random numbers begin anew: cycles differ by their
  // gas alone, so that they may come to an end.
  void start(EngineGas gas, double time);
  // Collective. NumericsError.
  void advanceTo(double time);

  [[nodiscard]] const EngineGas& gas() const { return gas_; }
  [[nodiscard]] const EngineLedger& ledger() const { return ledger_; }
  [[nodiscard]] const EnginePeaks& peaks() const { return peaks_; }  // of all steps, the rise over the longest one
  [[nodiscard]] double time() const { return time_; }
  // W/K, coefficient times area, with the gas's temperature as it is halfway through a loss of this duration (s).
  [[nodiscard]] double conductance(double time, double duration) const;
  // What the balances lack: of the energy, over the heat capacity times temperature; of the element that lacks most,
  // over what there is of it.
  [[nodiscard]] double energyError() const;
  [[nodiscard]] double elementError() const;

  // All that the next step depends on, and the balances. Between two calls of advanceTo(); collective.
  void saveOrLoad(StateArchive& archive);

 private:
  struct State {
    EngineGas gas;
    EngineLedger ledger;
    double growthRate = 0;
  };
  void step(double size, RandomStream& random);
  void react(double size);
  double others(double from, double size, bool isFirst, RandomStream& random);
  void compressTo(double volume) { ledger_.work += compression_.moveTo(volume, gas_); }
  [[nodiscard]] bool isTooLarge(double pressureBefore) const;
  [[nodiscard]] std::vector<double> allElements() const;  // mol of atoms, of the gas and what it carries
  void notePeak();

  const Mechanism& mechanism_;
  const Thermo& thermo_;
  EngineOptions options_;
  EngineCompression compression_;
  EngineMixing mixing_;
  EngineHeatLoss loss_;
  std::optional<EngineInjection> injection_;
  EngineCarried* carried_ = nullptr;
  EngineReactions reactions_;
  EngineGas gas_;
  EngineLedger ledger_;
  EnginePeaks peaks_;
  double time_ = 0, growthRate_ = 0, size_ = 0, defect_ = 0;
  double hotter_ = 0;  // K, the largest change of a temperature by reactions in the step
  double startPressure_ = 0, startTemperature_ = 0, startVolume_ = 0, startEnergy_ = 0;
  std::vector<double> startElements_;
  std::uint64_t attempts_ = 0;
};

}  // namespace lampblack::chemistry
