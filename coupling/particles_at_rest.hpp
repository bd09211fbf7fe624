// Particles of a split reactor as its gas carries them while it reacts (split_reactor.hpp).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/reactor/carried_phase.hpp"
#include "core/modules.hpp"
#include "particles/models/element_enthalpies.hpp"

namespace lampblack::coupling {

// What the gas carries while it reacts: each element of the particles (kg/kg), and a mark for each reactor, one in it
// and zero elsewhere at the beginning of each part of a step, that says where this gas has gone.
class ParticlesAtRest : public CarriedPhase {
 public:
  enum SootAmount : std::size_t { carbon, hydrogen };  // of soot, the default
  explicit ParticlesAtRest(std::size_t reactors = 1, std::vector<std::string> elements = {"C", "H"});
  [[nodiscard]] std::size_t size() const override { return mark() + reactors_; }
  [[nodiscard]] std::size_t mark() const { return elements_.size(); }  // amount of the first mark
  [[nodiscard]] const std::string& elementName(std::size_t e) const { return elements_[e]; }
  [[nodiscard]] const std::vector<std::size_t>& exchanged() const override { return none_; }
  void sources(double T, double p, std::span<const double> concentrations, std::span<const double> densities,
               std::span<double> rates, std::span<double> exchange) override;
  void jacobian(double T, double p, std::span<const double> concentrations, std::span<const double> densities,
                std::span<double> values) override;
  // Of the elements; where the heat of particles of these is not known (elementEnthalpies()) they count as zero: their
  // reactors need a given temperature.
  void enthalpies(double T, std::span<double> h, std::span<double> slope) override;
  // kg of each element of the mechanism in a unit of each amount. InputError for an element that it lacks.
  [[nodiscard]] std::vector<std::vector<double>> unitElements(const Mechanism& mechanism) const;

 private:
  std::size_t reactors_;
  std::vector<std::string> elements_;
  std::vector<ElementEnthalpy> enthalpies_;  // of the elements; empty where they are not known
  std::vector<std::size_t> none_;
};

}  // namespace lampblack::coupling
