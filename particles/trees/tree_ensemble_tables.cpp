// Every particle of a population of trees as tables: particles, primaries, necks. Primaries and necks stand in the
// order of the particles, and within one in that of the tree of collisions (tree_pool.hpp).
#include <cmath>
#include <cstdint>
#include <utility>

#include "particles/spheres/sphere_measures.hpp"
#include "particles/trees/tree_ensemble.hpp"
#include "particles/trees/tree_population.hpp"
#include "particles/trees/tree_shape.hpp"

namespace lampblack::particles {
namespace {

using Table = StochasticPopulation::Table;

// Columns that are filled row by row, in their order.
class TableRows {
 public:
  TableRows(const char* name, std::size_t rows) : rows_(rows) { table_.name = name; }
  void whole(std::string name, std::string description) {
    add(std::move(name), "1", std::move(description), std::vector<std::int64_t>());
  }
  void real(std::string name, std::string unit, std::string description) {
    add(std::move(name), std::move(unit), std::move(description), std::vector<double>());
  }
  void put(std::int64_t value) { std::get<1>(next()).push_back(value); }
  void put(double value) { std::get<0>(next()).push_back(value); }
  Table take() { return std::move(table_); }

 private:
  template <typename Values>
  void add(std::string name, std::string unit, std::string description, Values empty) {
    empty.reserve(rows_);
    table_.columns.push_back({{std::move(name), std::move(unit), std::move(description)}, std::move(empty)});
  }
  auto next() -> decltype(StochasticPopulation::TableColumn::values)& {
    auto& column = table_.columns[column_].values;
    column_ = (column_ + 1) % table_.columns.size();
    return column;
  }
  Table table_;
  std::size_t rows_, column_ = 0;
};

}  // namespace

std::vector<StochasticPopulation::Table> TreeEnsemble::tables() const {
  const std::vector<Tree> trees = trees_->trees();
  std::size_t count = 0;
  for (const Tree& tree : trees) count += tree.count();
  const auto components = [&](TableRows& rows, const std::string& of) {
    for (const TreeComponent& c : options_.material.components)
      rows.real(c.name, "1", "units of " + c.name + " in the " + of);
  };
  const auto units = [&](TableRows& rows, const TreeUnits& of) {
    for (std::size_t c = 0; c < options_.material.components.size(); ++c) rows.put(of[c]);
  };

  TableRows particles("particles", trees.size());
  particles.real("number", "1/m^3", "particles that this one stands for");
  components(particles, "particle");
  particles.real("volume", "m^3", "of the particle");
  particles.real("surface", "m^2", "of the particle");
  particles.real("collision_diameter", "m", "of the particle");
  particles.real("sphere_diameter", "m", "of the sphere of the particle's volume");
  particles.whole("primaries", "primaries of the particle");
  particles.real("primary_diameter", "m", "mean over the particle's primaries");
  particles.real("sintering_level", "1", "mean over the particle's necks; of one primary 1");

  const bool areInSpace = options_.shape == TreeShape::spheres;
  if (areInSpace) particles.real("gyration_radius", "m", "of the particle, its spheres as their necks cut them");

  TableRows primaries("primaries", count);
  primaries.whole("particle", "row of the primary's particle, from 0");
  components(primaries, "primary");
  primaries.real("diameter", "m", "of the sphere of the primary's volume");
  if (areInSpace) {
    primaries.real("radius", "m", "of the primary's sphere, which its necks cut");
    for (const char* axis : {"x", "y", "z"})
      primaries.real(axis, "m", "place of the sphere's centre, from the particle's centre of mass");
  }

  TableRows necks("necks", count - trees.size());
  necks.whole("particle", "row of the neck's particle, from 0");
  necks.whole("left", "row of the one primary, from 0");
  necks.whole("right", "row of the other primary");
  necks.whole("first", "row of the first of all primaries that the neck's collision joined");
  necks.whole("last", "row of the last of them; those up to the neck's place came with left, the others with right");
  necks.real("common_surface", "m^2", "of the two primaries");
  necks.real("sintering_level", "1", "0 in point contact, 1 a sphere");

  const double weight = trees_->weight();
  SphereAggregate aggregate;
  std::int64_t particle = 0, before = 0;
  for (const Tree& tree : trees) {
    const TreeHead& head = tree.head();
    particles.put(weight);
    units(particles, head.units);
    for (const double value : {head.volume, head.surface, head.collision, treeDiameter(head.volume)})
      particles.put(value);
    particles.put(std::int64_t{head.count});
    particles.put(meanPrimaryDiameter(head));
    particles.put(meanSinteringLevel(head));
    if (areInSpace) {
      aggregate.copy(tree.spheres());
      particles.put(std::sqrt(gyrationSquared(aggregate)));
    }
    for (std::size_t i = 0; i < tree.count(); ++i) {
      primaries.put(particle);
      units(primaries, tree.primaries()[i].units);
      primaries.put(tree.primaries()[i].diameter);
      if (!areInSpace) continue;
      const AggregateSphere& s = tree.spheres()[i];
      for (const double value : {s.radius, s.centre[0], s.centre[1], s.centre[2]}) primaries.put(value);
    }
    for (const TreeNeck& neck : tree.necks()) {
      necks.put(particle);
      for (const std::uint32_t index : {neck.left, neck.right, neck.first, neck.last}) necks.put(before + index);
      necks.put(neck.common);
      necks.put(sinteringLevel(neck));
    }
    ++particle;
    before += head.count;
  }
  std::vector<Table> all;
  for (TableRows* rows : {&particles, &primaries, &necks}) all.push_back(rows->take());
  return all;
}

}  // namespace lampblack::particles
