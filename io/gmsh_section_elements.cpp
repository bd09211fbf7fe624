// The section $Elements of a Gmsh mesh file: blocks of one type (version 4), or elements one by one (version 2).
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "io/gmsh_cells.hpp"
#include "io/gmsh_sections.hpp"

namespace lampblack::io {

void GmshSections::readElements() {
  once(seenElements_);
  if (stream_.encoding.version2) return readElements2();
  const std::int64_t blocks = stream_.count("the number of blocks");
  const std::int64_t total = stream_.count("the number of elements");
  if (!stream_.encoding.version40) {
    stream_.size("the smallest tag of an element");
    stream_.size("the largest tag of an element");
  }
  std::int64_t done = 0;
  for (std::int64_t i = 0; i < blocks; ++i) {
    const Block block = readBlock("the type of elements", "the number of elements of a block");
    checkBlock(block.count, done, total, "elements");
    readElementBlock(block);
    done += block.count;
  }
  checkBlocks(done, total, "elements");
}

const GmshElementType& GmshSections::typeOf(std::int64_t number) const {
  const GmshElementType* type = findGmshType(number);
  if (type == nullptr)
    throw stream_.error(
        fmt::format("elements of type {} are not read: they are no plain shape, or of an order that is not known here; "
                    "set Mesh.ElementOrder = 1, mesh and save again",
                    number));
  return *type;
}

// Corners come before the other nodes of an element.
void GmshSections::readCorners(const GmshElementType& type, std::int64_t tag, std::array<std::int64_t, 8>& corners) {
  for (std::size_t k = 0; k < static_cast<std::size_t>(type.nodes); ++k) {
    corners[k] = stream_.tag("the tag of a node");
    if (std::find(corners.begin(), corners.begin() + k, corners[k]) != corners.begin() + k)
      throw stream_.error(
          fmt::format("the element {} has the node {} twice; it is folded: mesh again", tag, corners[k]));
  }
  for (int k = 0; k < type.between; ++k) stream_.tag("the tag of a node");
}

void GmshSections::readElementBlock(const Block& block) {
  const GmshElementType& type = typeOf(block.kind);
  if (type.dimension != block.dimension)
    throw stream_.error(fmt::format("a {} cannot have elements of type {}; the file is damaged: save it again",
                                    gmshEntityName(block.dimension), block.kind));
  const auto d = static_cast<std::size_t>(block.dimension);
  const std::int64_t group = block.dimension == 0 ? 0 : groups_.groupOf(stream_, block.dimension, block.entity);
  // Points are nothing here, lines only where they may be a named part of a plane mesh's boundary.
  const bool wanted = block.dimension > 1 || group != 0;
  std::int64_t& before = group == 0 ? ungrouped_[d] : grouped_[d];
  sender_.beginRun({block.kind, group, before, 0});
  std::array<std::int64_t, 8> corners{};
  for (std::int64_t i = 0; i < block.count; ++i) {
    const std::int64_t tag = stream_.tag("the tag of an element");
    readCorners(type, tag, corners);
    if (wanted) sender_.element(tag, std::span(corners).first(static_cast<std::size_t>(type.nodes)));
  }
  before += block.count;
  if (type.order > 1 && block.dimension > 1) ofOrder_[type.order] += block.count;
  if (group != 0 && block.count > 0) used_[d][group] = groups_.nameOf(block.dimension, group);
}

// Version 2 has the number of elements on a line, then each with its physical group and its entity. Binary files have
// them in blocks of one type, with a header each.
void GmshSections::readElements2() {
  const std::int64_t total = stream_.countLine("the number of elements");
  before_ = {};
  if (!stream_.encoding.binary) {
    for (std::int64_t i = 0; i < total; ++i) {
      const std::int64_t tag = stream_.tag("the tag of an element");
      const std::int64_t type = stream_.integer("the type of an element");
      readElement2(type, tag, stream_.count("the number of tags of an element"));
    }
    return;
  }
  for (std::int64_t done = 0; done < total;) {
    const std::int64_t type = stream_.integer("the type of elements");
    const std::int64_t count = stream_.integer("the number of elements of a block");
    const std::int64_t tags = stream_.integer("the number of tags of an element");
    if (count < 1 || tags < 0)
      throw stream_.error(
          fmt::format("expected a block of elements with their tags, found {} elements with {} tags; "
                      "the file is damaged: save it again",
                      count, tags));
    checkBlock(count, done, total, "elements");
    for (std::int64_t i = 0; i < count; ++i) readElement2(type, stream_.tag("the tag of an element"), tags);
    done += count;
  }
}

void GmshSections::readElement2(std::int64_t type, std::int64_t tag, std::int64_t tags) {
  Element element{type, 0, {}};
  for (std::int64_t k = 0; k < tags; ++k) {
    const std::int64_t value = stream_.integer("a tag of an element: its physical group, its entity, its partitions");
    if (k == 0) element.group = std::abs(value);  // a negative one asks for the other orientation
  }
  readCorners(typeOf(type), tag, element.corners);
  takeElement2(element, tag);
}

// Gmsh saves an element of several physical groups once for each, one after the other.
void GmshSections::takeElement2(const Element& element, std::int64_t tag) {
  const GmshElementType& type = *findGmshType(element.type);
  const auto d = static_cast<std::size_t>(type.dimension);
  if (element.type == before_.type && element.group != before_.group &&
      std::ranges::is_permutation(element.corners, before_.corners)) {
    if (type.dimension > 0 && element.group != 0 && before_.group != 0)
      groups_.noteGroups(type.dimension, fmt::format("the element {}", tag), before_.group, element.group);
    return;
  }
  const std::int64_t group = type.dimension == 0 ? 0 : element.group;
  std::int64_t& count = group == 0 ? ungrouped_[d] : grouped_[d];
  if (type.dimension > 1 || group != 0) {
    if (before_.type != element.type || before_.group != element.group)
      sender_.beginRun({element.type, group, count, 0});
    sender_.element(tag, std::span(element.corners).first(static_cast<std::size_t>(type.nodes)));
  }
  ++count;
  if (type.order > 1 && type.dimension > 1) ++ofOrder_[type.order];
  if (group != 0) used_[d].try_emplace(group, groups_.nameOf(type.dimension, group));
  before_ = element;
}

}  // namespace lampblack::io
