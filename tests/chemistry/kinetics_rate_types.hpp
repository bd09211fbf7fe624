// A mechanism with every kind of rate constant and of mass action there is, between the species of H2/O2. The numbers
// are of the size of real ones, chosen so that broadening, interpolation and sums all matter.
#pragma once

#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

class RateTypes {
 public:
  static Mechanism mechanism() {
    RateTypes types;
    types.addFalloff();
    types.addTabulated();
    types.addPowers();
    types.addEnthalpyDependent();
    types.addLinearBurke();
    return types.build();
  }

  static Mechanism withOnly(const Reaction& reaction) {
    RateTypes types;
    types.reactions_.push_back(reaction);
    return types.build();
  }

  static std::vector<StoichiometricTerm> terms(const std::vector<std::pair<std::string, double>>& side) {
    std::vector<StoichiometricTerm> result;
    for (const auto& [name, coefficient] : side) result.push_back({hydrogen().speciesIndex(name), coefficient});
    return result;
  }

  static Reaction reaction(Reaction::Type type, const std::vector<std::pair<std::string, double>>& left,
                           const std::vector<std::pair<std::string, double>>& right, Arrhenius rate,
                           bool reversible = true) {
    Reaction r;
    r.type = type;
    r.reactants = terms(left);
    r.products = terms(right);
    r.rate = rate;
    r.reversible = reversible;
    for (const auto* side : {&left, &right}) {
      for (const auto& [name, coefficient] : *side)
        r.equation += (r.equation.empty() || r.equation.back() == ' ' ? "" : " + ") + name;
      if (side == &left) r.equation += reversible ? " <=> " : " => ";
    }
    return r;
  }

  // H + HO2 <=> 2 OH at 0.1, 1, 10 and 100 bar; the two entries at 1 bar add up.
  static Reaction pressureLog() {
    auto r = reaction(Reaction::Type::PressureLog, {{"H", 1}, {"HO2", 1}}, {{"OH", 2}}, {});
    r.pressureRates = {{1e4, {2.5e6, 0.3, 800}},
                       {1e5, {7.1e7, 0.0, 300}},
                       {1e5, {-3e5, 0.5, 200}},
                       {1e6, {9e9, -0.4, 1500}},
                       {1e7, {4e8, 0.1, 2500}}};
    return r;
  }

  // O + HO2 <=> OH + O2 on 300 to 2500 K and 0.01 to 100 bar
  static Reaction chebyshev() {
    auto r = reaction(Reaction::Type::Chebyshev, {{"O", 1}, {"HO2", 1}}, {{"OH", 1}, {"O2", 1}}, {});
    r.chebyshev = ChebyshevRate{
        300, 2500, 1e3, 1e7, 4, 3, {6.9, -0.31, -0.08, 1.1, 0.26, 0.03, -0.2, 0.07, 0.04, -0.06, 0.02, -0.01}};
    return r;
  }

  static Reaction sriFalloff() {
    auto r = reaction(Reaction::Type::Falloff, {{"OH", 2}}, {{"H2O2", 1}}, {7.4e7, -0.37, 0});
    r.lowPressureRate = {2.3e6, -0.9, -850};
    r.sri = SriBroadening{0.45, 797, 979, 1.2, -0.03};
    r.thirdBody = ThirdBody{1, terms({{"H2O", 6}, {"AR", 0.7}})};
    return r;
  }

  static Reaction activated() {
    auto r = reaction(Reaction::Type::ChemicallyActivated, {{"HO2", 2}}, {{"H2O2", 1}, {"O2", 1}}, {4e4, 0.2, 4000});
    r.lowPressureRate = {3e5, 0.1, 3000};
    r.troe = TroeBroadening{0.6, 150, 1800, 5000.0};
    r.thirdBody = ThirdBody{1, terms({{"H2O", 6}, {"AR", 0.7}})};
    return r;
  }

