#include "flow/models/turbulence/turbulence_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "flow/boundaries/wall_law.hpp"
#include "flow/models/turbulence/k_epsilon.hpp"
#include "flow/models/turbulence/k_omega.hpp"
#include "flow/models/turbulence/realizable_k_epsilon.hpp"
#include "flow/models/turbulence/shear_stress_transport.hpp"
#include "flow/models/turbulence/spalart_allmaras.hpp"
#include "flow/models/turbulence/two_layers.hpp"
#include "flow/models/turbulence/wang.hpp"
#include "flow/models/turbulence/wray_agarwal.hpp"

namespace lampblack::flow {
namespace {

template <class Kernel>
std::shared_ptr<const TurbulenceModel> make(const TurbulenceChoices& choices) {
  Kernel kernel;
  if constexpr (requires(Kernel k) { k.c1 = 1.0; })
    kernel.c1 = choices.dissipationSource.value_or(kernel.c1);
  else if (choices.dissipationSource)
    throw InputError(fmt::format("the turbulence model '{}' has no constant C_1", kernel.name()));
  if constexpr (requires { Kernel::needsWallLaw; })
    if (choices.blendsLayers)
      return std::make_shared<PointwiseModel<TwoLayers<Kernel>>>(TwoLayers<Kernel>{kernel}, true);
  return std::make_shared<PointwiseModel<Kernel>>(kernel, choices.blendsLayers);
}

const std::array rows{
    TurbulenceRow{"sa", "Spalart and Allmaras, negative form", make<SpalartAllmaras>},
    TurbulenceRow{"wray_agarwal", "Wray and Agarwal, version of 2018", make<WrayAgarwal>},
    TurbulenceRow{"wang", "Wang's one-equation model, constants as printed", make<WangModel>},
    TurbulenceRow{"sst", "k-omega SST of Menter, Kuntz and Langtry, 2003", make<ShearStressTransport<2003>>},
    TurbulenceRow{"sst1994", "k-omega SST of Menter, 1994", make<ShearStressTransport<1994>>},
    TurbulenceRow{"k_omega", "k-omega of 2006 (Wilcox 2008)", make<KOmega<2006>>},
    TurbulenceRow{"k_omega1988", "k-omega of 1988 (Wilcox 1988)", make<KOmega<1988>>},
    TurbulenceRow{"k_epsilon", "k-epsilon of Launder and Spalding 1974, with wall functions", make<KEpsilon>},
    TurbulenceRow{"realizable_k_epsilon", "k-epsilon of Shih and others 1995, with wall functions",
                  make<RealizableKEpsilon>},
};

}  // namespace

double slopeAlongStrain(const TurbulentCell& cell) {
  constexpr double most = 2.0;
  const double product = dot(cell.strainSlope, cell.gradients[0]), steepness = length(cell.strainSlope);
  const auto towards = [&](const TurbulentCell::Neighbour& neighbour) {
    return most * steepness * (neighbour.value - cell.values[0]) / neighbour.distance;
  };
  if (!cell.knowsNeighbours) return product;
  if (product > 0.0) return cell.above ? std::min(product, std::max(towards(*cell.above), 0.0)) : 0.0;
  if (product < 0.0) return cell.below ? std::max(product, std::min(towards(*cell.below), 0.0)) : 0.0;
  return product;
}

std::span<const TurbulenceRow> turbulenceModels() {
  return rows;
}

std::shared_ptr<const TurbulenceModel> turbulenceModel(std::string_view name, const TurbulenceChoices& choices) {
  const auto row = std::ranges::find(rows, name, [](const TurbulenceRow& r) { return std::string_view(r.name); });
  if (row == rows.end()) throw InputError(fmt::format("there is no turbulence model '{}'", name));
  auto model = row->make(choices);
  if (choices.blendsLayers && model->wallBeta() <= 0.0)
    throw InputError(fmt::format("the turbulence model '{}' knows no blended law of the wall", name));
  return model;
}

FreeStream FreeStream::at(const Vector3& place) const {
  if (!varies()) return *this;
  const double k = energyAt(place, 0.0), epsilon = dissipationAt(place, 0.0);
  if (!(k > 0.0) || !(epsilon > 0.0))
    throw InputError(
        fmt::format("turbulent_kinetic_energy and turbulent_dissipation are to be above zero, found {:g} m^2/s^2 and "
                    "{:g} m^2/s^3",
                    k, epsilon));
  return {.viscosity = viscosity, .eddyViscosity = walllaw::cMu * k * k / epsilon, .energy = k};
}

double dampedRatio(double ratio, double c) {
  // From above, where Newton's iteration of a convex function comes down to the root.
  double X = ratio + c;
  for (int i = 0; i < 100; ++i) {
    const double cube = X * X * X, sum = cube + c * c * c;
    const double slope = (cube * sum + 3.0 * cube * c * c * c) / (sum * sum);
    const double step = (cube * X / sum - ratio) / slope;
    X -= step;
    if (std::abs(step) < 1e-14 * X) break;
  }
  return X;
}

}  // namespace lampblack::flow
