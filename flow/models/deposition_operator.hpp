// What walls have taken of the particles that a flow carries: its rate in the last step and what has gathered, face by
// face. Whoever moves the particles (CarriedTransport, coupling/EnsembleTransport) removes them, and tells this.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "flow/flow_context.hpp"
#include "flow/operator.hpp"

namespace lampblack::flow {

class DepositionOperator : public Operator {
 public:
  // `material`: of the particles.
  DepositionOperator(const FlowContext& context, std::string material);

  // Whether the flow has walls, which take particles or may once it goes on.
  [[nodiscard]] static bool isNeeded(const std::vector<BoundaryCondition>& boundaries);

  // A step of `dt` (s) in which the boundary's faces took these masses, kg per metre depth or radian.
  void record(double dt, std::span<const double> mass);
  // The boundary's faces take these rates (kg/s per metre depth or radian), of a state that no step has led to; nothing
  // is added to what they have.
  void setRate(std::span<const double> rate);

  [[nodiscard]] const char* name() const override { return "deposition"; }
  void advance(State&, double, double) override {}
  void saveOrLoad(StateArchive& archive) override;
  [[nodiscard]] std::vector<Quantity> historyColumns() const override;
  [[nodiscard]] std::vector<double> historyValues(const State& state) override;
  [[nodiscard]] std::vector<std::string> closingLines() const override;

  // Of one boundary, or of all of them.
  struct Totals {
    double rate = 0.0;         // kg/s per metre depth or radian, mean of the last step
    double largestFlux = 0.0;  // kg/m^2/s, of all faces
    double mass = 0.0;         // kg per metre depth or radian, since the start
    double area = 0.0;         // m^2 per metre depth or radian
    [[nodiscard]] double meanFlux() const { return area > 0.0 ? rate / area : 0.0; }
  };
  // Collective. In the order of the context's boundaries; zero where a boundary has taken none. The same to the last
  // bit on any number of ranks.
  [[nodiscard]] std::vector<Totals> totals() const;

  // The faces of a boundary along it, in the order of their numbers.
  struct Face {
    std::int64_t number = 0;  // permanent
    Vector3 place{};          // m
    double area = 0.0;        // m^2 per metre depth or radian
    double flux = 0.0;        // kg/m^2/s, mean of the last step
    double mass = 0.0;        // kg/m^2, since the start
  };
  // Collective; on rank 0, none elsewhere.
  [[nodiscard]] std::vector<Face> facesOf(int boundary) const;

 private:
  const FlowContext& context_;
  std::string material_;
  std::vector<double> rate_, mass_;  // of the local faces, those between cells too, as archives have faces
  std::vector<Totals> last_;         // of the last row of the history
};

}  // namespace lampblack::flow
