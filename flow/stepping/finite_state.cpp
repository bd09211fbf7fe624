#include "flow/stepping/finite_state.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "core/errors.hpp"
#include "core/first_error.hpp"
#include "flow/cell_errors.hpp"
#include "flow/field_registry.hpp"

namespace lampblack::flow {
namespace {

// Zero times a number is zero, times anything else it is none. Eight sums, which the processor does at once.
bool allFinite(const double* values, std::size_t count) {
  constexpr std::size_t lanes = 8;
  std::array<double, lanes> sums{};
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes)
    for (std::size_t lane = 0; lane < lanes; ++lane) sums[lane] += 0.0 * values[i + lane];
  for (; i < count; ++i) sums[0] += 0.0 * values[i];
  double sum = 0.0;
  for (const double s : sums) sum += s;
  return sum == 0.0;
}

// What is wrong in a cell or at a face, or nothing.
std::string faultIn(const FlowContext& context, const State& state, bool isFace, int which) {
  for (const FieldDeclaration& field : fieldRegistry()) {
    if (!field.isChecked || isFace != (field.kind == FieldDeclaration::Kind::FaceFlux)) continue;
    const int width = field.widthIn(state);
    for (int i = 0; i < width; ++i)
      if (const double value = field.of(state)[static_cast<std::size_t>(which) * static_cast<std::size_t>(width) + i];
          !std::isfinite(value))
        return fmt::format("the {} is {}", field.nameOf(i, state, context.mechanism), value);
  }
  return {};
}

}  // namespace

bool isFinite(const Mesh& m, const State& state) {
  bool finite = std::isfinite(state.thermodynamicPressure);
  for (const FieldDeclaration& field : fieldRegistry()) {
    if (!field.isChecked) continue;
    // The halo is that of other ranks.
    const int count = field.kind == FieldDeclaration::Kind::FaceFlux ? m.faces : m.owned;
    finite = allFinite(field.of(state).data(), static_cast<std::size_t>(count) * field.widthIn(state)) && finite;
  }
  return finite;
}

void raiseNotFinite(const FlowContext& context, const State& state) {
  const Mesh& m = context.mesh;
  std::exception_ptr first;
  auto number = std::numeric_limits<std::int64_t>::max();
  const auto blame = [&](std::int64_t natural, const std::string& fault, const Vector3& place) {
    if (natural >= number) return;
    number = natural;
    first = std::make_exception_ptr(NumericsError(fmt::format("{} at {}", fault, placeText(place, m.dimension))));
  };
  for (int c = 0; c < m.owned; ++c)
    if (const std::string fault = faultIn(context, state, false, c); !fault.empty())
      blame(m.naturalCell[c], fault, m.centre[c]);
  // Faces, and what all cells have in common, stand behind the cells.
  for (int face = 0; face < m.faces; ++face)
    if (const std::string fault = faultIn(context, state, true, face); !fault.empty())
      blame(m.totalCells + m.naturalCell[m.low[face]], fault, m.faceCentre[face]);
  if (!std::isfinite(state.thermodynamicPressure))
    blame(3 * m.totalCells, fmt::format("the thermodynamic pressure is {}", state.thermodynamicPressure), {0.0, 0.0});
  raiseFirst(m.comm, first, number);
}

void raiseStandstill(const Mesh& mesh, const State& state, double dt) {
  const auto speed = [&](int c) {
    const double* u = &state.velocity[static_cast<std::size_t>(c) * static_cast<std::size_t>(mesh.dimension)];
    return std::hypot(u[0], u[1], mesh.dimension == 3 ? u[2] : 0.0);
  };
  const auto rate = [&](int c) {
    return speed(c) / (mesh.dimension == 3 ? std::cbrt(mesh.volume[c]) : std::sqrt(mesh.planarArea[c]));
  };
  double fastest = 0.0;
  for (int c = 0; c < mesh.owned; ++c) fastest = std::max(fastest, rate(c));
  MPI_Allreduce(MPI_IN_PLACE, &fastest, 1, MPI_DOUBLE, MPI_MAX, mesh.comm);
  inEachCell(mesh, [&](int c) {
    if (rate(c) >= fastest)
      throw NumericsError(
          fmt::format("time stands still: the step has come down to {:.3g} s, and the gas moves at {:.3g} m/s here; "
                      "look at the fields around this place",
                      dt, speed(c)));
  });
  throw std::logic_error("no cell is the fastest");
}

}  // namespace lampblack::flow