  // Activation energies within the formula's middle range, and of the branches below and above it.
  static std::vector<Reaction> blowersMasel() {
    auto middle =
        reaction(Reaction::Type::Elementary, {{"O", 1}, {"H2", 1}}, {{"H", 1}, {"OH", 1}}, {3.9e-2, 2.7, 3150});
    middle.blowersMasel = BlowersMasel{5e4};
    auto none = reaction(Reaction::Type::Elementary, {{"H", 1}, {"HO2", 1}}, {{"H2", 1}, {"O2", 1}}, {2e7, 0, 500});
    none.blowersMasel = BlowersMasel{5e4};
    auto whole = reaction(Reaction::Type::ThreeBody, {{"H2O", 1}}, {{"H", 1}, {"OH", 1}}, {6e6, -0.4, 5000});
    whole.blowersMasel = BlowersMasel{6e4};
    whole.thirdBody = ThirdBody{1, terms({{"H2O", 10}, {"AR", 0.5}})};
    return {middle, none, whole};
  }

  static Reaction tsangFalloff() {
    auto r = reaction(Reaction::Type::Falloff, {{"O", 1}, {"OH", 1}}, {{"HO2", 1}}, {8e6, 0.1, 300});
    r.lowPressureRate = {3e4, -1.1, 100};
    r.tsang = TsangBroadening{0.95, -1e-4};
    r.thirdBody = ThirdBody{1, terms({{"H2O", 5}})};
    return r;
  }

  // H + OH <=> H2O: fall-off for all, water more efficient, rates of their own for argon, oxygen and hydrogen.
  static Reaction linearBurke() {
    auto r = reaction(Reaction::Type::LinearBurke, {{"H", 1}, {"OH", 1}}, {{"H2O", 1}}, {});
    auto all = reaction(Reaction::Type::Falloff, {{"H", 1}, {"OH", 1}}, {{"H2O", 1}}, {2.5e7, 0.23, -57}, false);
    all.lowPressureRate = {4.5e6, -1.8, 250};
    all.troe = TroeBroadening{0.6, 100, 2000, 5000.0};
    all.thirdBody = ThirdBody{};
    auto ofHydrogen = all;
    ofHydrogen.troe.reset();
    ofHydrogen.tsang = TsangBroadening{0.3, 1e-4};
    ofHydrogen.rate.A = 4e7;
    auto ofArgon = pressureLog(), ofOxygen = chebyshev();
    for (auto* rate : {&ofArgon, &ofOxygen}) {
      rate->reactants = all.reactants;
      rate->products = all.products;
      rate->reversible = false;
    }
    const auto named = [](const char* name, Arrhenius efficiency) {
      return Collider{terms({{name, 1}})[0].species, efficiency, false, {}};
    };
    r.colliders = {Collider{std::nullopt, {1, 0, 0}, true, all}, named("H2O", {0.1, 0.55, -120}),
                   named("AR", {0.022, 0.47, -60}), named("O2", {3, -0.1, 50}), named("H2", {2, 0, 0})};
    r.colliders[2].rate = ofArgon;
    r.colliders[3].rate = ofOxygen;
    r.colliders[4].rate = ofHydrogen;
    for (const std::size_t i : {2, 3, 4}) r.colliders[i].ownRate = true;
    return r;
  }

  static Reaction ordersOfAll() {
    auto r = reaction(Reaction::Type::Elementary, {{"H2", 1}, {"O2", 1}}, {{"OH", 2}}, {3e4, 0.5, 9000}, false);
    r.orders = terms({{"H2", 0.5}, {"O2", 1.25}, {"H2O", -0.3}});
    return r;
  }

