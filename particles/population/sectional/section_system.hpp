// The equations of the sections as the stiff integrator wants them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "chemistry/reactor/ode_system.hpp"
#include "core/modules.hpp"
#include "particles/population/model/nucleation_schedule.hpp"
#include "particles/population/sectional/linear_processes.hpp"
#include "particles/population/sectional/section_coagulation.hpp"
#include "particles/population/sectional/section_grid.hpp"
#include "particles/population/sectional/section_growth.hpp"

namespace lampblack::particles {

class SectionSystem final : public OdeSystem {
 public:
  // Throws InputError, also for nuclei outside the grid.
  SectionSystem(const SectionGrid& grid, const PopulationModel& model, const SectionalOptions& options);

  std::size_t size() const override { return layout_.size(); }
  bool rates(double t, const double* y, double* f) override;
  bool jacobian(double t, const double* y, double* f, double* J, std::size_t ld) override;
  // The absolute error of a section is measured by the number of its particles that would hold all of M_0, M_1, M_2 or
  // M_3, whichever is smallest: what a section that has no particles gets by the integrator's noise weighs nothing in
  // any of the moments, and the scale follows a number that falls by decades.
  bool hasMovingScales() const override { return true; }
  void toleranceScales(const double* y, double* scales) const override;
  std::string describe(double t, const double* y) const override;

  // Whether nuclei come, outside of a table they do not; and how many (1/m3) come at most until the integration ends.
  void setNucleation(bool on, double expected);
  [[nodiscard]] const NucleationSchedule* schedule() const { return schedule_ ? &*schedule_ : nullptr; }
  [[nodiscard]] double vanishingVolume() const { return growth_.vanishingVolume(); }
  // Of the sections and what left them: sum of v^k, m^(3k-3).
  [[nodiscard]] double moment(const double* y, int k) const;
  [[nodiscard]] std::size_t bytes() const;

 private:
  const SectionGrid& grid_;
  SectionLayout layout_;
  std::optional<SectionCoagulation> coagulation_;
  LinearProcesses linear_;
  SectionGrowth growth_;
  std::optional<NucleationSchedule> schedule_;
  SectionGrid::Place nuclei_{};
  double nucleusVolume_ = 0, expected_ = 0;
  bool nucleating_ = false;
};

}  // namespace lampblack::particles
