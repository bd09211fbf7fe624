#include "core/wall_distance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <exception>
#include <limits>
#include <unordered_map>
#include <utility>

#include "core/errors.hpp"
#include "core/first_error.hpp"
#include "core/rank_exchange.hpp"
#include "core/wall_tree.hpp"

namespace lampblack {
namespace {

std::size_t slot(int index) {
  return static_cast<std::size_t>(index);
}

// Those of this rank, each with the cell beside it.
template <typename Visit>
void eachWall(const Mesh& m, std::span<const int> patches, const Visit& visit) {
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    if (std::ranges::find(patches, m.patch[slot(face - m.interiorFaces)]) == patches.end()) continue;
    const int cell = m.low[slot(face)];
    const CellSide& side = sidesOf(m.shape[slot(cell)])[slot(m.lowSide[slot(face)])];
    WallFace wall{m.faceNumber[slot(face)], side.corners, {}};
    for (int i = 0; i < side.corners; ++i)
      wall.corner[slot(i)] = m.vertex[slot(m.corner[slot(m.cornerStart[slot(cell)] + side.corner[slot(i)])])];
    visit(cell, wall);
  }
}

class WallSweeps {
 public:
  WallSweeps(const Mesh& mesh, HaloExchange& halo) : mesh_(mesh), halo_(halo), known_(slot(mesh.cells)) {}

  std::vector<double> run(std::span<const int> patches) {
    news_.assign(slot(mesh_.cells), 0);
    begin(patches);
    for (bool go = exchange(); go; go = exchange()) sweep();
    std::vector<double> distances;
    distances.reserve(slot(mesh_.owned));
    std::exception_ptr failure;
    std::int64_t failed = 0;
    for (int c = 0; c < mesh_.owned && !failure; ++c) {
      distances.push_back(known_[slot(c)].nearest[0].distance);
      if (known_[slot(c)].count > 0) continue;
      failed = mesh_.naturalCell[slot(c)];
      failure = std::make_exception_ptr(
          InputError(fmt::format("cell {} of the mesh (counted from zero) at {} is not connected with any wall", failed,
                                 placeText(mesh_.centre[slot(c)], mesh_.dimension))));
    }
    raiseFirst(mesh_.comm, failure, failed);
    return distances;
  }

 private:
  // The nearest that a cell knows, in order; with one alone more cells miss theirs.
  static constexpr int most = 4;
  struct Candidate {
    int wall = -1;  // in walls_
    double distance = 0.0;
  };
  struct Nearest {
    std::array<Candidate, most> nearest{};
    int count = 0;
  };
  static constexpr int perWall = 2 + 3 * 4;

  // The index of a wall, which stands in walls_ once.
  int indexOf(const WallFace& wall) {
    const auto [first, last] = byNumber_.equal_range(wall.number);
    for (auto it = first; it != last; ++it)
      if (walls_[slot(it->second)] == wall) return it->second;
    walls_.push_back(wall);
    byNumber_.emplace(wall.number, static_cast<int>(walls_.size()) - 1);
    return static_cast<int>(walls_.size()) - 1;
  }

  [[nodiscard]] std::int64_t numberOf(const Candidate& candidate) const { return walls_[slot(candidate.wall)].number; }

  // Which comes first: the nearer, of equals that of the smaller number.
  [[nodiscard]] bool isBefore(const Candidate& a, const Candidate& b) const {
    return a.distance != b.distance ? a.distance < b.distance : numberOf(a) < numberOf(b);
  }

  // Of one face a cell knows one image, which another replaces where it is nearer by more than round-off: that of
  // moving it there and back.
  bool offer(int cell, int wall, Nearest& to) {
    constexpr double roundOff = 1e-9;
    const auto isSame = [&](const Candidate& known) { return numberOf(known) == walls_[slot(wall)].number; };
    const auto end = to.nearest.begin() + to.count;
    const auto same = std::find_if(to.nearest.begin(), end, isSame);
    if (same != end && same->wall == wall) return false;
    const Candidate candidate{wall, distanceToFace(mesh_.centre[slot(cell)], walls_[slot(wall)].all())};
    if (same != end) {
      if (candidate.distance >= (1.0 - roundOff) * same->distance) return false;
      std::copy(same + 1, end, same);
      --to.count;
    }
    int place = to.count;
    while (place > 0 && isBefore(candidate, to.nearest[slot(place - 1)])) --place;
    if (place == most) return false;
    to.count = std::min(to.count + 1, most);
    std::copy_backward(to.nearest.begin() + place, to.nearest.begin() + to.count - 1, to.nearest.begin() + to.count);
    to.nearest[slot(place)] = candidate;
    return true;
  }

  // What the cells beside the faces know.
  void begin(std::span<const int> patches) {
    eachWall(mesh_, patches, [this](int cell, const WallFace& face) {
      if (offer(cell, indexOf(face), known_[slot(cell)])) news_[slot(cell)] = 1;
    });
  }

  // Tells the halo what owned cells know; whether anybody has news.
  bool exchange() {
    int news = std::ranges::find(news_, 1) != news_.end() ? 1 : 0;
    MPI_Allreduce(MPI_IN_PLACE, &news, 1, MPI_INT, MPI_MAX, mesh_.comm);
    if (news == 0) return false;
    halo_.exchange(
        1 + most * perWall, [this](int cell, double* out) { pack(cell, out); },
        [this](int cell, const double* in) { unpack(cell, in); });
    return true;
  }

