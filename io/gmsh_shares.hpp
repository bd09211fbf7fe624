// What rank 0 reads of a mesh file leaves it at once, in messages of bounded size: nodes go to the rank in whose block
// of the file's order they stand, elements to one rank after the other. Each rank gathers its share.
#pragma once

#include <mpi.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::io {

// Elements that follow each other in the file, of one type and one physical group.
struct GmshRun {
  std::int64_t type = 0;
  std::int64_t group = 0;  // tag of the physical group, 0 without one
  std::int64_t first = 0;  // number of the first in the order of the file, among elements of its dimension: among those
                           // with a physical group if it has one, else among those without
  std::int64_t count = 0;
};

struct GmshShare {
  std::int64_t totalNodes = 0;
  std::int64_t firstNode = 0;          // position in the file of this share's first
  std::vector<std::int64_t> nodeTags;  // of this share, in the order of the file
  std::vector<double> nodePlaces;      // three each, in the file's unit

  struct Elements {
    std::vector<GmshRun> runs;
    std::vector<std::int64_t> numbers;  // of each element its tag and those of its nodes
  };
  std::array<Elements, 4> elements;    // by dimension
  std::vector<std::int64_t> periodic;  // tags of nodes, two by two
};

// Of rank 0: gives everything to whom it belongs.
class GmshSender {
 public:
  // `own`: the share of rank 0. `portion`: values a message holds before it leaves.
  GmshSender(MPI_Comm comm, GmshShare& own, std::size_t portion);

  [[nodiscard]] std::size_t portion() const { return portion_; }

  void nodes(std::int64_t total);  // before all nodes
  // Tags and places of nodes from position `first` on.
  void nodeTags(std::int64_t first, std::span<const std::int64_t> tags);
  void nodePlaces(std::int64_t first, std::span<const double> places);
  void beginRun(const GmshRun& run);  // of no elements yet
  void element(std::int64_t tag, std::span<const std::int64_t> nodes);
  void periodic(std::int64_t node, std::int64_t master);
  void flush();  // what waits for its message to be full
  void end();    // after everything and after an error: lets the other ranks go

 private:
  void send(int rank, std::span<const std::int64_t> message);
  void sendElements();
  void sendPeriodic();
  template <typename Give>
  void byBlock(std::int64_t first, std::int64_t count, const Give& give);

  MPI_Comm comm_;
  GmshShare& own_;
  std::size_t portion_;
  int ranks_ = 1;
  int next_ = 0;  // rank that the next elements or pairs go to
  std::int64_t totalNodes_ = 0;
  GmshRun run_;                                    // that the next element belongs to
  std::size_t runStart_ = 0;                       // in elements_; 0: the run has no element there
  std::vector<std::int64_t> elements_, periodic_;  // messages that are being filled
};

// Of the other ranks: takes messages until the end.
void receiveGmshShare(MPI_Comm comm, GmshShare& share);

}  // namespace lampblack::io
