// Copies values of owned cells into the halo cells of the ranks that see them, for any number of fields in one message
// a neighbour.
#pragma once

#include <mpi.h>

#include <functional>
#include <span>
#include <vector>

#include "core/mesh.hpp"

namespace lampblack {

// A cell field: `components` values a cell, cell after cell, owned cells first and then halo cells.
struct FieldView {
  std::span<double> values;
  int components = 1;
};

class HaloExchange {
 public:
  explicit HaloExchange(const Mesh& mesh);  // collective

  // Collective. Fills the halo part of every field.
  void update(std::span<const FieldView> fields);
  void update(std::span<double> values, int components);
  // The same for values that stand nowhere: `make` writes those of an owned cell that a neighbour sees, `components`
  // of them, and `take` gets those of a halo cell.
  void exchange(int components, const std::function<void(int cell, double* values)>& make,
                const std::function<void(int cell, const double* values)>& take);

 private:
  struct Neighbour {
    int rank;
    std::vector<int> send;  // owned cells the neighbour sees
    int firstHalo, halo;    // its cells here: [firstHalo, firstHalo + halo)
    std::vector<double> sendBuffer, receiveBuffer;
  };
  MPI_Comm comm_;
  std::vector<Neighbour> neighbours_;
  std::vector<MPI_Request> requests_;
};

}  // namespace lampblack
