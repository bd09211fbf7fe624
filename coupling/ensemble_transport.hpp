// How the particles of ensembles in the cells of a flow move from cell to cell: whole numerical particles are drawn,
// each with the probability that the finite-volume flux of what it stands for gives, so that every moment has the mean
// of a carried scalar. What leaves a cell comes into another or goes out: nothing is lost but to round-off.
//
// Through a face, a particle of the cell `d` with the gas mass M_d at the step's start goes in dt with the probability
//
//   p = dt/M_d [ max(m, 0) r + G(D + D_t) o ],   m = gas's mass flux out of d + thermophoresis, G = rho_f A D /
//   distance,
//
// as carried scalars do: by upwind convection with the value at the face over that in the cell (r), and by diffusion
// both ways, in a turbulent flow with that of the eddies D_t, which is the same for all. A wall that takes particles
// has the flux of drift and diffusion to it (flow/boundaries/wall_flux.hpp, flow/properties/wall_transfer.hpp), each
// particle by its own diffusivity. r is of second order in place and time: linear in the cell, by the gradient of the
// particles of like size per mass of gas, at the place from which the gas reaches the face in the middle of the time;
// it is limited to between 0 and 2, which no face value of a smooth field exceeds, and to nothing else: a limiter of
// slopes would bias what is noisy. o corrects diffusion where the step from cell to cell is oblique to the face. Like
// sizes: volumes within a factor of eight.
//
// Half a step is taken in parts where more would leave a cell than may. Each class of like sizes goes by as many as it
// needs: light particles in all of them, heavy ones, which diffuse less, in some, over several together. What a class
// does depends on itself alone.
//
// Who goes is drawn by two random numbers of the cell and part of the step: results do not depend on ranks. Particles
// of a cell are put in order of size once in a half of a step; in each part the teeth of a comb, as far from one
// another as no probability of that size is above, hit those that are looked at, and evenly spread points
// (nextEvenPoint) tell whether one of them goes, and where: a part costs what leaves in it, not what is there. A
// numerical particle that stands for more than twice the mean goes in pieces, so that the number does not leap, but for
// a cell's own where all of these stand for equal numbers.
// docs/theory/ensembles_in_cells.md.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "core/random.hpp"
#include "flow/discretisation/gradient.hpp"
#include "flow/flow_context.hpp"
#include "flow/properties/gas_properties.hpp"
#include "flow/state.hpp"
#include "particles/ensemble/packed_ensemble.hpp"
#include "particles/soot/soot_aggregate.hpp"
#include "particles/stochastic/particle_rows.hpp"

namespace lampblack::coupling {

class EnsembleTransport {
 public:
  struct Options {
    SootAggregate type;
    double thermophoresis = 0.0;  // V = -thermophoresis (mu/rho) grad T / T
    bool diffusion = true;
    bool secondOrder = true;  // false: upwind values, r = 1
    std::uint64_t seed = 1;
    ParticleRows rows{packedHead};
  };
  // The gas of the step, whose mass fluxes are those that moved it: fields of all local cells and faces.
  struct Gas {
    const State& state;                   // with State::start
    std::span<const double> driftFlux;    // kg/s, faces (CarriedTransport)
    std::span<const double> faceDensity;  // kg/m3
    const GasProperties& properties;
  };
  // Particles in rows, as packed populations have them, behind a head; arrived ones without it.
  using Rows = std::vector<double>;

  EnsembleTransport(const FlowContext& context, Options options);
  ~EnsembleTransport();

  enum class Half { First, Second };
  // Collective. Takes out of each owned cell's population those that leave in one half of a step of dt, and adds to
  // `arrived` of each cell those that come, with their numbers per volume there. Those that have arrived before may
  // leave as well. `step`: which step of the run it is.
  void advance(const Gas& gas, double dt, std::uint64_t step, Half half, std::vector<Rows>& populations,
               std::vector<Rows>& arrived);

  // Rows of what left through the boundary in the last step, of this rank's cells: numbers per metre depth or radian;
  // and the face of each.
  [[nodiscard]] const Rows& gone() const { return gone_; }
  [[nodiscard]] const std::vector<int>& goneThrough() const { return goneThrough_; }
  // In how many parts the halves of the last step were taken for those that need most, so that no cell gives more than
  // it has: two at least.
  [[nodiscard]] int parts() const { return parts_; }
  // How many numerical particles of this rank's cells moved in the last step, once a part, with a probability that was
  // limited: r, o or the sum over all faces.
  [[nodiscard]] std::int64_t limited() const { return limited_; }

