// The parts of reading a flow deck; used by readFlowCase alone.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "app/problems/flow/flow_case.hpp"
#include "core/modules.hpp"
#include "io/deck_keys.hpp"

namespace lampblack::app::flowcase {

// Of a mesh, two or three.
using AxisNames = std::vector<std::string>;

AxisNames axisNames(Geometry geometry, int dimension);
inline AxisNames axisNames(const FlowCase& flowCase) {
  return axisNames(flowCase.mesh.geometry, flowCase.dimension);
}
// "the axes of this mesh are r and z".
std::string axesText(const AxisNames& names);

// The section mesh: a box with its solids, floor and ceiling, or a file; its keys, and reading it.
void addMeshKeys(DeckSchema& schema);
void readMesh(const Deck& deck, FlowCase& flowCase);

// Tells the user where an edge, of what is named, lies inside a cell of an axis.
void noteEdgeInside(FlowCase& flowCase, const std::string& what, double edge, const std::vector<double>& vertices);

// Mass fractions of a composition that the deck gives as mole fractions.
std::vector<double> readComposition(const Deck& deck, const std::string& key, const Mechanism& mechanism);

// The section boundaries, on the mesh that has been read: along every side one boundary follows the other.
void readBoundaries(const Deck& deck, FlowCase& flowCase);

// The axis that `from` and `to` of a side go along, which is normal to `axis`.
std::size_t alongSide(int axis);
// Adds the boundary of the axis of an axisymmetric box, a symmetry without area, where the deck names none.
void addAxis(FlowCase& flowCase);
// InputError where a side of the box, or the surface of a solid, is not covered by boundaries, each once.
void checkSides(const Deck& deck, FlowCase& flowCase);

// The section initial, when boundaries, particles and the model of turbulence have been read.
void readInitial(const Deck& deck, FlowCase& flowCase);

// The section particles, when the chemistry has been read.
void readSoot(const Deck& deck, FlowCase& flowCase);
// What of the particles is there at the start, behind readInitial().
void readCarriedStart(const Deck& deck, FlowCase& flowCase);
// The section trajectories, behind readSoot() and readCarriedStart().
void readTrajectories(const Deck& deck, FlowCase& flowCase);

// What a name is in those of files and of groups of the results: other characters than letters, digits, _, - and +
// become _.
std::string fileNameOf(std::string name);

// The section time: its keys, and reading it with what else the steps depend on, when boundaries, start and particles
// have been read. readRounds: of gas and ensembles in turn, behind both.
void addTimeKeys(DeckSchema& schema);
void addSteadyKeys(DeckSchema& schema);           // of time.steady
[[nodiscard]] bool isSearched(const Deck& deck);  // whether the run looks for a steady state
std::optional<SteadyControl> readSteady(const Deck& deck, const FlowCase& flowCase);
void addBranchKeys(DeckSchema& schema);  // of time.steady.continuation
std::optional<TimeControl::Branch> readBranch(const Deck& deck, const TimeControl::Search& search,
                                              const FlowCase& flowCase);
TimeControl::Search readSearch(const Deck& deck, const FlowCase& flowCase);
void readRounds(const Deck& deck, FlowCase& flowCase);
void readTime(const Deck& deck, FlowCase& flowCase);

// The section turbulence and what inlets bring of it: their keys, and reading them when boundaries, particles and start
// have been read.
void addTurbulenceKeys(DeckSchema& schema);
void readTurbulence(const Deck& deck, FlowCase& flowCase);
// Which model, and nothing else: before the start, which may have its variables.
void readTurbulenceModel(const Deck& deck, FlowCase& flowCase);

// The section combustion: its keys, and reading it when turbulence and particles have been read.
void addCombustionKeys(DeckSchema& schema);
void readCombustion(const Deck& deck, FlowCase& flowCase);

// Keys of a section (below that of `keys`) that names two streams, and the mixture fraction between them when the
// boundaries have been read.
void addStreamKeys(SectionKeys& keys, const std::string& section);
MixtureFraction readMixtureFraction(const Deck& deck, const std::string& section, const FlowCase& flowCase);

// The section chemistry: its keys, and reading it when the boundaries have been read.
void addChemistryKeys(DeckSchema& schema);
void readChemistry(const Deck& deck, FlowCase& flowCase);

// The section output: its keys, and reading it when mesh, boundaries and times have been read.
void addOutputKeys(DeckSchema& schema);
void readOutput(const Deck& deck, FlowCase& flowCase);

}  // namespace lampblack::app::flowcase
