#include "app/deck/sintering_deck.hpp"

namespace lampblack::app {
namespace {

SinteringMechanism mechanismOf(const std::string& name) {
  if (name == "viscous_flow") return SinteringMechanism::viscousFlow;
  if (name == "grain_boundary") return SinteringMechanism::grainBoundary;
  if (name == "surface_diffusion") return SinteringMechanism::surfaceDiffusion;
  if (name == "volume_diffusion") return SinteringMechanism::volumeDiffusion;
  if (name == "constant") return SinteringMechanism::constant;
  return SinteringMechanism::none;
}

}  // namespace

void addSinteringLawKeys(DeckSchema& schema, const std::string& section) {
  const std::string s = section + ".";
  schema
      .add(choiceKey(s + "mechanism",
                     {"viscous_flow", "grain_boundary", "surface_diffusion", "volume_diffusion", "constant", "none"},
                     "Characteristic time of sintering: A d, A d^4 T for both grain_boundary and surface_diffusion, A "
                     "d^3 T, each times exp(E/T (1 - d_crit/d)); A; or no sintering. Absent: viscous_flow of silica; "
                     "none of soot and of a table.")
               .optional())
      .add(numberKey(s + "prefactor",
                     "The factor A in SI units: s/m, s/m^4/K, s/m^3/K or s; viscous flow of silica: 1.1e-16 s/m, its "
                     "default; titania by grain_boundary: 7.4e16 s/m^4/K (Kobata, Kusakabe, Morooka 1991).")
               .optional()
               .above(0))
      .add(quantityKey(s + "activation_temperature", units::temperature,
                       "Activation energy E of sintering over the gas constant; silica: 1.2e5 K, its default; titania "
                       "by grain_boundary: 3.1e4 K; absent with other materials: 0 K.")
               .formerly("temperature")
               .optional()
               .atLeast(0))
      .add(quantityKey(s + "critical_diameter", units::length,
                       "Diameter d_crit below which primaries are as liquid; silica: 4.4 nm, its default; absent with "
                       "other materials: none.")
               .optional()
               .atLeast(0));
}

SinteringLaw readSinteringLaw(const Deck& deck, const std::string& section, SinteringLaw law) {
  const std::string s = section + ".";
  if (const auto name = deck.optionalString(s + "mechanism")) law.mechanism = mechanismOf(*name);
  law.prefactor = deck.optionalNumber(s + "prefactor").value_or(law.prefactor);
  law.temperature = deck.optionalQuantity(s + "activation_temperature").value_or(law.temperature);
  law.critical = deck.optionalQuantity(s + "critical_diameter").value_or(law.critical);
  return law;
}

void requirePrefactor(const Deck& deck, const std::string& section, const SinteringLaw& law) {
  if (law.active() && !(law.prefactor > 0))
    throw deck.error(section, "this mechanism needs the key 'prefactor', and most an 'activation_temperature'");
}

}  // namespace lampblack::app
