#include "app/problems/flow/flow_checkpoint.hpp"

#include <fmt/format.h>

#include <utility>

#include "app/run/content_hash.hpp"
#include "chemistry/mechanism/mechanism_writer.hpp"
#include "core/errors.hpp"
#include "core/stop_request.hpp"

namespace lampblack::app {
namespace {

std::string hashed(const std::string& words, const std::string& text) {
  ContentHash hash;
  hash.add(text);
  return fmt::format("{}, {}", words, hash.text());
}

// Of a box the places of its vertices along the axes, what is left out, and where bent walls lie.
std::string boxText(const MeshSpec& mesh) {
  std::string text;
  for (const auto& axis : mesh.vertices)
    for (const double x : axis) text += fmt::format("{} ", x);
  for (const MeshSpec::LeftOut& part : mesh.leftOut)
    for (const auto& corner : {part.lower, part.upper})
      for (const double x : corner) text += fmt::format("{} ", x);
  if (mesh.map)
    for (const double x : mesh.vertices[0])
      for (const double y : {mesh.vertices[1].front(), mesh.vertices[1].back()})
        text += fmt::format("{} ", mesh.map({x, y, 0.0})[1]);
  return text;
}

std::string meshText(const FlowCase& flowCase) {
  const std::string geometry = flowCase.mesh.geometry == Geometry::Axisymmetric ? "axisymmetric"
                               : flowCase.dimension == 2                        ? "planar"
                                                                                : "space";
  if (flowCase.meshFile)
    return hashed(geometry + ", a file", fmt::format("{} {}", flowCase.meshFile->unit, flowCase.meshFile->content));
  std::string cells;
  for (int axis = 0; axis < flowCase.dimension; ++axis)
    cells +=
        fmt::format("{}{}", axis > 0 ? " x " : "", flowCase.mesh.vertices[static_cast<std::size_t>(axis)].size() - 1);
  return hashed(fmt::format("{}, {} cells", geometry, cells), boxText(flowCase.mesh));
}

std::string kindName(BoundaryKind kind) {
  switch (kind) {
    case BoundaryKind::Inlet:
      return "inlet";
    case BoundaryKind::Outlet:
      return "outlet";
    case BoundaryKind::Wall:
      return "wall";
    case BoundaryKind::Symmetry:
      return "symmetry";
  }
  return "unknown";
}

}  // namespace

StateNumbers stateNumbers(const Mesh& mesh) {
  return {{mesh.naturalCell.begin(), mesh.naturalCell.begin() + mesh.owned},
          mesh.faceNumber,
          mesh.totalCells,
          mesh.totalFaces};
}

Fingerprint flowFingerprint(const FlowCase& flowCase, const std::vector<CarriedScalar>& scalars) {
  std::string boundaries;
  std::string extents;
  for (std::size_t i = 0; i < flowCase.boundaries.size(); ++i) {
    const BoundaryCondition& boundary = flowCase.boundaries[i];
    boundaries += fmt::format("{}{}: {}", i > 0 ? ", " : "", boundary.name, kindName(boundary.kind));
    if (flowCase.meshFile) continue;
    const BoundaryPatch& patch = flowCase.mesh.patches[i];
    if (patch.leftOut >= 0)
      extents += fmt::format("solid {};", patch.leftOut);
    else
      extents += fmt::format("{} {} {} {};", patch.axis, patch.atMax, patch.from, patch.to);
  }
  // The variables of a turbulence model stand behind those of particles.
  const TurbulenceModel* turbulence = flowCase.turbulence.model.get();
  const std::size_t particles = scalars.size() - (turbulence != nullptr ? turbulence->variables().size() : 0);
  std::string carried;
  for (const CarriedScalar& scalar : std::span(scalars).first(particles))
    carried += fmt::format("{} {} {} {};", scalar.name, scalar.unit, scalar.description, scalar.thermophoresis);
  const Mechanism& mechanism = *flowCase.mechanism;
  return {
      {"mesh", meshText(flowCase)},
      {"boundaries", hashed(boundaries, extents)},
      {"mechanism", hashed(fmt::format("{} species, {} reactions", mechanism.numSpecies(), mechanism.numReactions()),
                           mechanismYaml(mechanism))},
      {"pressure", fmt::format("{} Pa", flowCase.pressure)},
      {"particle model", particles == 0 ? "no scalars" : hashed(fmt::format("{} scalars", particles), carried)},
      {"turbulence model", turbulence != nullptr ? turbulence->name() : "nothing"}};
}

FlowCheckpoints::FlowCheckpoints(MPI_Comm comm, CheckpointControl control, Fingerprint fingerprint,
                                 const std::filesystem::path& runFolder)
    : comm_(comm), control_(control), fingerprint_(std::move(fingerprint)), folder_(runFolder), since_(MPI_Wtime()) {
  MPI_Comm_rank(comm_, &rank_);
  watchForCheckpointSignal();
}

void FlowCheckpoints::startedFrom(const WholeCheckpoint& checkpoint, std::int64_t step) {
  current_ = checkpoint;
  step_ = step;
}

bool FlowCheckpoints::wants(std::int64_t step) {
  if (takeCheckpointSignal()) return true;
  if (rank_ != 0) return false;
  if (control_.steps && step != step_ && step % *control_.steps == 0) return true;
  if (step != step_ && MPI_Wtime() - since_ >= control_.wallTime) return true;
  std::error_code error;
  return std::filesystem::exists(folder_.request(), error);
}

void FlowCheckpoints::write(const Mesh& mesh, std::int64_t step, const ResultsWriter& results, const Save& save) {
  since_ = MPI_Wtime();
  collectively(comm_, [&] {
    if (rank_ != 0) return;
    std::error_code ignored;
    std::filesystem::remove(folder_.request(), ignored);
    folder_.make();
  });
  WholeCheckpoint next{folder_.checkpoint(step), {}, {}};
  // What an earlier run saved is not told apart from what this one has not: the first checkpoint saves all.
  if (ownOutputs_) next.outputs = current_.outputs;
  if (results.stepCount() > savedOutputs_) {
    next.outputs.push_back(folder_.outputs(step));
    results.saveSteps(next.outputs.back(), savedOutputs_);
  }
  CheckpointWriter writer(comm_, next.file, stateNumbers(mesh), fingerprint_);
  save(writer);
  std::vector<std::string> outputs;
  for (const auto& file : next.outputs) outputs.push_back(file.filename().string());
  writer.texts("outputs", outputs);
  writer.finish();

  if (current_.file != next.file) former_ = std::move(current_);
  current_ = std::move(next);
  step_ = step;
  savedOutputs_ = results.stepCount();
  ownOutputs_ = true;
  collectively(comm_, [&] {
    if (rank_ != 0) return;
    std::vector<std::filesystem::path> kept{current_.file, former_.file};
    for (const WholeCheckpoint* one : {&current_, &former_})
      kept.insert(kept.end(), one->outputs.begin(), one->outputs.end());
    folder_.removeAllBut(kept);
  });
}

}  // namespace lampblack::app
