// The mesh of a flow deck: a box, what stands in it and how it is bent, or the file that holds another mesh.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>

#include "app/problems/flow/flow_case_parts.hpp"
#include "app/problems/flow/flow_limits.hpp"
#include "core/errors.hpp"
#include "core/grading.hpp"
#include "io/deck_keys.hpp"
#include "io/formula.hpp"
#include "io/grid_table.hpp"

namespace lampblack::app::flowcase {

AxisNames axisNames(Geometry geometry, int dimension) {
  if (geometry == Geometry::Axisymmetric) return {"r", "z"};
  return dimension == 2 ? AxisNames{"x", "y"} : AxisNames{"x", "y", "z"};
}

std::string axesText(const AxisNames& names) {
  return fmt::format("the axes of this mesh are {}",
                     fmt::join(names.begin(), names.end(), names.size() == 2 ? " and " : ", "));
}

void noteEdgeInside(FlowCase& flowCase, const std::string& what, double edge, const std::vector<double>& vertices) {
  const double end = vertices.back();
  const double nearest = *std::ranges::min_element(vertices, {}, [&](double place) { return std::abs(place - edge); });
  if (edge > 0 && edge < end && std::abs(nearest - edge) > 1e-6 * end)
    flowCase.notes.push_back(fmt::format("{}; the nearest edge of a face is at {:g} m", what, nearest));
}

namespace {

// Axes that have a place in decks, but not in this mesh.
AxisNames otherAxes(const AxisNames& names) {
  AxisNames others;
  for (const char* name : {"r", "z", "x", "y"})
    if (std::ranges::find(names, name) == names.end()) others.emplace_back(name);
  return others;
}

void refuseOtherAxes(const Deck& deck, const std::string& section, const AxisNames& names) {
  for (const std::string& other : otherAxes(names))
    if (const std::string key = section + "." + other; deck.has(key)) throw deck.error(key, axesText(names));
}

void readFile(const Deck& deck, FlowCase& flowCase) {
  for (const char* key : {"r", "z", "x", "y", "refinement", "solids", "floor", "ceiling"})
    if (const std::string path = std::string("mesh.") + key;
        deck.has(path) && (deck.isGiven(path) || path != "mesh.refinement"))
      throw deck.error(path, "the mesh is that of 'mesh.file'; leave this out");
  flowCase.meshFile = MeshFile{
      deck.resolvePath(deck.string("mesh.file")), deck.optionalQuantity("mesh.unit").value_or(1.0), deck, {}, {}};
}

void readAxes(const Deck& deck, FlowCase& flowCase) {
  const AxisNames names = axisNames(flowCase);
  refuseOtherAxes(deck, "mesh", names);
  const double refinement = deck.number("mesh.refinement");
  std::vector<std::vector<AxisSegment>> segments(names.size());
  double cells = 1;
  for (std::size_t axis = 0; axis < names.size(); ++axis) {
    const std::string list = "mesh." + names[axis];
    for (std::size_t i = 0; i < deck.size(list); ++i) {
      const std::string item = fmt::format("{}[{}].", list, i);
      segments[axis].push_back(
          {deck.quantity(item + "to"), deck.integer<int>(item + "cells"), deck.number(item + "ratio")});
    }
    if (segments[axis].empty())
      throw deck.error("mesh", fmt::format("the mesh has no cells along {}: expected a list '{}' of segments",
                                           names[axis], names[axis]));
    cells *= gradedCells(segments[axis], refinement);
  }
  requireCells(deck, cells, flowCase.mechanism->numSpecies());
  for (std::size_t axis = 0; axis < names.size(); ++axis)
    deck.at("mesh." + names[axis], [&] { flowCase.mesh.vertices[axis] = gradedAxis(0.0, segments[axis], refinement); });
}

void readSolid(const Deck& deck, const std::string& name, FlowCase& flowCase) {
  const AxisNames names = axisNames(flowCase);
  const std::string section = "mesh.solids." + name;
  refuseOtherAxes(deck, section, names);
  MeshSpec::LeftOut part;
  part.lower.fill(-1e300);
  part.upper.fill(1e300);
  bool isBounded = false;
  for (std::size_t axis = 0; axis < names.size(); ++axis) {
    const std::string key = section + "." + names[axis];
    if (!deck.has(key)) continue;
    isBounded = true;
    const std::vector<double> ends = deck.quantities(key);
    if (!(ends[0] < ends[1])) throw deck.error(key, "expected the lower end, then the upper end");
    part.lower[axis] = ends[0];
    part.upper[axis] = ends[1];
    const std::vector<double>& vertices = flowCase.mesh.vertices[axis];
    bool hasCells = false;
    for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
      const double centre = 0.5 * (vertices[i] + vertices[i + 1]);
      hasCells = hasCells || (centre >= ends[0] && centre < ends[1]);
    }
    if (!hasCells)
      throw deck.error(key, fmt::format("no cell of the mesh has its centre between {:g} and {:g} m along {}", ends[0],
                                        ends[1], names[axis]));
    for (const double edge : ends)
      noteEdgeInside(
          flowCase,
          fmt::format("the solid {} has its edge at {} = {:g} m inside cells of the mesh, which are left out "
                      "where their centres lie in it",
                      name, names[axis], edge),
          edge, vertices);
  }
  if (!isBounded)
    throw deck.error(section, fmt::format("expected two ends along one axis at least, '{}: [0 mm, 5 mm]'", names[0]));
  flowCase.mesh.leftOut.push_back(part);
  flowCase.solids.push_back(name);
}

// The height of a wall over x, m; empty where the deck has none.
std::function<double(double)> readHeight(const Deck& deck, const std::string& section) {
  if (!deck.has(section)) return {};
  const std::string formula = section + ".formula", table = section + ".table";
  if (deck.has(formula) == deck.has(table)) throw deck.error(section, "expected either 'formula' or 'table'");
  if (deck.has(formula))
    return deck.at(formula, [&]() -> std::function<double(double)> {
      return [height = Formula(deck.string(formula), {"x"})](double x) { return height(std::array{x}); };
    });
  return deck.at(table, [&]() -> std::function<double(double)> {
    const auto isHeight = [](const std::string& column) {
      return column == "y" ? std::optional(units::length) : std::nullopt;
    };
    const auto heights = std::make_shared<GridTable>(
        deck.resolvePath(deck.string(table)), std::vector<GridTable::Coordinate>{{"x", units::length}}, isHeight);
    return [heights](double x) { return heights->value(0, std::array{x}); };
  });
}

// A floor and a ceiling, between which the vertices of each column keep their proportions.
void readBend(const Deck& deck, FlowCase& flowCase) {
  const std::string floorSection = "mesh.floor", ceilingSection = "mesh.ceiling";
  const auto floor = readHeight(deck, floorSection), ceiling = readHeight(deck, ceilingSection);
  if (!floor && !ceiling) return;
  MeshSpec& mesh = flowCase.mesh;
  const double top = mesh.vertices[1].back();
  for (const double x : mesh.vertices[0]) {
    const double low = floor ? deck.at(floorSection, [&] { return floor(x); }) : 0.0;
    const double high = ceiling ? deck.at(ceilingSection, [&] { return ceiling(x); }) : top;
    if (!(low < high))
      throw deck.error(
          ceiling ? ceilingSection : floorSection,
          fmt::format("the floor would meet the ceiling: at x = {:g} m they are at y = {:g} and {:g} m", x, low, high));
  }
  mesh.map = [floor, ceiling, top](const std::array<double, 3>& place) {
    const double low = floor ? floor(place[0]) : 0.0;
    const double high = ceiling ? ceiling(place[0]) : top;
    return std::array{place[0], low + place[1] / top * (high - low), place[2]};
  };
}

std::optional<Partitioner> readPartitioner(const Deck& deck) {
  const std::string key = "mesh.partition";
  if (!deck.has(key)) return std::nullopt;
  const std::string name = deck.choice(key);
  if (name == "curve") return Partitioner::Curve;
  if (name == "metis") return Partitioner::Metis;
  if (!isThere(Partitioner::PtScotch))
    throw deck.error(key, "PETSc was built without PT-Scotch here; expected metis or curve");
  return Partitioner::PtScotch;
}

}  // namespace

