#include "particles/models/element_enthalpies.hpp"

#include <algorithm>
#include <map>

#include "particles/models/soot_model.hpp"

namespace lampblack::particles {
namespace {

// H = A t + B t^2/2 + C t^3/3 + D t^4/4 - E/t + F in kJ/mol, t in 1000 K.
struct Shomate {
  double A, B, C, D, E, F;
  // J/kg and J/kg/K, with the weight in kg/mol.
  [[nodiscard]] std::pair<double, double> at(double T, double weight) const {
    const double t = T / 1000;
    return {1000 / weight * (t * (A + t * (B / 2 + t * (C / 3 + t * D / 4))) - E / t + F),
            (A + t * (B + t * (C + t * D)) + E / (t * t)) / weight};
  }
};

// Chase (1998), as the NIST Chemistry WebBook fits it.
std::pair<double, double> quartz(double T) {
  constexpr Shomate alpha{-6.076591, 251.6755, -324.7964, 168.5604, 0.002548, -917.6893},
      beta{58.75340, 10.27925, -0.131384, 0.025210, 0.025601, -929.3292};
  return (T < 847 ? alpha : beta).at(T, 28.085e-3);
}
std::pair<double, double> waterVapour(double T) {
  constexpr Shomate low{30.09200, 6.832514, 6.793435, -2.534480, 0.082139, -250.8810},
      high{41.96426, 8.622053, -1.499780, 0.098119, -11.15764, -272.1797};
  return (T < 1700 ? low : high).at(T, 2 * 1.008e-3);
}
std::pair<double, double> none(double) {
  return {0, 0};
}

using Material = std::map<std::string, ElementEnthalpy, std::less<>>;
const std::pair<const char*, Material> materials[] = {
    {"C", {{"C", sootCarbonEnthalpy}, {"H", sootHydrogenEnthalpy}}},
    {"Si", {{"Si", quartz}, {"H", waterVapour}, {"O", none}}},
};

}  // namespace

std::optional<std::vector<ElementEnthalpy>> elementEnthalpies(std::span<const std::string> elements) {
  for (const auto& [main, known] : materials) {
    if (std::ranges::find(elements, main) == elements.end()) continue;
    std::vector<ElementEnthalpy> all;
    for (const std::string& element : elements) {
      const auto found = known.find(element);
      if (found == known.end()) return std::nullopt;
      all.push_back(found->second);
    }
    return all;
  }
  return std::nullopt;
}

}  // namespace lampblack::particles