  void pack(int cell, double* out) const {
    const Nearest& nearest = known_[slot(cell)];
    std::fill_n(out, 1 + most * perWall, 0.0);
    *out++ = news_[slot(cell)] != 0 ? nearest.count : 0;
    for (int i = 0; i < nearest.count; ++i, out += perWall) {
      const WallFace& wall = walls_[slot(nearest.nearest[slot(i)].wall)];
      out[0] = static_cast<double>(wall.number);
      out[1] = wall.corners;
      for (std::size_t k = 0; k < 4; ++k) std::ranges::copy(wall.corner[k], out + 2 + 3 * k);
    }
  }

  void unpack(int cell, const double* in) {
    const int count = static_cast<int>(*in++);
    news_[slot(cell)] = count > 0 ? 1 : 0;
    if (count == 0) return;
    Nearest& nearest = known_[slot(cell)];
    nearest.count = 0;
    for (int i = 0; i < count; ++i, in += perWall) {
      WallFace wall{static_cast<std::int64_t>(in[0]), static_cast<int>(in[1]), {}};
      for (std::size_t k = 0; k < 4; ++k) std::copy_n(in + 2 + 3 * k, 3, wall.corner[k].begin());
      nearest.nearest[slot(nearest.count++)] = {indexOf(wall), 0.0};  // its neighbours measure for themselves
    }
  }

  // All cells at once by what their neighbours knew before, so that nothing depends on the order of cells.
  void sweep() {
    const Mesh& m = mesh_;
    std::vector<std::pair<int, Nearest>> learnt;
    for (int c = 0; c < m.owned; ++c) {
      Nearest now = known_[slot(c)];
      bool isNew = false;
      for (int k = m.faceStart[slot(c)]; k < m.faceStart[slot(c) + 1]; ++k) {
        const int face = m.faceOfCell[slot(k)];
        const int other = m.low[slot(face)] == c ? m.high[slot(face)] : m.low[slot(face)];
        if (other < 0 || news_[slot(other)] == 0) continue;
        const Nearest& theirs = known_[slot(other)];
        for (int i = 0; i < theirs.count; ++i)
          isNew = offer(c, seenFrom(c, face, theirs.nearest[slot(i)].wall), now) || isNew;
      }
      if (isNew) learnt.emplace_back(c, now);
    }
    std::ranges::fill(news_, 0);
    for (const auto& [cell, nearest] : learnt) {
      known_[slot(cell)] = nearest;
      news_[slot(cell)] = 1;
    }
  }

  // A wall of the cell beyond a face, where this cell sees it: moved, if the face is of a periodic pair.
  int seenFrom(int cell, int face, int wall) {
    const Vector3 shift = mesh_.shiftBeyond(cell, face);
    if (shift == Vector3{}) return wall;
    WallFace image = walls_[slot(wall)];
    for (int i = 0; i < image.corners; ++i) image.corner[slot(i)] = difference(image.corner[slot(i)], shift);
    return indexOf(image);
  }

  const Mesh& mesh_;
  HaloExchange& halo_;
  std::vector<WallFace> walls_;
  std::unordered_multimap<std::int64_t, int> byNumber_;
  std::vector<Nearest> known_;  // of each cell
  std::vector<char> news_;      // whether that has changed in the last sweep
};

// Nearer faces than those of the distances so far, among all faces of all ranks; this rank has those of the tree.
void searchAll(const Mesh& m, const WallTree& tree, std::vector<double>& distances) {
  const WallTree::Box own = tree.box();
  std::vector<WallTree::Box> boxes(slot(m.ranks));
  MPI_Allgather(&own, 6, MPI_DOUBLE, boxes.data(), 6, MPI_DOUBLE, m.comm);
  std::vector<std::pair<int, int>> questions;  // cell, rank
  for (int c = 0; c < m.owned; ++c) {
    distances[slot(c)] = tree.nearest(m.centre[slot(c)], distances[slot(c)]);
    for (int r = 0; r < m.ranks; ++r)
      if (r != m.rank && boxes[slot(r)].distance(m.centre[slot(c)]) < distances[slot(c)]) questions.emplace_back(c, r);
  }
  constexpr std::size_t width = 4;  // place and bound
  const std::size_t portion = valuesInPortion / width;
  for (std::size_t p = 0, portions = portionsOf(m.comm, questions.size() * width); p < portions; ++p) {
    const std::size_t first = std::min(p * portion, questions.size());
    const auto some = std::span(questions).subspan(first, std::min(portion, questions.size() - first));
    std::vector<int> ranks;
    std::vector<double> asked;
    for (const auto& [cell, rank] : some) {
      ranks.push_back(rank);
      asked.insert(asked.end(), m.centre[slot(cell)].begin(), m.centre[slot(cell)].end());
      asked.push_back(distances[slot(cell)]);
    }
    const RankExchange exchange(m.comm, ranks);
    const std::vector<double> here = exchange.send(asked, static_cast<int>(width));
    std::vector<double> answers;
    for (std::size_t i = 0; i < here.size(); i += width)
      answers.push_back(tree.nearest({here[i], here[i + 1], here[i + 2]}, here[i + 3]));
    answers = exchange.reply(answers, 1);
    for (std::size_t i = 0; i < some.size(); ++i) {
      double& distance = distances[slot(some[i].first)];
      distance = std::min(distance, answers[i]);
    }
  }
}

}  // namespace

std::vector<double> wallDistance(const Mesh& mesh, HaloExchange& halo, std::span<const int> patches) {
  std::vector<double> distances = WallSweeps(mesh, halo).run(patches);
  std::vector<WallFace> own;
  eachWall(mesh, patches, [&own](int, const WallFace& face) { own.push_back(face); });
  searchAll(mesh, WallTree(std::move(own)), distances);
  return distances;
}

}  // namespace lampblack
