#include "io/gmsh_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "io/gmsh_cells.hpp"

namespace lampblack::io {
namespace {

constexpr const char* howToSave =
    "save it from Gmsh as version 4.1 or 2.2 (in a script: Mesh.MshFileVersion = 4.1; on the command line: -format "
    "msh41)";

constexpr int valuesOfAffine = 16;

}  // namespace

GmshSections::GmshSections(const std::filesystem::path& file, GmshSender& sender)
    : stream_(file, sender.portion() * sizeof(double)), sender_(sender) {}

void GmshSections::read() {
  readFormat();
  while (!stream_.atEnd()) readSection();
  stream_.section.clear();
  if (!seenNodes_) throw stream_.fileError("the file has no section $Nodes; was it saved with a mesh?");
  if (!seenElements_) throw stream_.fileError("the file has no section $Elements; was it saved with a mesh?");
  sender_.flush();
}

int GmshSections::dimension() const {
  const int dimension = elements(3) > 0 ? 3 : 2;
  if (elements(dimension) == 0)
    throw stream_.fileError(
        "the mesh has no cells: no triangles, quadrilaterals, tetrahedra, pyramids, prisms or hexahedra; make a mesh "
        "of "
        "two or three dimensions before saving, and give the surface or the volume a physical group if there are "
        "others");
  if (!groups_.ambiguous(dimension - 1).empty()) throw stream_.fileError(groups_.ambiguous(dimension - 1));
  return dimension;
}

void GmshSections::readFormat() {
  if (stream_.atEnd()) throw stream_.fileError("the file is empty; expected a mesh of Gmsh");
  if (const auto first = stream_.word(); first != "$MeshFormat") {
    if (first == "$NOD") throw stream_.error(std::string("this is a mesh of version 1; ") + howToSave);
    throw stream_.error("this is no mesh file of Gmsh: expected $MeshFormat, found " + quotedForMessage(first));
  }
  stream_.section = "MeshFormat";
  const double version = stream_.real("the version of the format");
  const bool isVersion2 = version >= 2.0 && version <= 2.2;
  if (version < 4.0 && !isVersion2)
    throw stream_.error(fmt::format("this is a mesh of version {}, which is not read; {}", version, howToSave));
  if (version > 4.1)
    throw stream_.error(
        fmt::format("this is a mesh of version {}, newer than those that are read; {}", version, howToSave));
  const std::int64_t type = stream_.textInteger("the type of the file, 0 for text or 1 for binary");
  if (type != 0 && type != 1)
    throw stream_.error(fmt::format("expected the type of the file, 0 for text or 1 for binary, found {}", type));
  const std::int64_t size = stream_.textInteger("the size of data, 4 or 8");
  if (size != 8 && (type == 0 || size != 4 || version < 4.1))
    throw stream_.error(fmt::format("expected the size of data, {}, found {}",
                                    type == 1 && version == 4.1 ? "4 or 8 bytes" : "8 bytes", size));
  stream_.line();
  stream_.encoding = {type == 1, !isVersion2 && version < 4.1, isVersion2, static_cast<int>(size)};
  if (type == 1) {
    const std::int32_t one = stream_.rawInt("the number that tells the order of bytes");
    if (one == 0x01000000)
      throw stream_.error(
          "the file was written by a machine with another order of bytes (big endian), which is not read; save it "
          "there "
          "as text (Mesh.Binary = 0)");
    if (one != 1)
      throw stream_.error(
          fmt::format("expected the number 1 that tells the order of bytes, found {}; the file is damaged "
                      "or was copied as if it were text: copy or save it again",
                      one));
  }
  stream_.endSection();
}

void GmshSections::readSection() {
  stream_.section.clear();
  const std::string name = stream_.line();
  if (name.size() < 2 || name[0] != '$' || name.starts_with("$End"))
    throw stream_.error("expected a section, such as $Nodes, found " + quotedForMessage(name) +
                        "; the file is damaged");
  stream_.section = name.substr(1);
  if (name == "$PhysicalNames")
    beforeElements(seenNames_), groups_.readNames(stream_);
  else if (name == "$Entities")
    beforeElements(seenEntities_), groups_.readEntities(stream_);
  else if (name == "$Nodes")
    readNodes();
  else if (name == "$Elements")
    readElements();
  else if (name == "$Periodic")
    readPeriodic();
  else if (name == "$ParametricNodes")
    throw stream_.error("nodes with parameters of version 2 are not read; save without them (Mesh.SaveParametric = 0)");
  else if (name == "$MeshFormat")
    throw stream_.error("this section stands twice; two files in one are not read");
  else if (name == "$PartitionedEntities")
    throw stream_.error(
        "this mesh is partitioned, which is not read, for a run makes its own partition; save it as a whole (in Gmsh: "
        "Mesh, Unpartition)");
  else
    return stream_.skipSection();
  stream_.endSection();
}

void GmshSections::once(bool& seen) {
  if (seen) throw stream_.error("this section stands twice; two meshes in one file are not read");
  seen = true;
}

void GmshSections::beforeElements(bool& seen) {
  once(seen);
  if (seenElements_)
    throw stream_.error("this section stands behind $Elements, expected before it; save the file again");
}

int GmshSections::readDimension() {
  const std::int64_t dimension = stream_.integer("the dimension of an entity, 0 to 3");
  if (dimension < 0 || dimension > 3)
    throw stream_.error(fmt::format("expected the dimension of an entity, 0 to 3, found {}", dimension));
  return static_cast<int>(dimension);
}

GmshSections::Block GmshSections::readBlock(const char* kind, const char* count) {
  Block block;
  if (stream_.encoding.version40) {
    block.entity = stream_.integer("the tag of an entity");
    block.dimension = readDimension();
  } else {
    block.dimension = readDimension();
    block.entity = stream_.integer("the tag of an entity");
  }
  block.kind = stream_.integer(kind);
  block.count = stream_.count(count);
  return block;
}

void GmshSections::checkBlock(std::int64_t count, std::int64_t done, std::int64_t total, const char* what) const {
  if (count > total - done)
    throw stream_.error(
        fmt::format("the blocks have more {} than the {} that the section announces; the file is damaged: "
                    "save it again",
                    what, total));
}

void GmshSections::checkBlocks(std::int64_t done, std::int64_t total, const char* what) const {
  if (done != total)
    throw stream_.error(fmt::format(
        "the section announces {} {}, its blocks have {}; the file is damaged: save it again", total, what, done));
}

void GmshSections::readNodes() {
  once(seenNodes_);
  const GmshStream::Encoding& encoding = stream_.encoding;
  if (encoding.version2) return readNodes2();
  const std::int64_t blocks = stream_.count("the number of blocks");
  nodes_ = stream_.count("the number of nodes");
  // As text a digit and a space for the tag and each coordinate.
  const std::int64_t bytesEach = !encoding.binary ? 8 : 24 + (encoding.version40 ? 4 : encoding.sizeBytes);
  if (nodes_ > stream_.remaining() / bytesEach) throw stream_.tooMany("the number of nodes", nodes_);
  if (!encoding.version40) {
    stream_.size("the smallest tag of a node");
    stream_.size("the largest tag of a node");
  }
  sender_.nodes(nodes_);
  std::int64_t done = 0;
  for (std::int64_t i = 0; i < blocks; ++i) {
    const Block block = readBlock("the mark of parameters, 0 or 1", "the number of nodes of a block");
    checkBlock(block.count, done, nodes_, "nodes");
    readNodeBlock(block, done);
    done += block.count;
  }
  checkBlocks(done, nodes_, "nodes");
}

// Version 4.1 has all tags of the block first, the others each in front of its place.
void GmshSections::readNodeBlock(const Block& block, std::int64_t first) {
  const bool tagsFirst = !stream_.encoding.version40 && !stream_.encoding.version2;
  const int parameters = block.kind == 0 || (!tagsFirst && block.dimension == 3) ? 0 : block.dimension;
  const std::int64_t portion = std::max<std::int64_t>(static_cast<std::int64_t>(sender_.portion()) / 3, 1);
  std::vector<std::int64_t> tags;
  std::vector<double> places;
  for (std::int64_t at = 0; tagsFirst && at < block.count; at += portion) {
    tags.clear();
    for (std::int64_t i = at; i < std::min(at + portion, block.count); ++i)
      tags.push_back(stream_.tag("the tag of a node"));
    sender_.nodeTags(first + at, tags);
  }
  for (std::int64_t at = 0; at < block.count; at += portion) {
    tags.clear();
    places.clear();
    for (std::int64_t i = at; i < std::min(at + portion, block.count); ++i) {
      if (!tagsFirst) tags.push_back(stream_.tag("the tag of a node"));
      for (int k = 0; k < 3; ++k) places.push_back(stream_.real("a coordinate of a node"));
      for (int k = 0; k < parameters; ++k) stream_.number("a parameter of a node");
    }
    sender_.nodeTags(first + at, tags);
    sender_.nodePlaces(first + at, places);
  }
}

// Version 2 has one block: the count on a line, then tag and place of each.
void GmshSections::readNodes2() {
  nodes_ = stream_.countLine("the number of nodes");
  if (nodes_ > stream_.remaining() / (stream_.encoding.binary ? 28 : 8))
    throw stream_.tooMany("the number of nodes", nodes_);
  sender_.nodes(nodes_);
  readNodeBlock({0, 0, 0, nodes_}, 0);
}

std::vector<std::string> GmshSections::notes() const {
  std::vector<std::string> notes;
  for (const auto& [order, count] : ofOrder_)
    notes.push_back(fmt::format(
        "{} elements of order {} are read by their corners; the nodes between them are passed over, so that "
        "curved sides are straight",
        count, order));
  return notes;
}

void GmshSections::readPeriodic() {
  once(seenPeriodic_);
  const GmshStream::Encoding encoding = stream_.encoding;
  if (encoding.version2) stream_.encoding.binary = false;  // text in both encodings
  const bool version40 = encoding.version40 || encoding.version2;
  const std::int64_t links =
      version40 ? stream_.integer("the number of periodic links") : stream_.count("the number of periodic links");
  for (std::int64_t i = 0; i < links; ++i) {
    readDimension();
    stream_.integer("the tag of an entity");
    stream_.integer("the tag of an entity");
    std::int64_t affine = 0;
    if (!version40) {
      affine = stream_.count("the number of values of a transformation");
    } else if (!stream_.encoding.binary && stream_.peek() == "Affine") {
      stream_.word();
      affine = valuesOfAffine;
    }
    for (std::int64_t k = 0; k < affine; ++k) stream_.number("a value of a transformation");
    std::int64_t pairs = stream_.signedSize("the number of periodic nodes");
    if (version40 && stream_.encoding.binary && pairs == -1) {
      for (int k = 0; k < valuesOfAffine; ++k) stream_.number("a value of a transformation");
      pairs = stream_.signedSize("the number of periodic nodes");
    }
    if (pairs < 0) throw stream_.error(fmt::format("expected the number of periodic nodes, found {}", pairs));
    for (std::int64_t k = 0; k < pairs; ++k) {
      const std::int64_t node = stream_.tag("the tag of a node");
      const std::int64_t master = stream_.tag("the tag of a node");
      sender_.periodic(node, master);
    }
  }
  stream_.encoding = encoding;
}

}  // namespace lampblack::io
