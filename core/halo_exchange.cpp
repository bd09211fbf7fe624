#include "core/halo_exchange.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace lampblack {

HaloExchange::HaloExchange(const Mesh& mesh) : comm_(mesh.comm) {
  // Each rank asks the owners of its halo cells for them by natural index.
  const auto ranks = static_cast<std::size_t>(mesh.ranks);
  std::vector<int> wanted(ranks, 0);
  std::vector<int> asked(ranks, 0);
  for (int owner : mesh.haloRank) ++wanted[static_cast<std::size_t>(owner)];
  MPI_Alltoall(wanted.data(), 1, MPI_INT, asked.data(), 1, MPI_INT, comm_);
  std::vector<int> wantedStart(ranks + 1, 0);
  std::vector<int> askedStart(ranks + 1, 0);
  for (std::size_t r = 0; r < ranks; ++r) {
    wantedStart[r + 1] = wantedStart[r] + wanted[r];
    askedStart[r + 1] = askedStart[r] + asked[r];
  }
  std::vector<std::int64_t> askedNatural(static_cast<std::size_t>(askedStart.back()));
  MPI_Alltoallv(mesh.naturalCell.data() + mesh.owned, wanted.data(), wantedStart.data(), MPI_INT64_T,
                askedNatural.data(), asked.data(), askedStart.data(), MPI_INT64_T, comm_);
  for (std::size_t r = 0; r < ranks; ++r) {
    if (wanted[r] == 0 && asked[r] == 0) continue;
    Neighbour neighbour{static_cast<int>(r), {}, mesh.owned + wantedStart[r], wanted[r], {}, {}};
    for (int i = askedStart[r]; i < askedStart[r + 1]; ++i) {
      neighbour.send.push_back(mesh.findOwned(askedNatural[static_cast<std::size_t>(i)]));
      if (neighbour.send.back() < 0) throw std::logic_error("HaloExchange: asked for a cell that is not owned here");
    }
    neighbours_.push_back(std::move(neighbour));
  }
}

void HaloExchange::exchange(int components, const std::function<void(int, double*)>& make,
                            const std::function<void(int, const double*)>& take) {
  if (neighbours_.empty()) return;
  const auto valuesPerCell = static_cast<std::size_t>(components);
  constexpr int tag = 11;
  requests_.clear();
  for (Neighbour& n : neighbours_) {
    n.receiveBuffer.resize(valuesPerCell * static_cast<std::size_t>(n.halo));
    requests_.emplace_back();
    MPI_Irecv(n.receiveBuffer.data(), static_cast<int>(n.receiveBuffer.size()), MPI_DOUBLE, n.rank, tag, comm_,
              &requests_.back());
  }
  for (Neighbour& n : neighbours_) {
    n.sendBuffer.resize(valuesPerCell * n.send.size());
    double* out = n.sendBuffer.data();
    for (const int cell : n.send) {
      make(cell, out);
      out += components;
    }
    requests_.emplace_back();
    MPI_Isend(n.sendBuffer.data(), static_cast<int>(n.sendBuffer.size()), MPI_DOUBLE, n.rank, tag, comm_,
              &requests_.back());
  }
  MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
  for (Neighbour& n : neighbours_)
    for (int i = 0; i < n.halo; ++i) take(n.firstHalo + i, n.receiveBuffer.data() + i * components);
}

void HaloExchange::update(std::span<const FieldView> fields) {
  int components = 0;
  for (const FieldView& field : fields) components += field.components;
  exchange(
      components,
      [&](int cell, double* out) {
        for (const FieldView& field : fields)
          out = std::copy_n(field.values.data() + cell * field.components, field.components, out);
      },
      [&](int cell, const double* in) {
        for (const FieldView& field : fields) {
          std::copy_n(in, field.components, field.values.data() + cell * field.components);
          in += field.components;
        }
      });
}

void HaloExchange::update(std::span<double> values, int components) {
  const FieldView field{values, components};
  update({&field, 1});
}

}  // namespace lampblack
