// A model of soot of one's own: carbon that acetylene becomes, C2H2 -> 2 C(s) + H2, at a rate of first order, A
// exp(-Ta/T). A gas of constant temperature and pressure carries it for a millisecond.
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "particles/models/particle_model.hpp"

using namespace lampblack;
using namespace lampblack::particles;

class AcetyleneSoot final : public ParticleModel {
 public:
  std::string material() const override { return "soot"; }
  const std::vector<std::string>& gasSpecies() const override { return species_; }
  std::vector<std::size_t> precursors() const override { return {0}; }
  const std::vector<ParticleScalar>& scalars() const override { return scalars_; }

  // Of carbon, kg/m3/s, and of the species, mol/m3/s: what one gives the other takes.
  void sources(const ParticleGas& gas, std::span<const double>, std::span<double> rates,
               std::span<double> exchange) const override {
    const double moles = A * std::exp(-Ta / gas.temperature) * std::max(gas.concentrations[0], 0.0);
    rates[0] = 2 * carbonAtom * moles;
    exchange[0] = -moles;
    exchange[1] = moles;
  }

  void diffusivities(const ParticleGas&, std::span<const double>, std::span<double> D) const override { D[0] = 1e-8; }
  void enthalpies(double T, std::span<double> h, std::span<double> slope) const override {
    slope[0] = 1700;  // J/kg/K
    h[0] = slope[0] * (T - 298.15);
  }
  double absorption(double T, double volumeFraction) const override { return 1200 * volumeFraction * T; }
  ParticleProperties properties(const ParticleGas&, std::span<const double> densities) const override {
    ParticleProperties p;
    p.volumeFraction = densities[0] / 1800;
    return p;
  }
  ParticleProcesses processes(const ParticleGas&, std::span<const double>) const override { return {}; }

  static constexpr double A = 1e6, Ta = 12000, carbonAtom = 12.011e-3;  // 1/s, K, kg/mol

 private:
  std::vector<std::string> species_{"C2H2", "H2"};
  std::vector<ParticleScalar> scalars_{{"carbon", "kg/m^3", "carbon in soot", 1e-3, {{"C", 1}}}};
};

int main() try {
  const AcetyleneSoot model;
  const CarrierGas gas{1800, 101325, 0.19, 5.7e-5, 28e-3};
  std::vector<double> densities{0}, concentrations{0.1, 0};  // kg/m3; mol/m3 of C2H2 and H2
  const double begin = concentrations[0], time = 1e-3;       // s
  model.advance(gas, time, densities, concentrations);
  std::printf("soot %.6e kg/m3, volume fraction %.4e\n", densities[0],
              model.properties({gas, concentrations}, densities).volumeFraction);
  std::printf("C2H2 left %.6f of it, by the law %.6f\n", concentrations[0] / begin,
              std::exp(-AcetyleneSoot::A * std::exp(-AcetyleneSoot::Ta / gas.temperature) * time));
  std::printf("carbon that is missing: %.1e of it\n",
              (2 * AcetyleneSoot::carbonAtom * (begin - concentrations[0]) - densities[0]) /
                  (2 * AcetyleneSoot::carbonAtom * begin));
  return 0;
} catch (const std::exception& error) {
  return std::fprintf(stderr, "%s\n", error.what()), 1;
}
