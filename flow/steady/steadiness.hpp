// How far a flow is from steady: by how much its fields change in the time that the gas takes to pass through, and
// whether it repeats itself (docs/theory/flow.md, "Steady").
//
// The change of a field over a piece of time is the difference of the largest and the smallest value that a cell had
// in it, over the range of the field in the domain at its end: so nothing that happens between two looks is missed, and
// the length of the steps does not count. A piece is a quarter of the time that changes are told for; the change over
// that time is the sum over its pieces, which is what it is where fields go one way, and more where they go to and fro.
#pragma once

#include <array>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "core/state_archive.hpp"
#include "flow/field_registry.hpp"
#include "flow/flow_context.hpp"
#include "flow/properties/gas_properties.hpp"
#include "flow/state.hpp"
#include "flow/steady/periodicity.hpp"

namespace lampblack::flow {

// m, root of the area of a plane domain or third root of the volume, of an axisymmetric one all around; of the volume
// in m^3 or per metre or radian.
[[nodiscard]] double lengthOfDomain(const Mesh& mesh, double volume);

// Least scales by which changes and residuals are divided, of fields that are the same all over the domain.
struct LeastScales {
  static constexpr double temperature = 1e-3;  // of the largest
  static constexpr double massFraction = 1e-6;
  static constexpr double velocity = 1e-3;  // of the length of the domain over the time
  static constexpr double carried = 1e-6;   // of what counts as nothing
};

class Steadiness {
 public:
  struct Options {
    std::optional<double> time = {};  // s, that changes are told for; nothing: what the flow gives (time())
    bool hasParticles = true;         // whether carried scalars count; false: they are noise
  };
  enum class Norm { Maximum, Rms };  // over the cells; of the RMS each counts with its volume

  Steadiness(const FlowContext& context, const State& state, Options options);

  // W/m^3, of the owned cells.
  using HeatRelease = std::function<std::vector<double>()>;

  // Forgets all, and starts from the state at a time (s).
  void begin(const State& state, double time);
  // Forgets all, and has the flow of a state that no time has led to, as if it had lasted until `time`. Collective.
  void adopt(const State& state, const GasProperties& properties, double time);
  // The state after a step that was taken. Collective.
  void add(const State& state, const GasProperties& properties, const HeatRelease& heatRelease, double time);

  // s, that changes are told for. That of the flow, a mean over the pieces: what is in the domain over what flows
  // through its boundaries; without a flow through, the length of the domain (root of its volume) over the RMS
  // velocity, but no more than heat takes to be conducted over that length. Infinite where nothing is known yet.
  [[nodiscard]] double time() const;
  [[nodiscard]] std::string meaningOfTime() const;  // "residence time: ..."
  [[nodiscard]] double lengthOfDomain() const;      // m, root of its area or third root of its volume
  // W (per metre or radian), heat release that cannot be told from none: it warms what passes in time() by some
  // thousandths of a kelvin. In cold gas the rates of traces set free about as much, to and fro.
  [[nodiscard]] double leastHeat() const;

  // Of the field that changes most.
  struct Change {
    double value = 0.0;    // of the field's range, over time()
    std::string field;     // "temperature"
    Vector3 place{};       // m, where the maximum of the last piece was
    bool isWhole = false;  // whether pieces cover time(); else it is extrapolated
    bool grows = false;    // whether the last piece changed faster than the mean of all
  };
  // Nothing before the end of the first piece.
  [[nodiscard]] std::optional<Change> change(Norm norm) const;
  // Whether a whole time() has passed with no more change than that, and the change does not grow.
  [[nodiscard]] bool isSteady(double tolerance, Norm norm) const;

  // As of the end of the last piece.
  [[nodiscard]] const std::optional<Periodicity>& periodicity() const { return periodicity_; }

  // "in the last 0.0123 s (what is in the domain over the flow through it) temperature changed by ..." and how it
  // repeats itself; for the closing report.
  [[nodiscard]] std::vector<std::string> lines() const;

  // The mesh has been partitioned anew; what is kept is then loaded.
  void moveTo(const FlowContext& context);
  // Collective. Names begin with the prefix, where there is another.
  void saveOrLoad(StateArchive& archive, const std::string& prefix = "");

 private:
  // What integrals over time are made of, each times s.
  enum Sum { Duration, Mass, Through, KineticEnergy, Conduction, Sums };
  using Integrals = std::array<double, Sums>;
  // Of a state over a second, and more of it: momentum along each axis.
  struct Totals {
    Integrals flow{};
    std::array<double, 3> momentum{};
  };
  [[nodiscard]] Totals totalsOf(const State& state, const GasProperties& properties) const;  // collective
  // What is looked at by itself: a field, a species or a carried scalar.
  struct Field {
    FieldDeclaration::Width width;
    std::string name;
    std::string peers;  // of a carried scalar: the owner and the unit
    int first = 0, components = 1;
  };
  struct Piece {
    Integrals sums{};
    std::vector<double> maximum, rms;  // of each field
    std::vector<double> places;        // m, three a field, of the maximum
  };

  [[nodiscard]] bool isWatched(const FieldDeclaration& field) const;
  [[nodiscard]] int widthOf(const FieldDeclaration& field, const State& state) const;
  template <typename Take>
  void forEachValue(const State& state, Take take) const;
  [[nodiscard]] double timeOf(const Integrals& sums) const;
  [[nodiscard]] bool hasThroughflow(const Integrals& sums) const;
  [[nodiscard]] Integrals sumsOfPieces() const;
  [[nodiscard]] double changeOf(std::size_t field, Norm norm) const;
  void startPiece(const State& state);
  void closePiece(const State& state);
  [[nodiscard]] std::vector<double> scales(const State& state) const;
  void dropOldPieces();
  void record(const std::vector<double>& values, double time);
  void findPeriod();

  const FlowContext* context_;
  Options options_;
  std::vector<Field> fields_;
  int width_ = 0;                     // values a cell
  double volume_ = 0.0;               // of the domain, m^3 or per radian or metre
  double last_ = 0.0;                 // s, of the last state
  Integrals sums_{};                  // of the present piece
  std::vector<double> low_, high_;    // of the values of the owned cells in it
  std::array<double, 2> pressure_{};  // Pa, lowest and highest thermodynamic pressure in it
  double pressureNow_ = 0.0;
  std::deque<Piece> pieces_;
  std::vector<double> times_;  // s, of the record
  std::vector<RecordedSignal> signals_;
  std::optional<Periodicity> periodicity_;
};

}  // namespace lampblack::flow
