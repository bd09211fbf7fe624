// Cells whose reactions grow faster than a time step can follow, with their neighbours: what a step brings about in
// them is found in parts of the step, in each of which transport and reactions answer to each other
// (docs/theory/flow.md, "Reactions that outrun a step").
//
// Transport is known by its rates in a reference state and linear in what cells differ from it: diffusion by its
// conductances, convection upwind. Cells outside stay as in the reference. Plain data of any number of ranks; what is
// found depends on it alone. Each rank advances the reactions of the cells that it has added; the small linear systems
// between the parts are solved on all of them.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "chemistry/thermo/thermo.hpp"
#include "core/modules.hpp"
#include "flow/models/cell_reactor.hpp"

namespace lampblack::flow {

class CoupledCells {
 public:
  explicit CoupledCells(std::size_t species) : n_(species) {}

  // A cell at the step's start, by its permanent number. Rows have a value a species.
  struct Cell {
    std::int64_t number = 0;
    double mass = 0.0;         // kg
    double pressure = 0.0;     // Pa
    double temperature = 0.0;  // K
    double enthalpy = 0.0;     // J/kg
    double referenceTemperature = 0.0, referenceEnthalpy = 0.0;
    double heat = 0.0;              // W, enthalpy that everything but the reactions brings in the reference
    std::vector<double> Y;          // mass fractions
    std::vector<double> reference;  // mass fractions
    std::vector<double> brought;    // kg/s, the same of species
    std::vector<double> reacts;     // kg/s, guess of what the reactions make
    CellMixing mixing = {};
  };
  // Between two cells by their numbers, or a cell and the outside (high: none).
  struct Link {
    static constexpr std::int64_t none = -1;
    std::int64_t face = 0, low = 0, high = none;  // permanent numbers
    double flow = 0.0;                            // kg/s, from low to high
    double conducts = 0.0;                        // W/K
    std::vector<double> diffuses;                 // kg/s, conductances
  };
  // A cell whose reactions are to be advanced, with all else as a constant source.
  struct Reacting {
    std::int64_t number = 0;
    CellReactor::Gas gas;            // temperature and first step in and out
    double cost = 0.0;               // of the last part, out; zero at first
    std::span<double> Y;             // in and out
    std::span<const double> source;  // 1/s
  };
  // Collective. Advances these cells of this rank by dt (s).
  using React = std::function<void(std::span<Reacting> cells, double dt)>;

  void add(Cell cell) { cells_.push_back(std::move(cell)); }
  void add(Link link) { links_.push_back(std::move(link)); }

  // Collective. All ranks have the cells and links of all.
  void gather(MPI_Comm comm);

  // Collective, after gather(). Over dt (s) in so many parts.
  void advance(MPI_Comm comm, const React& react, const Thermo& thermo, double dt, int parts);
  // After it: kg/s, what the reactions made in a cell, the mean over the step.
  [[nodiscard]] std::span<const double> made(std::int64_t number) const;

 private:
  [[nodiscard]] std::size_t placeOf(std::int64_t number) const;
  void connect();
  void advanceReactions(MPI_Comm comm, const React& react, double part);
  void solve(std::size_t field, double dt, std::span<const double> inertia, std::vector<double>& x) const;

  std::size_t n_;
  std::vector<Cell> cells_;
  std::vector<Link> links_;
  std::vector<std::size_t> own_;                        // cells that this rank has added
  std::vector<std::size_t> first_, other_;              // of each cell, its neighbours
  std::vector<std::vector<double>> weights_, outward_;  // of each field, for each neighbour and each cell
  std::vector<std::vector<double>> made_;
  // Of each cell: what everything but the reactions brings in the present part, 1/s and W/kg; and its reactor's.
  std::vector<std::vector<double>> source_;
  std::vector<double> heating_, firstStep_, cost_;
};

}  // namespace lampblack::flow