 private:
  static constexpr int classes = 12;    // of size
  static constexpr int smallest = -94;  // log2 of the smallest volume, m3: 0.5 nm
  // Of the tables of diffusivities, a factor of two in volume each: up to 1.9 um, beyond which D d^2 stays as it is.
  static constexpr std::size_t nodes = 37;
  static constexpr std::size_t sidesTogether = 8;
  static_assert(Mesh::mostSides <= sidesTogether);
  using SideValues = std::array<double, sidesTogether>;  // of each side of a cell
  struct Side;
  struct SideLanes;
  struct Size;
  struct Stock;
  struct Leaving;
  struct Content;
  struct Draw;
  struct Hit;

  [[nodiscard]] static int classOf(double volume);
  [[nodiscard]] double volumeOf(const double* row) const { return massAt(row) * perDensity_; }
  const double* diffusivityOf(const Gas& gas, int cell);
  void takeStock(int cell, std::span<const double> population, std::span<const double> arrived);
  void findBoundaries(const Gas& gas);
  void findDensities(const Gas& gas, double part);
  void findSides(const Gas& gas, int cell, double dt, double mass, std::vector<Side>& sides);
  void findWallDiffusion(const Gas& gas, int cell, double share, int face, std::size_t side);
  [[nodiscard]] double outflow(const Gas& gas, int face, int cell) const;
  // Whether particles diffuse through a face by themselves.
  [[nodiscard]] bool diffuses(int face) const;
  // kg/s of gas, that eddies exchange through a face.
  [[nodiscard]] double stirredThrough(const Gas& gas, int face) const;
  [[nodiscard]] double massOf(const Gas& gas, int cell, double part) const;
  [[nodiscard]] Size sizeOf(double volume, double d, double primaries) const;
  [[nodiscard]] double sumChances(const Size& size, const std::vector<Side>& sides, SideValues& upTo) const;
  void boundChances(const std::vector<Side>& sides, std::span<double, nodes> bounds) const;
  void drawLeaving(int cell, const std::vector<Side>& sides, RandomStream& random, Rows& population, Rows& arrived);
  // Whether the one at this place of a cell (Content) may go in pieces.
  [[nodiscard]] bool goesInPieces(std::uint32_t place) const;
  void drawPieces(Draw& draw, double* row, bool inPieces);
  void measureHits(const Rows& population, const Rows& arrived);
  void drawHits(Draw& draw, double* row, const Size& size, std::span<const Hit> hits);
  void leave(Draw& draw, double* row, int ofClass, const SideValues& pieces, double of);
  void removeGone(Rows& rows, std::size_t head) const;
  void send(std::vector<Rows>& arrived);
  [[nodiscard]] int findParts(const Gas& gas, double dt);
  void beginPart(int part, int parts);
  [[nodiscard]] bool hasMoving(int cell) const;

  const FlowContext& context_;
  Options options_;
  double perDensity_;  // of the particles, m3/kg
  Gradient gradient_;
  std::vector<BoundaryData> known_;          // of the particles at each boundary face
  std::array<int, classes> together_{};      // parts that each class takes at once; zero: it does not move
  std::array<double, classes> lengths_{};    // of the present part: so many of them, or zero
  std::vector<int> moving_;                  // classes that move in it
  std::size_t firstNode_ = 0, endNode_ = 0;  // those that their chances depend on
  std::vector<double> density_, gradients_;  // numbers of each class that moves per mass of gas, 1/kg
  std::vector<double> nothing_;              // at the boundary
  std::vector<double> diffusivity_;          // of local cells: D d^2 at the nodes, m4/s
  std::vector<char> isFound_;                // whether it is that of this half of the step
  struct Node {
    double diameter, perSquare;  // m, 1/m2
    int ofClass;
  };
  std::array<Node, nodes> nodes_{};
  std::vector<Content> contents_;     // of the owned cells, in this half of the step
  std::vector<std::uint32_t> order_;  // of all of them: places of particles by size (Content)
  std::vector<Stock> stock_;          // of a cell's particles
  std::vector<Hit> hits_;
  std::vector<double> volumes_, diameters_;  // of those hit
  std::unique_ptr<SideLanes> lanes_;
  std::vector<Leaving> leaving_;
  std::vector<int> facesInOrder_;  // of each owned cell, as Mesh::faceOfCell, by their permanent numbers
  struct Chain {
    int first, last;  // places in leaving_, or -1
  };
  std::vector<Chain> comingThrough_;  // of each interior face: to its low side, to its high side
  Rows leavingRows_, gone_;
  std::vector<int> goneThrough_;
  int parts_ = 0;
  std::int64_t limited_ = 0;
};

}  // namespace lampblack::coupling
