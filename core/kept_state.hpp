// What a StateArchive names, kept in memory, each rank its own part: what a step that has failed goes back to.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

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

  [[nodiscard]] std::size_t bytes() const;

 private:
  struct Piece {
    std::string name;
    std::vector<double> values;
  };
  class Writer;
  class Reader;

  std::size_t cells_, faces_;
  std::vector<Piece> pieces_;  // their room is used again
  std::size_t count_ = 0;
};

}  // namespace lampblack
