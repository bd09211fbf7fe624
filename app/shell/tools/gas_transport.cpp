#include "app/shell/tools/gas_transport.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "chemistry/transport/multicomponent_transport.hpp"
#include "chemistry/transport/transport.hpp"
#include "core/errors.hpp"
#include "core/nearest_name.hpp"

namespace lampblack::app {
namespace {

using Model = GasTransportChoice::Model;

template <typename Value, std::size_t n>
Value chosen(const std::array<std::pair<const char*, Value>, n>& known, const std::string& name, const char* option) {
  std::vector<std::string> names;
  for (const auto& [text, value] : known) {
    if (name == text) return value;
    names.emplace_back(text);
  }
  throw InputError(
      fmt::format("{}: expected {}, found '{}'{}", option, fmt::join(names, " or "), name, didYouMean(name, names)));
}

constexpr std::array<std::pair<const char*, Model>, 3> models = {{{"mixture-averaged", Model::MixtureAveraged},
                                                                  {"multicomponent", Model::Multicomponent},
                                                                  {"unity-lewis", Model::UnityLewis}}};
constexpr std::array<std::pair<const char*, CollisionIntegrals>, 2> integralNames = {
    {{"monchick-mason", CollisionIntegrals::MonchickMason}, {"wang", CollisionIntegrals::WangFits}}};

}  // namespace

Model transportModel(const std::string& name) {
  return chosen(models, name, "--transport");
}

std::string transportModelName(Model model) {
  for (const auto& [name, value] : models)
    if (value == model) return name;
  return {};
}

CollisionIntegrals collisionIntegrals(const std::string& name) {
  return chosen(integralNames, name, "--collision-integrals");
}

GasTransport gasTransport(const Mechanism& mechanism, double T, double p, std::span<const double> X,
                          const GasTransportChoice& choice) {
  const std::size_t n = mechanism.numSpecies();
  TransportOptions options;
  options.integrals = choice.integrals;
  if (choice.model == Model::UnityLewis) options.diffusion = DiffusionModel::UnityLewis;
  Transport averaged(mechanism, options);
  GasTransport result;
  result.choice = choice;
  result.mixtureDiffusion.resize(n);
  const auto mixture = averaged.mixture(T, p, X, result.mixtureDiffusion);
  result.viscosity = mixture.viscosity;
  result.thermalConductivity = mixture.conductivity;
  if (choice.model == Model::UnityLewis) return result;
  result.thermalDiffusion.resize(n);
  if (choice.model == Model::MixtureAveraged) {
    averaged.thermalDiffusion(T, p, X, result.thermalDiffusion);
    return result;
  }
  MulticomponentTransport multicomponent(mechanism, choice.integrals);
  const auto exact = multicomponent.mixture(T, p, X, result.thermalDiffusion);
  result.viscosity = exact.viscosity;
  result.thermalConductivity = exact.conductivity;
  result.multicomponentDiffusion.resize(n * n);
  multicomponent.diffusion(T, p, X, result.multicomponentDiffusion);
  return result;
}

}  // namespace lampblack::app
