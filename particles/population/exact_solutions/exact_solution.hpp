// Closed (or to round-off integrated) solutions of the population balance, for the models that have one. Everything
// else is measured against these.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "particles/population/model/population_model.hpp"

namespace lampblack::particles {

class ExactSolution {
 public:
  virtual ~ExactSolution() = default;
  ExactSolution() = default;
  ExactSolution(const ExactSolution&) = delete;
  ExactSolution& operator=(const ExactSolution&) = delete;

  // M_0 to M_3 (m^(3k-3)) at `time` (s); empty where that moment is not known.
  [[nodiscard]] virtual std::array<std::optional<double>, 4> moments(double time) const = 0;
  // Number (1/m3) in each [edges[k], edges[k+1]) of volume; empty when the distribution is not known.
  [[nodiscard]] virtual std::vector<double> numberInBins(double time, std::span<const double> edges) const = 0;
  // From when on the solution does not hold (s).
  [[nodiscard]] virtual std::optional<double> gelationTime() const { return {}; }
  [[nodiscard]] virtual std::string name()
      const = 0;  // for reports: "coagulation, constant kernel, monodisperse start"
};

// The solution of this model, recognised from the model itself; null when none is known.
[[nodiscard]] std::unique_ptr<ExactSolution> exactSolution(const PopulationModel& model,
                                                           const InitialPopulation& initial);

}  // namespace lampblack::particles
