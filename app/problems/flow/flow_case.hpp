// What a deck with `problem: flow` asks for, checked and in SI: the bridge from the words of the deck to the operators.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/deck/checkpoint_deck.hpp"
#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/thermo/mixture_fraction.hpp"
#include "core/mesh.hpp"
#include "core/modules.hpp"
#include "coupling/ensemble_operator.hpp"
#include "flow/boundaries/boundary.hpp"
#include "flow/initial_fields.hpp"
#include "flow/mixing_layer.hpp"
#include "flow/models/carried_model.hpp"
#include "flow/models/carried_operator.hpp"
#include "flow/models/combustion/combustion_operator.hpp"
#include "flow/models/radiation.hpp"
#include "flow/models/reaction_operator.hpp"
#include "flow/models/turbulence/turbulence_operator.hpp"
#include "flow/properties/transport_model.hpp"
#include "flow/steady/flow_branch.hpp"
#include "flow/steady/leading_modes.hpp"
#include "flow/steady/steadiness.hpp"
#include "flow/steady/steady_rounds.hpp"
#include "flow/steady/steady_search.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "io/deck.hpp"
#include "io/file_storage.hpp"
#include "particles/gas/soot_gas.hpp"

namespace lampblack::app {

class PreparedRun;

// When a run that does not change any more ends.
struct SteadyControl {
  double tolerance = 1e-3;
  std::optional<double> time;  // s, over which changes are counted; nothing: what the flow gives
  double after = 0.0;          // s, before which the run does not end
  Steadiness::Norm norm = Steadiness::Norm::Maximum;
};

struct TimeControl {
  double end = 0.0;                  // s
  double firstStep = 1e-6;           // s
  double maximumStep = 1.0;          // s
  double growth = 1.2;               // of the step from one to the next, at most
  std::optional<double> tolerance;   // of a step; nothing: steps do not look at their errors
  int retries = 4;                   // of a step that fails, each with a quarter of the step before
  std::optional<double> wallLimit;   // s, from the start of the program
  double temperatureChange = 500.0;  // K, of a cell in a step; more and the step fails
  double leastMassFraction = -1e-4;  // of a cell; below and the step fails
  std::optional<SteadyControl> steady;
  // Whether the steady state that was found lasts.
  struct Stability {
    std::optional<double> time;  // s, of a march; nothing: what the flow gives
    ModeOptions modes;
  };
  // Of steady states, from the one that was found.
  struct Branch : FlowBranch::Options {
    std::string key;         // that the load is a factor on; empty: the velocities of all inlets
    double start = 1.0;      // its value there, in SI
    std::string unit = "1";  // of that
  };
  // In place of a run until `end`, which is then infinite, the search for the steady state.
  struct Search : SteadySearch::Options {
    std::optional<double> time = {};  // s, as SteadyControl::time
    bool triesWithoutFlame = false;   // whether there are attempts in gas that cannot burn
    bool oneTime = false;             // iterations are implicit steps of one time until a flame in eddies stands
    int coarserMeshes = 0;            // on which the state is sought first
    // What came of the search on each of these, the coarsest first; of the mesh itself nothing.
    struct Coarser {
      std::int64_t cells = 0;
      bool isSteady = false, isStart = false;  // whether it was found, and whether the next mesh starts from there
      int steps = 0, iterations = 0;
      double processorTime = 0.0;  // s, of all ranks
    };
    std::vector<Coarser> coarser = {};
    bool lights = true;  // what was lit by the start and does not burn once the steps in time are over
    std::optional<Stability> stability = {};
    std::optional<Branch> branch = {};
    std::optional<SteadyRounds::Options> rounds = {};  // of gas and ensembles in turn
  };
  std::optional<Search> search;

