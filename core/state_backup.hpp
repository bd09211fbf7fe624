// A copy in memory of the values that a StateArchive names; each rank copies its own part. A failed step is restored
// from the copy. A new partition of the mesh moves the copy between ranks.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/packed_rows.hpp"
#include "core/state_archive.hpp"

namespace lampblack {

class StateBackup {
 public:
  using Owners = std::function<void(StateArchive&)>;

  StateBackup(int ownedCells, int faces);

  // Copies the values that the owners name, in place of the previous copy.
  void save(const Owners& owners);
  // Writes the copy back. The owners have to name the same pieces in the same order (std::logic_error).
  void restore(const Owners& owners);

  // Saves the copy into another archive, or fills it from there, names with the prefix. A copy of the same owners has
  // to be there in both cases. Collective.
  void saveOrLoad(StateArchive& archive, const std::string& prefix);

  // Of `width` values each for what this rank had: those of what it has now. Collective.
  using Move = std::function<std::vector<double>(const std::vector<double>& values, int width)>;
  // The same of a row of any length for each.
  using MoveRows = std::function<PackedRows(const PackedRows& rows)>;
  // What is kept belongs to a mesh whose cells and faces now lie on other ranks. Collective.
  void rearrange(int ownedCells, int faces, const Move& moveCells, const Move& moveFaces, const MoveRows& moveRows);

  [[nodiscard]] std::size_t bytes() const;

 private:
  struct Piece {
    std::string name;
    PackedRows kept;  // only values but of rows
    enum class Of { Cells, Faces, Rows, Sums, Shared } of = Of::Shared;
    int width = 0;
  };
  class Writer;
  class Reader;

  std::size_t cells_, faces_;
  std::vector<Piece> pieces_;  // their room is used again
  std::size_t count_ = 0;
};

}  // namespace lampblack
