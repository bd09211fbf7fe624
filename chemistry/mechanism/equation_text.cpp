#include "chemistry/mechanism/equation_text.hpp"

#include <fmt/format.h>

namespace lampblack::chemistry {

namespace {

bool hasFalloff(const Reaction& reaction) {
  return reaction.type == Reaction::Type::Falloff || reaction.type == Reaction::Type::ChemicallyActivated;
}

}  // namespace

std::optional<std::size_t> namedCollider(const Reaction& reaction) {
  if (!hasFalloff(reaction) || !reaction.thirdBody) return std::nullopt;
  const auto& body = *reaction.thirdBody;
  if (body.defaultEfficiency != 0 || body.efficiencies.size() != 1 || body.efficiencies[0].coefficient != 1)
    return std::nullopt;
  return body.efficiencies[0].species;
}

std::string equationText(const Reaction& reaction, const std::function<std::string_view(std::size_t)>& name) {
  std::string thirdBody;
  if (const auto collider = namedCollider(reaction))
    thirdBody = fmt::format(" (+{})", name(*collider));
  else if (hasFalloff(reaction))
    thirdBody = " (+M)";
  else if (reaction.type == Reaction::Type::ThreeBody)
    thirdBody = " + M";
  const auto side = [&](const std::vector<StoichiometricTerm>& terms) {
    std::string text;
    for (const auto& term : terms) {
      if (!text.empty()) text += " + ";
      if (term.coefficient != 1) text += fmt::format("{} ", term.coefficient);
      text += name(term.species);
    }
    return text + thirdBody;
  };
  return fmt::format("{} {} {}", side(reaction.reactants), reaction.reversible ? "<=>" : "=>", side(reaction.products));
}

}  // namespace lampblack::chemistry
