#include "app/deck/sintering_deck.hpp"

#include "io/deck_keys.hpp"

namespace lampblack::app {
namespace {

DeckKeys<SinteringLaw> lawKeys(const std::string& section) {
  using Mechanism = SinteringMechanism;
  DeckKeys<SinteringLaw> keys(section);
  keys.choice("mechanism", &SinteringLaw::mechanism,
              {{"viscous_flow", Mechanism::viscousFlow},
               {"grain_boundary", Mechanism::grainBoundary},
               {"surface_diffusion", Mechanism::surfaceDiffusion},
               {"volume_diffusion", Mechanism::volumeDiffusion},
               {"constant", Mechanism::constant},
               {"none", Mechanism::none}},
              rules().optional(),
              "Characteristic time of sintering: A d, A d^4 T for both grain_boundary and surface_diffusion, A d^3 T, "
              "each times exp(E/T (1 - d_crit/d)); A; or no sintering. Absent: viscous_flow of silica; none of soot "
              "and of a table.");
  keys.number("prefactor", &SinteringLaw::prefactor, rules().optional().above(0),
              "The factor A in SI units: s/m, s/m^4/K, s/m^3/K or s; viscous flow of silica: 1.1e-16 s/m, its default; "
              "titania by grain_boundary: 7.4e16 s/m^4/K (Kobata, Kusakabe, Morooka 1991).");
  keys.quantity("activation_temperature", units::temperature, &SinteringLaw::temperature,
                rules().formerly("temperature").optional().atLeast(0),
                "Activation energy E of sintering over the gas constant; silica: 1.2e5 K, its default; titania by "
                "grain_boundary: 3.1e4 K; absent with other materials: 0 K.");
  keys.quantity("critical_diameter", units::length, &SinteringLaw::critical, rules().optional().atLeast(0),
                "Diameter d_crit below which primaries are as liquid; silica: 4.4 nm, its default; absent with other "
                "materials: none.");
  return keys;
}

}  // namespace

void addSinteringLawKeys(DeckSchema& schema, const std::string& section) {
  schema.add(lawKeys(section).schema());
}

SinteringLaw readSinteringLaw(const Deck& deck, const std::string& section, SinteringLaw law) {
  lawKeys(section).read(deck, law, section);
  return law;
}

void requirePrefactor(const Deck& deck, const std::string& section, const SinteringLaw& law) {
  if (law.active() && !(law.prefactor > 0))
    throw deck.error(section, "this mechanism needs the key 'prefactor', and most an 'activation_temperature'");
}

}  // namespace lampblack::app