  // s, that changes and residuals are told for; nothing: what the flow gives.
  [[nodiscard]] std::optional<double> steadyTime() const {
    return search ? search->time : steady ? steady->time : std::nullopt;
  }
};

// Tables beside the fields and the history.
struct OutputTables {
  struct Probe {
    std::string name;
    Vector3 at{};  // m
  };
  struct Line {
    std::string name;
    Vector3 from{}, to{};  // m
    int points = 2;
  };
  struct Region {
    std::string name;
    Vector3 from{}, to{};  // m
  };
  std::vector<Probe> probes;
  std::vector<Line> lines;
  std::vector<Region> regions;          // of ensembles
  std::vector<std::string> quantities;  // fields of both; empty: the usual ones
  std::vector<std::size_t> boundaries;  // numbers in FlowCase::boundaries
  std::optional<Deck> deck;             // whose lines messages point at
};

struct OutputControl {
  double interval = 0.0;                           // s between field outputs
  int historySteps = 1;                            // steps between rows of the history
  std::vector<std::size_t> species;                // mole fractions written
  bool wallDistance = false;                       // whether it is a field
  std::optional<MixtureFraction> mixtureFraction;  // a field where it is there
  FileStorage storage;
  OutputTables tables;
};

// When checkpoints are written besides when they are asked for.
struct CheckpointControl : CheckpointTimes {
  std::optional<std::int64_t> steps;  // between two
};

struct TrajectoryRequest {
  std::vector<Vector3> starts;  // m, along the mesh's axes
  double duration = 0.0;        // s, at most
  double timeStep = 0.0;        // s, between samples of the gas
  MakePopulation make;
  SizeBins bins;
  bool gasTables = false;    // the gas of each path as a table for prescribed_gas
  std::optional<Deck> deck;  // whose lines messages point at
};

// A mesh made by other programs, in place of a box.
struct MeshFile {
  std::filesystem::path path;
  double unit = 1.0;  // m, of one unit of the file
  Deck deck;          // whose lines messages point at
  // Names of its surface whose faces are one with others.
  std::vector<std::string> periodic;
  std::string content;  // a hash, once the mesh is made
};

struct TurbulenceCase {
  std::shared_ptr<const TurbulenceModel> model;  // null: none
  EddyNumbers numbers;
  bool ignoresWalls = false;  // the wall distance is infinite
  TurbulenceOperator::Options options;
  FreeStream start;
  std::vector<FreeStream> boundaries;  // of each, what comes in there
};

struct FlowCase {
  std::string title;
  std::shared_ptr<const Mechanism> mechanism;
  double pressure = 0.0;  // Pa
  std::uint64_t seed = 0;
  MeshSpec mesh;                    // a box; of a mesh file its geometry alone
  std::vector<std::string> solids;  // names of mesh.leftOut
  int dimension = 2;
  std::optional<MeshFile> meshFile;
  std::optional<Partitioner> partitioner;  // empty: Curve for a box, for a mesh file what suits its size
  std::optional<double> repartition;  // busiest rank's cost over the mean, above which the mesh is partitioned anew
  std::vector<BoundaryCondition> boundaries;  // in the order of mesh.patches
  Vector3 gravity{0.0, 0.0, 0.0};             // m/s^2
  bool isDriven = false;                      // gravity is driving_acceleration
  double referenceDensity = 0.0;              // kg/m^3, FlowContext
  MixingLayer initial;
  InitialFields initialFields;  // over the layer
  bool swirls = false;          // axisymmetric, and something turns about the axis
  TimeControl time;
  OutputControl output;
  CheckpointControl checkpoint;
  TransportModel transport;
  ReactionOperator::Options chemistry;
  TransportOperator::Options flow;
  RadiationOptions radiation;
  TurbulenceCase turbulence;
  std::optional<CombustionOperator::Options> combustion;  // nothing: the reactions of the mean gas
  bool mixesParticles = false;                            // whether their rates go by the reacting share
  std::shared_ptr<CarriedModel> carried;                  // null: nothing
  std::optional<EnsembleOperator::Options> ensembles;     // in the cells; then nothing else is carried
  std::shared_ptr<CellParticles> cellParticles;           // of the ensembles
  // Packed, of the ensemble that a cell of this permanent number begins with; empty: nothing is there.
  std::function<std::vector<double>(std::uint64_t cell)> startPopulation;
  CarriedOperator::Options carriedOptions;
  std::optional<TrajectoryRequest> trajectories;
  std::vector<std::string> notes;  // what the user should be told before the run
};

// All keys a flow deck may have.
DeckSchema flowSchema();

// Reads the mechanism and checks what the schema cannot: names of species, patches, sides. InputError otherwise.
FlowCase readFlowCase(const Deck& deck);

// Collective; see Problem. Prepared are the mesh, the operators and the state at the start.
std::unique_ptr<PreparedRun> prepareFlow(MPI_Comm comm, const Deck& deck);

}  // namespace lampblack::app