void addMeshKeys(DeckSchema& schema) {
  SectionKeys keys("");
  keys.choice("mesh.geometry", {"axisymmetric", "planar", "space"}, rules().byDefault("axisymmetric"),
              "Symmetry of the domain: axisymmetric, with axes r and z; planar, with x and y; or none, space, with x, "
              "y and z.");
  keys.text("mesh.file", rules().optional(),
            "Mesh file of Gmsh (versions 2.0 to 2.2, 4.0 and 4.1), relative to the deck, in place of segments along "
            "axes: triangles and quadrilaterals in a plane (axisymmetric: x of the file is the radius r, y is z), or, "
            "with geometry space, tetrahedra, pyramids, prisms and hexahedra. Its physical groups of lines (space: of "
            "faces) are the boundaries, by their names, or those without one by their numbers; a group inside the gas "
            "is a wall of no thickness where its boundary is one.");
  keys.quantity("mesh.unit", units::length, rules().optional().above(0),
                "Length of one unit of the mesh file, '1 mm'; absent: 1 m.");
  keys.number("mesh.refinement", rules().byDefault("1").above(0), "Multiplies the cell count of every segment.");
  keys.choice("mesh.partition", {"curve", "metis", "ptscotch"}, rules().optional(),
              "How the cells are spread over the ranks: pieces of a space-filling curve, for which no rank holds more "
              "than its share; by METIS, whose first rank holds the graph of the whole mesh (about 200 bytes a cell); "
              "or by PT-Scotch, where PETSc has it, whose pieces are others in each run. Results differ by round-off "
              "alone; to the last bit a run and its restarts repeat with curve and metis. Absent: the curve for "
              "segments along axes, METIS for a mesh file of up to ten million cells.");
  keys.number("mesh.repartition", rules().optional().above(1),
              "Cost of the busiest rank over the mean, '1.2', above which the mesh is partitioned anew between two "
              "steps, by what each of its cells costs its own rank. What work sharing spreads over the ranks is even "
              "already: this is for 'chemistry.share_work: false'. Absent: the mesh keeps its pieces.");
  for (const std::string axis : {"r", "z", "x", "y"}) {
    const std::string list = "mesh." + axis;
    keys.section(list, Presence::optional, "Segments of the " + axis + " axis, one after the other from zero.");
    keys.quantity(list + "[].to", units::length, rules().above(0), "Coordinate at which the segment ends.");
    keys.integer(list + "[].cells", rules().atLeast(1), "Number of cells of the segment.");
    keys.number(list + "[].ratio", rules().byDefault("1").above(0),
                "Last cell size over first; above 1 the cells grow.");
  }
  keys.section("mesh.solids.*", Presence::optional,
               "A box of solid in the mesh - a step, a lip, a bluff body - whose cells are left out: those with their "
               "centres in it. Each has a boundary, 'lip: {type: wall, solid: lip}'.");
  for (const std::string axis : {"r", "z", "x", "y"})
    keys.quantity("mesh.solids.*." + axis, units::length, rules().list(2).optional(),
                  "Lower and upper end of the solid along the " + axis +
                      " axis, '[0 mm, 5 mm]'; absent: it goes through the whole mesh along it.");
  for (const auto& [name, what, otherwise] :
       {std::array<std::string, 3>{"floor", "lower", "y = 0"},
        std::array<std::string, 3>{"ceiling", "upper", "the end of the last segment of y"}}) {
    const std::string section = "mesh." + name;
    keys.section(section, Presence::optional,
                 "A " + what +
                     " wall that is not straight: its height y over x, by a formula or a table; absent: " + otherwise +
                     ". The vertices between floor and ceiling keep their proportions; 'from' and 'to' of boundaries "
                     "and solids are as if both were straight.",
                 {{"mesh.geometry", {"planar"}}});
    keys.text(section + ".formula", rules().optional(), "Height in m over x in m, '0.01 + 0.002*sin(300*x)'.");
    keys.text(section + ".table", rules().optional(),
              "CSV file, relative to the deck, with points of the wall: the columns x and y, a unit may stand behind a "
              "name, 'y [mm]'. Linear between its points, constant beyond them.");
  }
  schema.add(keys.schema());
}

void readMesh(const Deck& deck, FlowCase& flowCase) {
  const std::string geometry = deck.choice("mesh.geometry");
  flowCase.mesh.geometry = geometry == "axisymmetric" ? Geometry::Axisymmetric : Geometry::Planar;
  flowCase.dimension = geometry == "space" ? 3 : 2;
  flowCase.partitioner = readPartitioner(deck);
  flowCase.repartition = deck.optionalNumber("mesh.repartition");
  if (deck.has("mesh.file")) {
    readFile(deck, flowCase);
    return;
  }
  if (deck.has("mesh.unit")) throw deck.error("mesh.unit", "it is the unit of a mesh file; expected 'file', too");
  readAxes(deck, flowCase);
  for (const std::string& name : deck.children("mesh.solids")) readSolid(deck, name, flowCase);
  readBend(deck, flowCase);
}

}  // namespace lampblack::app::flowcase
