#include "chemistry/mechanism/reaction_writer.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "chemistry/mechanism/equation_text.hpp"
#include "chemistry/mechanism/yaml_text.hpp"

namespace lampblack::chemistry {

namespace {

using Type = Reaction::Type;

std::string arrheniusFields(const Arrhenius& rate) {
  return fmt::format("A: {}, b: {}, Ea: {}", yamlNumber(rate.A), yamlNumber(rate.b),
                     yamlNumber(rate.activationTemperature));
}

std::string speciesMap(const std::vector<StoichiometricTerm>& terms, const Mechanism& mechanism) {
  std::string text;
  for (const auto& term : terms)
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", yamlName(mechanism.speciesName(term.species)),
                        yamlNumber(term.coefficient));
  return fmt::format("{{{}}}", text);
}

class ReactionWriter {
 public:
  ReactionWriter(const Reaction& reaction, const Mechanism& mechanism) : reaction_(reaction), mechanism_(mechanism) {}

  std::string write() {
    const auto equation =
        equationText(reaction_, [this](std::size_t k) { return std::string_view(mechanism_.speciesName(k)); });
    out_ = fmt::format("- equation: {}\n", yamlEquation(equation));
    if (reaction_.duplicate) line("duplicate", "true");
    writeRate();
    writeThirdBody();
    writeOrders();
    return std::move(out_);
  }

 private:
  void line(std::string_view key, std::string_view value) { out_ += fmt::format("  {}: {}\n", key, value); }

  void writeArrhenius(std::string_view key, const Arrhenius& rate) {
    line(key, fmt::format("{{{}}}", arrheniusFields(rate)));
  }

  void writeRate() {
    switch (reaction_.type) {
      case Type::ThreeBody:
      case Type::Elementary:
        writeElementary();
        break;
      case Type::Falloff:
      case Type::ChemicallyActivated:
        line("type", reaction_.type == Type::Falloff ? "falloff" : "chemically-activated");
        writeArrhenius("low-P-rate-constant", reaction_.lowPressureRate);
        writeArrhenius("high-P-rate-constant", reaction_.rate);
        writeBroadening();
        break;
      case Type::PressureLog:
        line("type", "pressure-dependent-Arrhenius");
        out_ += "  rate-constants:\n";
        for (const auto& entry : reaction_.pressureRates)
          out_ += fmt::format("  - {{P: {}, {}}}\n", yamlNumber(entry.pressure), arrheniusFields(entry.rate));
        break;
      case Type::Chebyshev:
        writeChebyshev(*reaction_.chebyshev);
        break;
      case Type::LinearBurke:
        writeColliders();
        break;
    }
    if (reaction_.rate.A < 0) line("negative-A", "true");
  }

  void writeElementary() {
    const bool threeBody = reaction_.type == Type::ThreeBody;
    if (!reaction_.blowersMasel) {
      if (threeBody) line("type", "three-body");
      writeArrhenius("rate-constant", reaction_.rate);
      return;
    }
    line("type", threeBody ? "three-body-Blowers-Masel" : "Blowers-Masel");
    const auto& rate = reaction_.rate;
    line("rate-constant",
         fmt::format("{{A: {}, b: {}, Ea0: {}, w: {}}}", yamlNumber(rate.A), yamlNumber(rate.b),
                     yamlNumber(rate.activationTemperature), yamlNumber(reaction_.blowersMasel->bondEnergy)));
  }

  void writeColliders() {
    line("type", "linear-Burke");
    out_ += "  colliders:\n";
    for (const auto& collider : reaction_.colliders) {
      out_ +=
          fmt::format("  - name: {}\n", collider.species ? yamlName(mechanism_.speciesName(*collider.species)) : "M");
      if (collider.species) out_ += fmt::format("    efficiency: {{{}}}\n", arrheniusFields(collider.efficiency));
      if (!collider.ownRate) continue;
      // The rate's lines are those of a reaction, indented as an entry of the list.
      ReactionWriter writer(collider.rate, mechanism_);
      writer.writeRate();
      std::string_view rest = writer.out_;
      while (!rest.empty()) {
        const auto end = rest.find('\n') + 1;
        out_ += fmt::format("  {}", rest.substr(0, end));
        rest.remove_prefix(end);
      }
    }
  }

  void writeBroadening() {
    if (const auto& tsang = reaction_.tsang)
      line("Tsang", fmt::format("{{A: {}, B: {}}}", yamlNumber(tsang->A), yamlNumber(tsang->B)));
    if (const auto& troe = reaction_.troe) {
      const auto T2 = troe->T2 ? fmt::format(", T2: {}", yamlNumber(*troe->T2)) : std::string();
      line("Troe", fmt::format("{{A: {}, T3: {}, T1: {}{}}}", yamlNumber(troe->A), yamlNumber(troe->T3),
                               yamlNumber(troe->T1), T2));
    }
    if (const auto& sri = reaction_.sri)
      line("SRI", fmt::format("{{A: {}, B: {}, C: {}, D: {}, E: {}}}", yamlNumber(sri->a), yamlNumber(sri->b),
                              yamlNumber(sri->c), yamlNumber(sri->d), yamlNumber(sri->e)));
  }

  void writeChebyshev(const ChebyshevRate& rate) {
    line("type", "Chebyshev");
    line("temperature-range",
         fmt::format("[{}, {}]", yamlNumber(rate.minTemperature), yamlNumber(rate.maxTemperature)));
    line("pressure-range", fmt::format("[{}, {}]", yamlNumber(rate.minPressure), yamlNumber(rate.maxPressure)));
    out_ += "  data:\n";
    for (std::size_t i = 0; i < rate.numTemperature; ++i) {
      std::vector<std::string> row;
      for (std::size_t j = 0; j < rate.numPressure; ++j)
        row.push_back(yamlNumber(rate.coefficients[i * rate.numPressure + j]));
      out_ += fmt::format("  - {}\n", yamlList(row, 4));
    }
  }

  void writeThirdBody() {
    if (!reaction_.thirdBody || namedCollider(reaction_)) return;
    const auto& body = *reaction_.thirdBody;
    if (!body.efficiencies.empty()) line("efficiencies", speciesMap(body.efficiencies, mechanism_));
    if (body.defaultEfficiency != 1) line("default-efficiency", yamlNumber(body.defaultEfficiency));
  }

  void writeOrders() {
    if (reaction_.orders.empty()) return;
    line("orders", speciesMap(reaction_.orders, mechanism_));
    const auto reacts = [&](const StoichiometricTerm& order) {
      return std::ranges::any_of(reaction_.reactants, [&](const auto& term) { return term.species == order.species; });
    };
    if (std::ranges::any_of(reaction_.orders, [](const auto& order) { return order.coefficient < 0; }))
      line("negative-orders", "true");
    if (!std::ranges::all_of(reaction_.orders, reacts)) line("nonreactant-orders", "true");
  }

  const Reaction& reaction_;
  const Mechanism& mechanism_;
  std::string out_;
};

}  // namespace

std::string reactionYaml(const Reaction& reaction, const Mechanism& mechanism) {
  return ReactionWriter(reaction, mechanism).write();
}

}  // namespace lampblack::chemistry