 private:
  void addFalloff() {
    auto troe = reaction(Reaction::Type::Falloff, {{"H", 1}, {"O2", 1}}, {{"HO2", 1}}, {4.65e6, 0.44, 0});
    troe.lowPressureRate = {6.4e3, -1.4, 0};
    troe.troe = TroeBroadening{0.5, 30, 90000, 90000.0};
    troe.thirdBody = ThirdBody{1, terms({{"H2O", 14}, {"O2", 0.8}})};
    auto lindemann = reaction(Reaction::Type::Falloff, {{"H", 1}, {"OH", 1}}, {{"H2O", 1}}, {2.5e7, 0.23, -57}, false);
    lindemann.lowPressureRate = {4.5e6, -1.81, 250};
    lindemann.thirdBody = ThirdBody{0, terms({{"N2", 1}, {"H2O", 3}})};
    auto activatedSri = reaction(Reaction::Type::ChemicallyActivated, {{"H", 1}, {"H2O2", 1}}, {{"OH", 1}, {"H2O", 1}},
                                 {9e5, 0.6, 900});
    activatedSri.lowPressureRate = {6e6, 0.4, 400};
    activatedSri.sri = SriBroadening{0.8, 300, 0, 1, 0};
    activatedSri.thirdBody = ThirdBody{1, {}};
    for (const auto& r : {troe, lindemann, sriFalloff(), activated(), activatedSri, tsangFalloff()})
      reactions_.push_back(r);
    auto threeBody = reaction(Reaction::Type::ThreeBody, {{"H", 2}}, {{"H2", 1}}, {1e6, -1, 0});
    threeBody.thirdBody = ThirdBody{1, terms({{"H2", 0}, {"H2O", 0}})};
    reactions_.push_back(threeBody);
    threeBody.rate = {6e7, -1.25, 0};
    threeBody.thirdBody = ThirdBody{0, terms({{"H2O", 1}})};
    reactions_.push_back(threeBody);
  }

  void addTabulated() {
    reactions_.push_back(pressureLog());
    auto single = reaction(Reaction::Type::PressureLog, {{"O", 1}, {"H2O2", 1}}, {{"OH", 1}, {"HO2", 1}}, {}, false);
    single.pressureRates = {{1e5, {9.6, 2, 2000}}};
    reactions_.push_back(single);
    reactions_.push_back(chebyshev());
  }

  void addEnthalpyDependent() {
    for (const auto& r : blowersMasel()) reactions_.push_back(r);
  }

  // The second: PLOG for all, and only efficiencies beside it.
  void addLinearBurke() {
    reactions_.push_back(linearBurke());
    auto other = reaction(Reaction::Type::LinearBurke, {{"H", 1}, {"HO2", 1}}, {{"OH", 2}}, {}, false);
    auto rate = pressureLog();
    rate.reversible = false;
    other.colliders = {Collider{std::nullopt, {1, 0, 0}, true, rate},
                       Collider{terms({{"N2", 1}})[0].species, {1.7, -0.2, 300}, false, {}}};
    reactions_.push_back(other);
  }

  void addPowers() {
    using enum Reaction::Type;
    reactions_.push_back(reaction(Elementary, {{"H", 1}, {"O2", 1}}, {{"O", 1}, {"OH", 1}}, {2.65e10, -0.67, 8600}));
    reactions_.push_back(ordersOfAll());
    reactions_.push_back(reaction(Elementary, {{"H2", 1}, {"O2", 0.5}}, {{"H2O", 1}}, {5e3, 0.2, 9500}));
    reactions_.push_back(reaction(Elementary, {{"OH", 2}, {"H", 2}}, {{"H2O", 2}}, {8e2, 0, 100}));
    reactions_.push_back(reaction(Elementary, {{"H", 2}, {"H2", 1}}, {{"H2", 2}}, {9e4, -0.6, 0}));
    reactions_.push_back(reaction(Elementary, {{"O", 1}, {"OH", 1}, {"H", 1}}, {{"H2O", 1}, {"O", 1}}, {1e3, 0, 0}));
    auto first = reaction(Elementary, {{"OH", 2}}, {{"O", 1}, {"H2O", 1}}, {3.57e-2, 2.4, -1060});
    auto second = first;
    first.duplicate = second.duplicate = true;
    second.rate = {-1.1e-2, 2.3, -900};
    reactions_.push_back(first);
    reactions_.push_back(second);
  }

  Mechanism build() {
    const auto& base = hydrogen();
    std::vector<Element> elements;
    for (std::size_t i = 0; i < base.numElements(); ++i)
      elements.push_back({base.elementName(i), base.atomicWeight(i)});
    return Mechanism("rate-types", "every rate type", elements, {base.allSpecies().begin(), base.allSpecies().end()},
                     reactions_);
  }

  std::vector<Reaction> reactions_;
};

}  // namespace lampblack::test
