// Perfectly stirred reactors of one pressure, alone or joined by streams, as ordinary differential equations over time
// in the unknowns (Y_1..Y_N, T, amounts of what it carries) of each reactor. The mass flows of the streams are given
// and in balance; equations and their analytic Jacobian: docs/theory/reactors.md.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "chemistry/reactor/closed_reactor.hpp"
#include "chemistry/reactor/ode_system.hpp"
#include "chemistry/reactor/reactor_system.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

struct StirredReactor {
  std::string name;
  // Either the volume (m3), or the residence time (s), from which the volume follows.
  std::optional<double> volume, residenceTime;
  std::optional<double> temperature;  // K, where it is given; the energy equation otherwise
  double conductance = 0;             // W/K, of the wall to the surroundings
  double surroundings = 0;            // K
};

// A stream into a reactor from outside.
struct InflowStream {
  std::size_t to = 0;
  double massFlow = 0;  // kg/s
  double temperature = 0;
  std::vector<double> Y;
  std::vector<double> carried = {};  // amounts per kg of a carried phase; empty: none of it
};

// A stream from one reactor to another.
struct InnerStream {
  std::size_t from = 0, to = 0;
  double massFlow = 0;  // kg/s
};

struct ReactorNetwork {
  double pressure = 0;  // Pa
  std::vector<StirredReactor> reactors;
  std::vector<InflowStream> inflows;
  std::vector<InnerStream> streams;

  double throughflow(std::size_t reactor) const;  // kg/s, all that comes in
};

// The transient of a network: each reactor keeps its pressure and volume (or residence time); what flows out of it is
// what flows in, less what it takes up.
class NetworkSystem : public OdeSystem {
 public:
  // The mechanism and the phase that all reactors carry have to live as long.
  NetworkSystem(const Mechanism& mechanism, ReactorNetwork network, CarriedPhase* carried = nullptr);

  const ReactorNetwork& network() const { return network_; }
  std::size_t blockSize() const { return system_.size(); }
  std::size_t numCarried() const { return system_.numCarried(); }
  // Of a state y of all reactors: the unknowns of one, its density (kg/m3), residence time (s) and heat release (W/m3).
  const double* block(const double* y, std::size_t reactor) const { return y + reactor * blockSize(); }
  double density(const double* block) const;
  double residenceTime(const double* y, std::size_t reactor) const;
  double heatRelease(const double* y, std::size_t reactor);

  std::size_t size() const override { return network_.reactors.size() * blockSize(); }
  bool rates(double t, const double* y, double* f) override;
  bool jacobian(double t, const double* y, double* f, double* J, std::size_t ld) override;
  double toleranceScale(std::size_t i) const override;
  std::string describe(double t, const double* y) const override;

 private:
  // What flows into a reactor, by mass: the mean of the streams.
  struct Feed {
    double massFlow = 0, enthalpy = 0;  // kg/s, J/kg
    std::vector<double> Y, carried;
  };
  double enthalpy(double T, const double* Y, const double* carried);
  void gatherFeed(const double* y, std::size_t reactor);
  double holdUp(const double* block, std::size_t reactor) const;
  void setConditions(const double* block, std::size_t reactor, double holdUp);
  void addFlowDerivatives(const double* y, std::size_t reactor, double holdUp, double* J, std::size_t ld);

  const Mechanism& mechanism_;
  ReactorNetwork network_;
  CarriedPhase* carried_;
  std::size_t species_;
  Thermo thermo_;
  ReactorSystem system_;
  std::vector<double> throughflow_;
  std::vector<double> inflowEnthalpy_;
  Feed feed_;
  std::vector<double> source_, carriedSource_, blockJ_, blockF_, h_, upstreamH_;
  std::vector<double> carriedH_, upstreamCarriedH_, carriedCapacity_;
};

}  // namespace lampblack::chemistry
