// Along every side of a box one boundary follows the other: without gaps but for solids, and without overlaps.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

#include "app/problems/flow/flow_case_parts.hpp"
#include "core/errors.hpp"

namespace lampblack::app::flowcase {

std::size_t alongSide(int axis) {
  return axis == 0 ? 1 : 0;
}

namespace {

// One side of the box and the mesh along it.
struct Side {
  std::string name;  // "z-min"
  const std::vector<double>& vertices;
  std::vector<bool> open;  // between two vertices: not all covered by solids

  Side(const FlowCase& flowCase, int axis, bool atMax)
      : name(axisNames(flowCase)[static_cast<std::size_t>(axis)] + (atMax ? "-max" : "-min")),
        vertices(flowCase.mesh.vertices[alongSide(axis)]) {
    const auto centreOf = [](const std::vector<double>& v, std::size_t i) {
      return v.empty() ? 0.0 : 0.5 * (v[i] + v[i + 1]);
    };
    const auto normal = static_cast<std::size_t>(axis), along = alongSide(axis), third = 3 - normal - along;
    const std::vector<double>& across = flowCase.mesh.vertices[normal];
    const std::vector<double>& rest = flowCase.mesh.vertices[third];
    for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
      bool isOpen = false;
      for (std::size_t k = 0; k == 0 || k + 1 < rest.size(); ++k) {
        std::array<double, 3> centre{};
        centre[normal] = centreOf(across, atMax ? across.size() - 2 : 0);
        centre[along] = centreOf(vertices, i);
        centre[third] = centreOf(rest, k);
        isOpen = isOpen || !flowCase.mesh.isLeftOut(centre);
      }
      open.push_back(isOpen);
    }
  }
  [[nodiscard]] double end() const { return vertices.back(); }
  [[nodiscard]] double tolerance() const { return 1e-9 * end(); }
  // How far solids cover the side from a place on; the place itself where they do not.
  [[nodiscard]] double coveredFrom(double place) const {
    for (std::size_t i = 0; i < open.size(); ++i)
      if (!open[i] && vertices[i] <= place + tolerance() && vertices[i + 1] > place + tolerance())
        place = vertices[i + 1];
    return place;
  }
};

// A boundary lies on its side, and has faces. Where an edge of it lies inside a face, the user is told.
void checkExtent(const Deck& deck, FlowCase& flowCase, const BoundaryPatch& patch) {
  const Side side(flowCase, patch.axis, patch.atMax);
  const std::string section = "boundaries." + patch.name;
  for (const auto& [key, value] : {std::pair{".from", patch.from}, {".to", patch.to}})
    if (deck.has(section + key) && (value < -side.tolerance() || value > side.end() + side.tolerance()))
      throw deck.error(section + key,
                       fmt::format("the side {} goes from 0 to {:g} m, found {:g} m", side.name, side.end(), value));
  if (!(patch.from < patch.to)) throw deck.error(section, "expected 'from' below 'to'");
  bool hasFaces = false, hasOpenFaces = false;
  for (std::size_t i = 0; i < side.open.size(); ++i) {
    const double place = 0.5 * (side.vertices[i] + side.vertices[i + 1]);
    const bool isOf = place >= patch.from && place <= patch.to;
    hasFaces = hasFaces || isOf;
    hasOpenFaces = hasOpenFaces || (isOf && side.open[i]);
  }
  if (!hasFaces)
    throw deck.error(section, fmt::format("no face of the mesh has its centre between {:g} and {:g} m on the side {}",
                                          patch.from, patch.to, side.name));
  if (!hasOpenFaces)
    throw deck.error(section, fmt::format("solids cover all of it on the side {}; leave it out", side.name));
  for (const double edge : {patch.from, patch.to})
    noteEdgeInside(flowCase,
                   fmt::format("the boundary {} has its edge at {:g} m inside a face of the mesh, which belongs to the "
                               "boundary its centre lies on",
                               patch.name, edge),
                   edge, side.vertices);
}

// Along a side one boundary follows the other, without gaps but for solids, and without overlaps.
void checkCoverage(const Deck& deck, const Side& side, std::vector<BoundaryPatch> patches) {
  std::stable_sort(patches.begin(), patches.end(),
                   [](const BoundaryPatch& a, const BoundaryPatch& b) { return a.from < b.from; });
  double reached = 0;
  const auto requireNoGap = [&](double from) {
    const double open = side.coveredFrom(reached);
    if (from > open + side.tolerance())
      throw deck.error("boundaries",
                       fmt::format("the side {} belongs to no boundary from {:g} to {:g} m", side.name, open, from));
  };
  const BoundaryPatch* before = nullptr;
  for (const BoundaryPatch& patch : patches) {
    requireNoGap(patch.from);
    if (before != nullptr && patch.from < reached - side.tolerance())
      throw deck.error("boundaries." + patch.name,
                       fmt::format("it overlaps the boundary '{}' on the side {} from {:g} to {:g} m", before->name,
                                   side.name, std::max(patch.from, 0.0), std::min(reached, patch.to)));
    reached = std::min(patch.to, side.end());
    before = &patch;
  }
  requireNoGap(side.end());
}

}  // namespace

void addAxis(FlowCase& flowCase) {
  const auto isAtAxis = [](const BoundaryPatch& patch) { return patch.leftOut < 0 && patch.axis == 0 && !patch.atMax; };
  const auto isNamedAxis = [](const BoundaryPatch& patch) { return patch.name == "axis"; };
  std::vector<BoundaryPatch>& patches = flowCase.mesh.patches;
  if (flowCase.mesh.geometry != Geometry::Axisymmetric || std::ranges::any_of(patches, isAtAxis)) return;
  if (std::ranges::none_of(Side(flowCase, 0, false).open, std::identity{})) return;
  if (std::ranges::any_of(patches, isNamedAxis)) return;  // elsewhere: checkSides tells that the side r-min has none
  patches.push_back({.name = "axis"});
  BoundaryCondition axis;
  axis.name = "axis";
  axis.kind = BoundaryKind::Symmetry;
  flowCase.boundaries.push_back(axis);
}

void checkSides(const Deck& deck, FlowCase& flowCase) {
  const MeshSpec& mesh = flowCase.mesh;
  for (const BoundaryPatch& patch : mesh.patches)
    if (patch.leftOut < 0) checkExtent(deck, flowCase, patch);
  for (int axis = 0; axis < flowCase.dimension; ++axis)
    for (const bool atMax : {false, true}) {
      std::vector<BoundaryPatch> patches;
      for (const BoundaryPatch& patch : mesh.patches) {
        if (patch.leftOut >= 0 || patch.axis != axis) continue;
        if (mesh.periodic[static_cast<std::size_t>(axis)])
          throw deck.error("boundaries." + patch.name, "this side is periodic, too");
        if (patch.atMax == atMax) patches.push_back(patch);
      }
      if (!mesh.periodic[static_cast<std::size_t>(axis)])
        checkCoverage(deck, Side(flowCase, axis, atMax), std::move(patches));
    }
  for (std::size_t solid = 0; solid < flowCase.solids.size(); ++solid)
    if (std::ranges::none_of(mesh.patches, [&](const auto& p) { return p.leftOut == static_cast<int>(solid); }))
      throw deck.error(
          "mesh.solids." + flowCase.solids[solid],
          fmt::format("its surface belongs to no boundary; expected one with 'solid: {}'", flowCase.solids[solid]));
}

}  // namespace lampblack::app::flowcase
