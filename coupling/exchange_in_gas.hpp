// What particles exchange with the gas while it reacts, as a split reactor expects it of the next step: of a species
// that they take a rate in proportion to its concentration, of one that they give a constant rate. The gas's equations
// then know the balance of production and consumption, however short-lived a species is (after Celnik, Patterson,
// Kraft, Wagner 2009). The particles' elements go along, and amounts beside them say what the gas has had on the way.
//
// Of one reactor: its equations do not say which of several they are of.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"
#include "coupling/particles_at_rest.hpp"

namespace lampblack::coupling {

class ExchangeInGas final : public ParticlesAtRest {
 public:
  // `species` that the particles exchange. The mechanism has to live as long.
  ExchangeInGas(const Mechanism& mechanism, std::vector<std::string> elements, std::vector<std::size_t> species);

  struct Rate {
    double perConcentration = 0;  // 1/s, by which a species is taken
    double constant = 0;          // mol/m3/s, at which it is given
  };
  // For a step of about `duration` (s).
  void expect(std::span<const Rate> rates, double duration);

  // From the amounts behind a step that began with a mark of one and without what is counted here:
  // mol/m3, mean of a species' concentration over the step;
  [[nodiscard]] double meanConcentration(std::span<const double> amounts, std::size_t i) const;
  // mol/kg of it that came by these rates and is there yet.
  [[nodiscard]] double added(std::span<const double> amounts, std::size_t i) const;
  // kg of the e-th element in a mole of the i-th species.
  [[nodiscard]] double perMole(std::size_t i, std::size_t e) const { return perMole_[i * mark() + e]; }

  [[nodiscard]] std::size_t size() const override { return time() + 1 + 2 * species_.size(); }
  [[nodiscard]] const std::vector<std::size_t>& exchanged() const override { return species_; }
  void sources(double T, double p, std::span<const double> concentrations, std::span<const double> densities,
               std::span<double> rates, std::span<double> exchange) override;
  void jacobian(double T, double p, std::span<const double> concentrations, std::span<const double> densities,
                std::span<double> values) override;

 private:
  // Amounts behind the mark: the time, the concentrations over it, what was exchanged, in units that make them of order
  // one.
  [[nodiscard]] std::size_t time() const { return mark() + 1; }
  [[nodiscard]] std::size_t seen(std::size_t i) const { return time() + 1 + i; }
  [[nodiscard]] std::size_t given(std::size_t i) const { return time() + 1 + species_.size() + i; }

  std::vector<std::size_t> species_;
  std::vector<double> weights_;  // kg/mol, of the species
  std::vector<double> perMole_;
  std::vector<Rate> rates_;
  double perTime_ = 1;  // 1/s
};

}  // namespace lampblack::coupling
