// What a StateArchive names, kept in memory, each rank its own part: what a step that has failed goes back to, and what
// moves to other ranks where a mesh is partitioned anew.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/packed_rows.hpp"
#include "core/state_archive.hpp"

namespace lampblack {

class KeptState {
 public:
  using Owners = std::function<void(StateArchive&)>;

  KeptState(int ownedCells, int faces);

  // Reads what the owners name; what was kept before is gone.
  void keep(const Owners& owners);
  // Gives it back. The owners have to name the same pieces in the same order (std::logic_error).
  void giveBack(const Owners& owners);

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
    enum class Of { Cells, Faces, Rows, Rank } of = Of::Rank;
    int width = 0;
  };
  class Writer;
  class Reader;

  std::size_t cells_, faces_;
  std::vector<Piece> pieces_;  // their room is used again
  std::size_t count_ = 0;
};

}  // namespace lampblack
