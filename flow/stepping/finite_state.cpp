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

struct Field {
  const char* name;
  const std::vector<double>* values;
  std::size_t width;
};

// All that has values of cells.
std::array<Field, 8> fieldsOf(const State& state) {
  const auto scalars = static_cast<std::size_t>(state.carriedCount());
  return {{{"velocity", &state.velocity, static_cast<std::size_t>(state.dimension)},
           {"swirl velocity", &state.swirl, state.swirls ? std::size_t{1} : 0},
           {"pressure", &state.pressure, 1},
           {"temperature", &state.temperature, 1},
           {"density", &state.density, 1},
           {"enthalpy", &state.enthalpy, 1},
           {"mass fraction", &state.Y, static_cast<std::size_t>(state.species)},
           {"carried scalar", &state.carried, scalars}}};
}

std::string nameOf(const FlowContext& context, const State& state, const Field& field, std::size_t i) {
  if (field.values == &state.Y) return "mass fraction of " + context.mechanism.speciesName(i);
  if (field.values == &state.carried) return state.scalars[i].name;
  return field.name;
}

// What is wrong in a cell, or nothing.
std::string faultIn(const FlowContext& context, const State& state, std::size_t cell) {
  for (const Field& field : fieldsOf(state))
    for (std::size_t i = 0; i < field.width; ++i)
      if (const double value = (*field.values)[cell * field.width + i]; !std::isfinite(value))
        return fmt::format("the {} is {}", nameOf(context, state, field, i), value);
  return {};
}

}  // namespace

bool isFinite(const Mesh& m, const State& state) {
  const auto owned = static_cast<std::size_t>(m.owned);
  bool finite = std::isfinite(state.thermodynamicPressure) && allFinite(state.massFlux.data(), state.massFlux.size());
  for (const Field& field : fieldsOf(state)) finite = allFinite(field.values->data(), owned * field.width) && finite;
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
    if (const std::string fault = faultIn(context, state, static_cast<std::size_t>(c)); !fault.empty())
      blame(m.naturalCell[c], fault, m.centre[c]);
  // Faces, and what all cells have in common, stand behind the cells.
  for (int face = 0; face < m.faces; ++face)
    if (!std::isfinite(state.massFlux[face]))
      blame(m.totalCells + m.naturalCell[m.low[face]], fmt::format("the mass flux is {}", state.massFlux[face]),
            m.faceCentre[face]);
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
