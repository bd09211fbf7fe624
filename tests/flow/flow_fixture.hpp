// What the flow tests share: the hydrogen mechanism's gas models, a box mesh with its boundary conditions, states to
// start from, and reductions over the ranks.
#pragma once

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/grading.hpp"
#include "flow/flow_context.hpp"
#include "flow/state.hpp"
#include "tests/core/mpi_support.hpp"
#include "tests/every_module.hpp"
#include "tests/skewed_mesh.hpp"
#include "tests/source_folder.hpp"

namespace lampblack::test {

// One gas for all tests of an executable: its transport fits are made once.
struct Gas {
  explicit Gas(const std::string& file) : Gas(Mechanism::fromFile(sourcePath("cases/mechanisms/" + file))) {}
  explicit Gas(Mechanism of) : mechanism(std::move(of)), thermo(mechanism), transport(mechanism) {}
  static Gas& hydrogen() {
    static Gas gas("hydrogen_h2o2_10.yaml");
    return gas;
  }
  // Mass fractions of a mixture given by mole fractions, "H2: 2, N2: 1".
  [[nodiscard]] std::vector<double> massFractions(std::string_view moles) const {
    const auto X = parseComposition(mechanism, moles);
    std::vector<double> Y(X.size());
    thermo.moleToMass(X, Y);
    return Y;
  }
  Mechanism mechanism;
  Thermo thermo;
  Transport transport;
};

// A measured number, for whoever reads a test's output: a line, of the first rank.
inline void report(const std::string& line) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank == 0) fmt::print("{}\n", line);
}

inline double minOverRanks(double value) {
  return -maxOverRanks(-value);
}
inline std::size_t at(std::ptrdiff_t index) {
  return static_cast<std::size_t>(index);
}

// One part of the surface and what happens there.
struct Side {
  BoundaryPatch patch;
  BoundaryCondition condition;
};
inline Side side(BoundaryKind kind, int axis, bool atMax) {
  Side s;
  s.patch = {"", axis, atMax};
  s.condition.kind = kind;
  s.condition.slip = true;
  s.patch.name = s.condition.name = std::string(1, "xyz"[axis]) + (atMax ? "max" : "min");
  return s;
}
inline Side opening(BoundaryKind kind, int axis, bool atMax, double speed, double temperature, std::vector<double> Y) {
  Side s = side(kind, axis, atMax);
  s.condition.speed = speed;
  s.condition.temperature = temperature;
  s.condition.Y = std::move(Y);
  return s;
}

// Vertices along each axis; none along the third in a plane.
using Axes = std::array<std::vector<double>, 3>;

// Other cells than the box's own: how they are made of those, and by how much of a cell inner vertices are moved.
struct Split {
  Cells cells;
  double jitter = 0.2;
};

struct Box {
  Box(Geometry geometry, Axes vertices, const std::vector<Side>& sides, Gas& gasOfBox = Gas::hydrogen(),
      std::optional<Split> split = {})
      : gas(gasOfBox),
        mesh(meshOf(specOf(geometry, std::move(vertices), sides), split)),
        halo(mesh),
        context{mesh, halo, gas.mechanism, gas.thermo, gas.transport, {}} {
    for (const Side& s : sides) context.boundaries.push_back(s.condition);
  }

  // Any mesh; the conditions are in the order of its patches.
  Box(const MeshSpec& spec, std::vector<BoundaryCondition> conditions, std::optional<Split> split = {},
      MPI_Comm comm = MPI_COMM_WORLD, Gas& gasOfBox = Gas::hydrogen())
      : gas(gasOfBox), mesh(meshOf(spec, split, comm)), halo(mesh), context{mesh,          halo,
                                                                            gas.mechanism, gas.thermo,
                                                                            gas.transport, std::move(conditions)} {}

  // A state at 1 atm of what `set` says at each cell's centre: velocity, temperature, mass fractions.
  struct Local {
    Vector3 velocity{};
    double temperature = 300.0;
    std::vector<double> Y;
  };
  // `carried`: particles, of one owner.
  State state(const std::function<Local(const Vector3&)>& set, std::vector<CarriedScalar> carried = {},
              bool swirls = false) {
    std::vector<ScalarBlock> blocks;
    if (!carried.empty()) blocks.push_back(takenByWalls({"particles", std::move(carried)}, context.boundaries));
    return stateWith(blocks, set, swirls);
  }
  State stateWith(const std::vector<ScalarBlock>& blocks, const std::function<Local(const Vector3&)>& set,
                  bool swirls = false) {
    const std::size_t n = gas.mechanism.numSpecies();
    State s(mesh, n, blocks, swirls);
    for (int c = 0; c < mesh.cells; ++c) {
      const Local local = set(mesh.centre[at(c)]);
      for (int i = 0; i < mesh.dimension; ++i) s.velocity[at(mesh.dimension * c + i)] = local.velocity[at(i)];
      s.temperature[at(c)] = local.temperature;
      s.density[at(c)] = gas.thermo.density(local.temperature, s.thermodynamicPressure, local.Y);
      s.enthalpy[at(c)] = gas.thermo.enthalpyMass(local.temperature, local.Y);
      std::copy(local.Y.begin(), local.Y.end(), s.Y.begin() + static_cast<std::ptrdiff_t>(at(c) * n));
    }
    return s;
  }

  Gas& gas;
  Mesh mesh;
  HaloExchange halo;
  FlowContext context;

 private:
  static Mesh meshOf(const MeshSpec& spec, const std::optional<Split>& split, MPI_Comm comm = MPI_COMM_WORLD) {
    if (!split) return {comm, spec};
    return {comm, SkewedMesh(comm, spec, split->cells, split->jitter).block(), spec.geometry};
  }
  static MeshSpec specOf(Geometry geometry, Axes vertices, const std::vector<Side>& sides) {
    MeshSpec spec;
    spec.geometry = geometry;
    spec.vertices = std::move(vertices);
    for (const Side& s : sides) spec.patches.push_back(s.patch);
    return spec;
  }
};

inline std::vector<double> uniformAxis(double to, int cells) {
  return gradedAxis(0.0, {{to, cells, 1.0}});
}

// Mass, species or any cell quantity, summed over the domain: volume times `perVolume`.
inline double integral(const Mesh& mesh, const std::function<double(int)>& perVolume) {
  double sum = 0.0;
  for (int c = 0; c < mesh.owned; ++c) sum += mesh.volume[at(c)] * perVolume(c);
  return sumOverRanks(sum);
}

// Largest value of any owned cell of any rank.
inline double largest(const Mesh& mesh, const std::function<double(int)>& value) {
  double most = -std::numeric_limits<double>::infinity();
  for (int c = 0; c < mesh.owned; ++c) most = std::max(most, value(c));
  return maxOverRanks(most);
}

}  // namespace lampblack::test
