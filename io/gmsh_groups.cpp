#include "io/gmsh_groups.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "io/gmsh_cells.hpp"

namespace lampblack::io {

// Text in both encodings: a line each of dimension, tag, name in quotes; version 2.0 has no dimension.
void GmshGroups::readNames(GmshStream& stream) {
  const std::int64_t count = stream.textInteger("the number of physical names");
  stream.line();
  for (std::int64_t i = 0; i < count; ++i) {
    const std::int64_t first = stream.textInteger("the dimension of a physical group, 0 to 3");
    const bool ofAll = stream.encoding.version2 && stream.peek().starts_with('"');
    const std::int64_t dimension = ofAll ? 0 : first;
    if (dimension < 0 || dimension > 3)
      throw stream.error(fmt::format("expected the dimension of a physical group, 0 to 3, found {}", dimension));
    const std::int64_t group = ofAll ? first : stream.textInteger("the tag of a physical group");
    const std::string text = stream.line();
    const std::size_t begin = text.find('"'), end = text.rfind('"');
    if (begin != 0 || end + 1 != text.size() || end == begin)
      throw stream.error("expected the name of a physical group in quotes (\"wall\"), found " + quotedForMessage(text));
    const std::string name = text.substr(1, end - 1);
    for (std::int64_t d = dimension; !name.empty() && d <= (ofAll ? 3 : dimension); ++d)
      names_[static_cast<std::size_t>(d)][group] = name;
  }
}

void GmshGroups::readEntities(GmshStream& stream) {
  entitiesKnown_ = true;
  std::array<std::int64_t, 4> counts{};
  for (std::int64_t& count : counts) count = stream.count("the number of entities of a dimension");
  for (std::size_t dimension = 0; dimension < 4; ++dimension) {
    for (std::int64_t i = 0; i < counts[dimension]; ++i) {
      auto& groups = groups_[dimension][stream.integer("the tag of an entity")];
      const int corners = dimension == 0 && !stream.encoding.version40 ? 3 : 6;
      for (int k = 0; k < corners; ++k) stream.number("a coordinate of an entity");
      const std::int64_t groupsOfEntity = stream.count("the number of physical groups of an entity");
      for (std::int64_t k = 0; k < groupsOfEntity; ++k) {
        // A negative tag asks for the other orientation.
        const std::int64_t group = std::abs(stream.integer("the tag of a physical group"));
        if (group == 0) throw stream.error("expected the tag of a physical group, found 0");
        groups.push_back(group);
      }
      if (dimension == 0) continue;
      const std::int64_t bounds = stream.count("the number of bounds of an entity");
      for (std::int64_t k = 0; k < bounds; ++k) stream.integer("the tag of a bound of an entity");
    }
  }
}

std::string GmshGroups::nameOf(int dimension, std::int64_t group) const {
  const auto& names = names_[static_cast<std::size_t>(dimension)];
  const auto found = names.find(group);
  return found == names.end() ? fmt::format("physical {}", group) : found->second;
}

// The physical group of an entity's elements; of several the first.
std::int64_t GmshGroups::groupOf(const GmshStream& stream, int dimension, std::int64_t entity) {
  const auto d = static_cast<std::size_t>(dimension);
  const auto found = groups_[d].find(entity);
  if (found == groups_[d].end()) {
    if (!entitiesKnown_) return 0;
    throw stream.error(
        fmt::format("the block belongs to the {} {}, which is not in the section $Entities; the file is "
                    "damaged: save it again",
                    gmshEntityName(dimension), entity));
  }
  if (found->second.empty()) return 0;
  const std::int64_t group = found->second.front();
  for (const std::int64_t other : found->second)
    noteGroups(dimension, fmt::format("the {} {}", gmshEntityName(dimension), entity), group, other);
  return group;
}

void GmshGroups::noteGroups(int dimension, const std::string& what, std::int64_t group, std::int64_t other) {
  std::string& ambiguous = ambiguous_[static_cast<std::size_t>(dimension)];
  if (!ambiguous.empty() || nameOf(dimension, other) == nameOf(dimension, group)) return;
  ambiguous = fmt::format(
      "{} is in two physical groups, '{}' and '{}', so that its boundary condition is not clear; take it out of one of "
      "them",
      what, nameOf(dimension, group), nameOf(dimension, other));
}

}  // namespace lampblack::io
