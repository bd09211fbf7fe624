// Physical groups of a Gmsh mesh: their names, and the entities (points, curves, surfaces, volumes) that belong to
// them.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "io/gmsh_stream.hpp"

namespace lampblack::io {

class GmshGroups {
 public:
  // The sections $PhysicalNames and $Entities, without their first and last lines. InputError as GmshStream.
  void readNames(GmshStream& stream);
  void readEntities(GmshStream& stream);

  // Tag of the physical group of an entity's elements, of several the first; 0 without one, and where the file has no
  // entities. InputError, at the place where `stream` is, for an entity that the file does not have.
  std::int64_t groupOf(const GmshStream& stream, int dimension, std::int64_t entity);
  // "physical 12" where it has no name.
  [[nodiscard]] std::string nameOf(int dimension, std::int64_t group) const;
  // What `what` belongs to: InputError is left to ambiguous() where the names of two groups differ.
  void noteGroups(int dimension, const std::string& what, std::int64_t group, std::int64_t other);
  // What is wrong if an entity that groupOf was asked for, or that noteGroups was told of, is in groups of different
  // names; empty if none is.
  [[nodiscard]] const std::string& ambiguous(int dimension) const {
    return ambiguous_.at(static_cast<std::size_t>(dimension));
  }

 private:
  bool entitiesKnown_ = false;
  std::array<std::map<std::int64_t, std::string>, 4> names_;                 // by dimension and group
  std::array<std::map<std::int64_t, std::vector<std::int64_t>>, 4> groups_;  // of the entities, by dimension
  std::array<std::string, 4> ambiguous_;                                     // by dimension
};

}  // namespace lampblack::io
