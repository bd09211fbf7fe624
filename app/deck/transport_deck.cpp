#include "app/deck/transport_deck.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/transport/pure_gas.hpp"
#include "core/errors.hpp"

namespace lampblack::app {
namespace {

using Diffusion = TransportModel::Diffusion;

CollisionIntegrals readCollisionIntegrals(const Deck& deck, const Mechanism& mechanism) {
  const auto integrals = deck.choice("transport.collision_integrals") == "wang_fits"
                             ? CollisionIntegrals::WangFits
                             : CollisionIntegrals::MonchickMason;
  deck.at("mechanism", [&] { static_cast<void>(PureGas(mechanism, integrals)); });
  return integrals;
}

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

std::optional<SutherlandLaw> readSutherland(const Deck& deck) {
  if (!deck.has("transport.sutherland")) return std::nullopt;
  return SutherlandLaw{
      deck.quantity("transport.sutherland.viscosity"), deck.quantity("transport.sutherland.temperature"),
      deck.quantity("transport.sutherland.constant"), deck.number("transport.sutherland.prandtl_number")};
}

Diffusion diffusionOf(const std::string& word) {
  if (word == "multicomponent") return Diffusion::Multicomponent;
  if (word == "unity_lewis") return Diffusion::UnityLewis;
  if (word == "constant_lewis") return Diffusion::ConstantLewis;
  return Diffusion::MixtureAveraged;
}

}  // namespace

void addTransportKeys(DeckSchema& schema) {
  schema
      .add(choiceKey("transport.model", {"mixture_averaged", "multicomponent", "unity_lewis", "constant_lewis"},
                     "How species diffuse: by mixture-averaged coefficients, by the full multicomponent ones (and its "
                     "conductivity), as fast as heat, or as fast as heat over each species' Lewis number.")
               .byDefault("mixture_averaged"))
      .add(booleanKey("transport.soret",
                      "Whether species diffuse along gradients of temperature too (thermal diffusion, Soret effect).")
               .byDefault("false"))
      .add(stringKey("transport.lewis_numbers",
                     "Lewis numbers, 'H2: 0.3, CH4: 0.97'; species that are not named have 1.")
               .optional()
               .onlyWith("transport.model", {"constant_lewis"}))
      .add(choiceKey("transport.collision_integrals", {"monchick_mason", "wang_fits"},
                     "Collision integrals of viscosity and diffusion: monchick_mason: the tables of Monchick and Mason "
                     "(1961); wang_fits: the fits of Wang (2025, eqs. 6-36 and 6-37), within 2.5 % of them.")
               .byDefault("monchick_mason")
               .formerly("thesis_fits", "wang_fits"))
      .section(
          "transport.sutherland", Presence::optional,
          "Viscosity of the whole gas by Sutherland's law, viscosity * (T/temperature)^1.5 * (temperature + constant) "
          "/ (T + constant), and its conductivity by a Prandtl number, instead of kinetic theory.",
          {{"transport.model", {"unity_lewis", "constant_lewis"}}})
      .add(quantityKey("transport.sutherland.viscosity", units::viscosity, "Viscosity at 'temperature'.").above(0))
      .add(quantityKey("transport.sutherland.temperature", units::temperature, "Temperature that has 'viscosity'.")
               .above(0))
      .add(quantityKey("transport.sutherland.constant", units::temperature, "Sutherland's constant, 110.5 K for air.")
               .above(0))
      .add(numberKey("transport.sutherland.prandtl_number",
                     "Viscosity times heat capacity per mass over conductivity, 0.71 for air.")
               .above(0));
}

TransportModel readTransport(const Deck& deck, const Mechanism& mechanism) {
  TransportModel transport;
  transport.integrals = readCollisionIntegrals(deck, mechanism);
  transport.lewisNumbers = readLewisNumbers(deck, mechanism);
  transport.soret = deck.boolean("transport.soret");
  const std::string model = deck.choice("transport.model");
  transport.diffusion = diffusionOf(model);
  transport.sutherland = readSutherland(deck);
  if (transport.soret && transport.hasLewisNumbers())
    throw deck.error("transport.soret", fmt::format("the transport model {} has no thermal diffusion; set soret to "
                                                    "false, or choose mixture_averaged or multicomponent",
                                                    model));
  return transport;
}

}  // namespace lampblack::app
