// The sections of a Gmsh mesh file, versions 2.0 to 2.2, 4.0 and 4.1 (Geuzaine and Remacle 2009; the reference manual
// of Gmsh, "MSH file format"). Rank 0 reads them and passes on what they hold; it keeps the entities and the names of
// groups.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "io/gmsh_cells.hpp"
#include "io/gmsh_groups.hpp"
#include "io/gmsh_shares.hpp"
#include "io/gmsh_stream.hpp"

namespace lampblack::io {

class GmshSections {
 public:
  // Nothing is read yet. `sender` gets nodes, elements and periodic pairs. InputError as GmshStream.
  GmshSections(const std::filesystem::path& file, GmshSender& sender);

  // The whole file. InputError, with its place, for anything that is not as it should be.
  void read();

  // 3 where there are elements of volumes, otherwise 2. InputError where there are no cells, or where a part of the
  // surface belongs to two groups of different names.
  [[nodiscard]] int dimension() const;
  // Elements of a dimension, all of them or those with a physical group.
  [[nodiscard]] std::int64_t elements(int dimension) const {
    return grouped(dimension) + ungrouped_.at(static_cast<std::size_t>(dimension));
  }
  [[nodiscard]] std::int64_t grouped(int dimension) const { return grouped_.at(static_cast<std::size_t>(dimension)); }
  // What of the file is passed over, a sentence each.
  [[nodiscard]] std::vector<std::string> notes() const;
  // Tags of the physical groups of a dimension that have elements, and their names.
  [[nodiscard]] const std::map<std::int64_t, std::string>& groups(int dimension) const {
    return used_.at(static_cast<std::size_t>(dimension));
  }

 private:
  struct Block {
    int dimension = 0;
    std::int64_t entity = 0;
    std::int64_t kind = 0;  // of nodes: whether they have parameters; of elements: their type
    std::int64_t count = 0;
  };
  // An element of a file of version 2, where elements of all kinds follow each other.
  struct Element {
    std::int64_t type = 0, group = 0;
    std::array<std::int64_t, 8> corners{};
  };
  void readFormat();
  void readSection();
  void readNodes();
  void readNodeBlock(const Block& block, std::int64_t first);
  void readNodes2();
  void readElements();
  void readElementBlock(const Block& block);
  void readElements2();
  void readElement2(std::int64_t type, std::int64_t tag, std::int64_t tags);
  void takeElement2(const Element& element, std::int64_t tag);
  [[nodiscard]] const GmshElementType& typeOf(std::int64_t number) const;
  void readCorners(const GmshElementType& type, std::int64_t tag, std::array<std::int64_t, 8>& corners);
  void readPeriodic();
  void once(bool& seen);
  void beforeElements(bool& seen);
  int readDimension();
  Block readBlock(const char* kind, const char* count);
  void checkBlock(std::int64_t count, std::int64_t done, std::int64_t total, const char* what) const;
  void checkBlocks(std::int64_t done, std::int64_t total, const char* what) const;

  GmshStream stream_;
  GmshSender& sender_;
  bool seenNames_ = false, seenEntities_ = false, seenNodes_ = false, seenElements_ = false, seenPeriodic_ = false;
  GmshGroups groups_;
  std::array<std::map<std::int64_t, std::string>, 4> used_;  // groups that have elements, by dimension
  std::array<std::int64_t, 4> grouped_{}, ungrouped_{};      // elements by dimension, with and without a group
  std::map<int, std::int64_t> ofOrder_;                      // cells by their order, where it is 2 or more
  Element before_;                                           // of a file of version 2: the last one
  std::int64_t nodes_ = 0;
};

}  // namespace lampblack::io
