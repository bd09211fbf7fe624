#include "app/deck/transport_deck.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/transport/pure_gas.hpp"
#include "core/errors.hpp"
#include "io/deck_keys.hpp"

namespace lampblack::app {
namespace {

using Diffusion = TransportModel::Diffusion;

std::vector<double> readLewisNumbers(const Deck& deck, const Mechanism& mechanism) {
  const bool constant = deck.choice("transport.model") == "constant_lewis";
  const auto text = deck.optionalString("transport.lewis_numbers");
  if (constant && !text) throw deck.error("transport.model", "the model constant_lewis needs the key 'lewis_numbers'");
  if (!text) return {};
  return deck.at("transport.lewis_numbers", [&] {
    auto numbers = parseAmounts(mechanism, *text, "Lewis numbers", 1.0);
    for (std::size_t k = 0; k < numbers.size(); ++k)
      if (numbers[k] == 0)
        throw InputError(
            fmt::format("the Lewis number of '{}' is 0; expected a positive number", mechanism.speciesName(k)));
    return numbers;
  });
}

DeckKeys<TransportModel> transportKeys() {
  DeckKeys<TransportModel> keys("transport");
  keys.choice("model", &TransportModel::diffusion,
              {{"mixture_averaged", Diffusion::MixtureAveraged},
               {"multicomponent", Diffusion::Multicomponent},
               {"unity_lewis", Diffusion::UnityLewis},
               {"constant_lewis", Diffusion::ConstantLewis}},
              rules().byDefault("mixture_averaged"),
              "How species diffuse: by mixture-averaged coefficients, by the full multicomponent ones (and its "
              "conductivity), as fast as heat, or as fast as heat over each species' Lewis number.");
  keys.boolean("soret", &TransportModel::soret, rules().byDefault("false"),
               "Whether species diffuse along gradients of temperature too (thermal diffusion, Soret effect).");
  keys.text("lewis_numbers", rules().optional().onlyWith("transport.model", {"constant_lewis"}),
            "Lewis numbers, 'H2: 0.3, CH4: 0.97'; species that are not named have 1.");
  keys.choice("collision_integrals", &TransportModel::integrals,
              {{"monchick_mason", CollisionIntegrals::MonchickMason}, {"wang_fits", CollisionIntegrals::WangFits}},
              rules().byDefault("monchick_mason").formerly("thesis_fits", "wang_fits"),
              "Collision integrals of viscosity and diffusion: monchick_mason: the tables of Monchick and Mason "
              "(1961); wang_fits: the fits of Wang (2025, eqs. 6-36 and 6-37), within 2.5 % of them.");
  return keys;
}

DeckKeys<SutherlandLaw> sutherlandKeys() {
  DeckKeys<SutherlandLaw> keys("transport.sutherland");
  keys.section(Presence::optional,
               "Viscosity of the whole gas by Sutherland's law, viscosity * (T/temperature)^1.5 * (temperature + "
               "constant) / (T + constant), and its conductivity by a Prandtl number, instead of kinetic theory.",
               {{"transport.model", {"unity_lewis", "constant_lewis"}}});
  keys.quantity("viscosity", units::viscosity, &SutherlandLaw::viscosity, rules().required().above(0),
                "Viscosity at 'temperature'.");
  keys.quantity("temperature", units::temperature, &SutherlandLaw::temperature, rules().required().above(0),
                "Temperature that has 'viscosity'.");
  keys.quantity("constant", units::temperature, &SutherlandLaw::constant, rules().required().above(0),
                "Sutherland's constant, 110.5 K for air.");
  keys.number("prandtl_number", &SutherlandLaw::prandtl, rules().required().above(0),
              "Viscosity times heat capacity per mass over conductivity, 0.71 for air.");
  return keys;
}

}  // namespace

void addTransportKeys(DeckSchema& schema) {
  schema.add(transportKeys().schema()).add(sutherlandKeys().schema());
}

TransportModel readTransport(const Deck& deck, const Mechanism& mechanism) {
  TransportModel transport = transportKeys().read(deck);
  deck.at("mechanism", [&] { static_cast<void>(PureGas(mechanism, transport.integrals)); });
  transport.lewisNumbers = readLewisNumbers(deck, mechanism);
  if (deck.has("transport.sutherland")) transport.sutherland = sutherlandKeys().read(deck);
  if (transport.soret && transport.hasLewisNumbers())
    throw deck.error("transport.soret", fmt::format("the transport model {} has no thermal diffusion; set soret to "
                                                    "false, or choose mixture_averaged or multicomponent",
                                                    deck.choice("transport.model")));
  return transport;
}

}  // namespace lampblack::app
