// Checkpoints of a flow: when they are written, what of the run they must have in common, which of them are kept.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/problems/flow/flow_case.hpp"
#include "core/mesh.hpp"
#include "core/modules.hpp"
#include "flow/state.hpp"
#include "io/checkpoint_file.hpp"
#include "io/checkpoint_folder.hpp"
#include "io/results_writer.hpp"

namespace lampblack::app {

// Global numbers of the cells and faces of a mesh.
StateNumbers stateNumbers(const Mesh& mesh);

// What decides what the numbers of a checkpoint mean: mesh, boundaries and their kinds, mechanism, pressure,
// scalars of particles, turbulence model.
Fingerprint flowFingerprint(const FlowCase& flowCase, const std::vector<CarriedScalar>& scalars);

class FlowCheckpoints {
 public:
  using Save = std::function<void(CheckpointWriter&)>;

  FlowCheckpoints(MPI_Comm comm, CheckpointControl control, Fingerprint fingerprint,
                  const std::filesystem::path& runFolder);

  // The run went on from this one at this step.
  void startedFrom(const WholeCheckpoint& checkpoint, std::int64_t step);

  // Whether this rank knows that one is to be written after this step: by the deck, a signal, or the file that asks for
  // it. One rank is enough; what a signal has asked for is told once.
  [[nodiscard]] bool wants(std::int64_t step);
  // Collective. Where the disk is full a SystemError; the former checkpoints stay.
  void write(const Mesh& mesh, std::int64_t step, const ResultsWriter& results, const Save& save);
  // The last that was written, or gone on from; may be empty.
  [[nodiscard]] const std::filesystem::path& last() const { return current_.file; }

 private:
  MPI_Comm comm_;
  int rank_ = 0;
  CheckpointControl control_;
  Fingerprint fingerprint_;
  CheckpointFolder folder_;
  WholeCheckpoint current_, former_;
  std::int64_t step_ = 0;         // of the current one
  std::size_t savedOutputs_ = 0;  // steps of the results that current_.outputs hold
  bool ownOutputs_ = false;       // whether current_.outputs were saved by this run
  double since_;                  // wall time of the last attempt, s
};

}  // namespace lampblack::app
