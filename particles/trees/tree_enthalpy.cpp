#include "particles/trees/tree_enthalpy.hpp"

#include "particles/models/soot_model.hpp"

namespace lampblack::particles {
namespace {

// H = A t + B t^2/2 + C t^3/3 + D t^4/4 - E/t + F in kJ/mol, t in 1000 K.
struct Shomate {
  double A, B, C, D, E, F;
  [[nodiscard]] double at(double T) const {  // J/mol
    const double t = T / 1000;
    return 1000 * (t * (A + t * (B / 2 + t * (C / 3 + t * D / 4))) - E / t + F);
  }
};

// Chase (1998), as the NIST Chemistry WebBook fits it.
double quartz(double T) {
  constexpr Shomate alpha{-6.076591, 251.6755, -324.7964, 168.5604, 0.002548, -917.6893},
      beta{58.75340, 10.27925, -0.131384, 0.025210, 0.025601, -929.3292};
  return T < 847 ? alpha.at(T) : beta.at(T);
}
double waterVapour(double T) {
  constexpr Shomate low{30.09200, 6.832514, 6.793435, -2.534480, 0.082139, -250.8810},
      high{41.96426, 8.622053, -1.499780, 0.098119, -11.15764, -272.1797};
  return T < 1700 ? low.at(T) : high.at(T);
}

}  // namespace

std::optional<double> treeEnthalpy(const std::string& material, const std::string& element, double temperature) {
  if (material == "silica") {
    if (element == "Si") return quartz(temperature) / 28.085e-3;
    if (element == "H") return waterVapour(temperature) / (2 * 1.008e-3);
    if (element == "O") return 0;
  }
  if (material == "soot") {
    if (element == "C") return sootCarbonEnthalpy(temperature).first;
    if (element == "H") return sootHydrogenEnthalpy(temperature).first;
  }
  return {};
}

}  // namespace lampblack::particles
