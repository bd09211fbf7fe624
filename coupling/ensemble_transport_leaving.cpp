// Which particles a cell has, which of them leave it, and through which of its faces.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "coupling/ensemble_transport_sides.hpp"
#include "particles/collisions/sphere.hpp"
#include "particles/population/monte_carlo/systematic_sample.hpp"

namespace lampblack::coupling {
namespace {

// In how many pieces a numerical particle goes where no more than `whole` goes as one.
double piecesIn(double number, double whole) {
  constexpr double most = 1000.0;
  return number > whole ? std::min(std::ceil(number / whole), most) : 1.0;
}

// The side to which a point belongs below the last of the sums.
std::size_t sideAt(double point, std::span<const double> upTo) {
  std::size_t s = 0;
  while (s + 1 < upTo.size() && point >= upTo[s]) ++s;
  return s;
}

}  // namespace

// A population of equal numbers has no place for what would stay of one; those that have arrived are still apart from
// it.
bool EnsembleTransport::goesInPieces(std::uint32_t place) const {
  return Content::hasArrived(place) || !options_.rows.haveEqualNumbers;
}

// Puts the particles of a cell in order of size.
void EnsembleTransport::takeStock(int cell, std::span<const double> population, std::span<const double> arrived) {
  constexpr std::uint32_t singles = nodes;
  Content& content = contents_[cell];
  content = {};
  content.order = order_.size();
  content.before = arrived.size();
  stock_.resize(options_.rows.count(population) + options_.rows.count(arrived));
  Stock* next = stock_.data();
  double all = 0.0;
  std::array<double, classes> numbers{}, lightest;
  std::array<int, classes> counts{};
  lightest.fill(std::numeric_limits<double>::infinity());
  const auto take = [&](std::span<const double> rows, std::size_t first, bool haveArrived) {
    options_.rows.forEach(rows, [&](const double* row) {
      const double mass = massAt(row), number = row[packedNumberAt], volume = mass * perDensity_;
      const auto k = static_cast<std::size_t>(classOf(volume));
      lightest[k] = std::min(lightest[k], mass);
      all += number;
      numbers[k] += number;
      ++counts[k];
      const auto node = static_cast<std::uint32_t>(exponentOf(volume) - smallest);
      *next++ = {number, std::min(node, singles), 1,
                 Content::placeOf(first + static_cast<std::size_t>(row - rows.data()), haveArrived)};
    });
  };
  take(population, options_.rows.head, false);
  take(arrived, 0, true);
  content.number = all;
  content.count = static_cast<std::int64_t>(stock_.size());
  content.numbers = numbers;
  content.counts = counts;
  content.lightest = lightest;
  // Pieces of a particle are places one after the other.
  const double whole = content.whole();
  for (Stock& one : stock_) {
    if (one.number > whole && one.node != singles && goesInPieces(one.place))
      one.pieces = static_cast<std::uint32_t>(piecesIn(one.number, whole));
    content.upTo[one.node] += one.pieces;
  }
  std::array<std::uint32_t, nodes + 1> begins{};
  for (std::size_t node = 1; node < begins.size(); ++node) {
    begins[node] = content.upTo[node - 1];
    content.upTo[node] += begins[node];
  }
  order_.resize(content.order + content.upTo.back());
  std::uint32_t* order = order_.data() + content.order;
  for (const Stock& one : stock_)
    for (std::uint32_t pieces = one.pieces; pieces > 0; --pieces) order[begins[one.node]++] = one.place;
}

// What the chances to leave of a particle depend on, `d` being the diameter (m) of the sphere of its volume (m3).
EnsembleTransport::Size EnsembleTransport::sizeOf(double volume, double d, double primaries) const {
  Size size{classOf(volume), {}, 0.0};
  double ofMobility = volume;
  if (primaries > 1.0 && !options_.type.coalescing()) {
    d *= SootAggregate::mobilityFactor(primaries) / std::cbrt(primaries);
    ofMobility = constants::pi / 6.0 * d * d * d;
  }
  size.at = between(ofMobility, smallest, nodes);
  size.perSquare = 1.0 / (d * d);
  return size;
}

// The sums of its probabilities to leave through the sides up to each of them; returns that of all.
double EnsembleTransport::sumChances(const Size& size, const std::vector<Side>& sides, SideValues& upTo) const {
  upTo = lanes_->chances(size);
  if (lanes_->hasWall)
    for (std::size_t s = 0; s < sides.size(); ++s)
      if (sides[s].isWall) upTo[s] = lanes_->toWall(s, sides[s], size);
  double sum = 0.0;
  for (std::size_t s = 0; s < sides.size(); ++s) upTo[s] = sum += lengths_[size.ofClass] * upTo[s];
  return sum;
}

// Of spheres between a node and the next, and of aggregates of that volume, which diffuse less: no sum of chances to
// leave is above this, which is zero for those that do not move. D falls with the volume, D d^2 rises.
void EnsembleTransport::boundChances(const std::vector<Side>& sides, std::span<double, nodes> bounds) const {
  std::ranges::fill(bounds, 0.0);
  for (std::size_t node = 0; node < nodes; ++node) {
    const auto [diameter, perSquare, k] = nodes_[node];
    if (lengths_[k] == 0.0) continue;
    const SideValues most = lanes_->mostChances(k, node, perSquare);
    for (std::size_t s = 0; s < sides.size(); ++s)
      bounds[node] += sides[s].isWall ? lanes_->mostToWall(s, sides[s], k, node, perSquare) : most[s];
    bounds[node] *= lengths_[k];
  }
}

// The drawing of a cell in a part of a step.
struct EnsembleTransport::Draw {
  int cell;
  const std::vector<Side>& sides;
  Content& content;
  std::array<bool, classes> isLimited;
  std::array<double, nodes> bounds;  // boundChances()
  double whole;                      // 1/m3, that a particle may stand for that goes as one
  double point;                      // nextEvenPoint()
};

void EnsembleTransport::drawLeaving(int cell, const std::vector<Side>& sides, RandomStream& random, Rows& population,
                                    Rows& arrived) {
  if (sides.empty()) return;
  Content& content = contents_[cell];
  Draw draw{cell, sides, content, {}, {}, content.whole(), random.uniform()};
  for (const Side& side : sides)
    for (std::size_t k = 0; k < draw.isLimited.size(); ++k) draw.isLimited[k] = draw.isLimited[k] || side.isLimited[k];
  for (std::size_t k = 0; k < draw.isLimited.size(); ++k)
    if (draw.isLimited[k]) limited_ += content.counts[k];
  boundChances(sides, draw.bounds);
  const std::size_t end = arrived.size();  // before any leaves
  const auto rowAt = [&](std::uint32_t place) {
    return &(Content::hasArrived(place) ? arrived : population)[place >> 1U];
  };
  // Teeth at one another's distance of one along the line of the bounds of all pieces, one after the other.
  hits_.clear();
  double tooth = random.uniform();
  std::size_t first = content.order;
  for (std::size_t node = 0; node < nodes; ++node) {
    const std::size_t last = content.order + content.upTo[node], count = last - first;
    const double most = std::min(draw.bounds[node], 1.0), length = most * static_cast<double>(count);
    for (; tooth < length; tooth += 1.0) {
      const std::size_t entry = first + std::min(count - 1, static_cast<std::size_t>(tooth / most));
      if (order_[entry] == Content::nowhere) continue;
      __builtin_prefetch(rowAt(order_[entry]));  // rows lie anywhere: they are waited for together
      hits_.push_back({entry, most});
    }
    tooth -= length;
    first = last;
  }
  measureHits(population, arrived);
  for (std::size_t hit = 0, next = 0; hit < hits_.size(); hit = next) {
    const std::uint32_t place = order_[hits_[hit].entry];
    while (next < hits_.size() && order_[hits_[next].entry] == place) ++next;
    double* row = rowAt(place);
    drawHits(draw, row, sizeOf(volumes_[hit], diameters_[hit], row[2]), std::span(hits_).subspan(hit, next - hit));
  }
  for (; first < content.order + content.upTo[nodes]; ++first)
    drawPieces(draw, rowAt(order_[first]), goesInPieces(order_[first]));
  for (std::size_t i = content.before; i < end; i += options_.rows.lengthOf(&arrived[i]))
    drawPieces(draw, &arrived[i], true);
}

// Of those that are hit: volumes, and the diameters of spheres of these (nodes have no others than normal numbers).
void EnsembleTransport::measureHits(const Rows& population, const Rows& arrived) {
  volumes_.resize(hits_.size());
  diameters_.resize(hits_.size());
  for (std::size_t k = 0; k < hits_.size(); ++k) {
    const std::uint32_t place = order_[hits_[k].entry];
    volumes_[k] = volumeOf(&(Content::hasArrived(place) ? arrived : population)[place >> 1U]);
  }
  for (std::size_t k = 0; k < hits_.size(); ++k) diameters_[k] = normalCubeRoot(6 * volumes_[k] / constants::pi);
}

// Of a particle of which these pieces are looked at, each with the probability of its hit.
void EnsembleTransport::drawHits(Draw& draw, double* row, const Size& size, std::span<const Hit> hits) {
  SideValues upTo, leaving{};
  const double sum = sumChances(size, draw.sides, upTo);
  if (sum > 1.0 && !draw.isLimited[size.ofClass]) ++limited_;
  std::uint32_t gone = 0;
  for (const Hit& hit : hits) {
    nextEvenPoint(draw.point);
    const double drawn = draw.point * (sum > 1.0 ? sum : hit.most);
    if (drawn >= sum) continue;
    leaving[sideAt(drawn, std::span(upTo).first(draw.sides.size()))] += 1.0;
    ++gone;
  }
  if (gone == 0) return;
  // Its pieces that are there, of which the last ones go.
  const std::size_t begin = draw.content.order, end = begin + draw.content.upTo[nodes - 1];
  std::size_t first = hits.front().entry, last = first + 1;
  const std::uint32_t place = order_[first];
  while (first > begin && order_[first - 1] == place) --first;
  while (last < end && order_[last] == place) ++last;
  leave(draw, row, size.ofClass, leaving, static_cast<double>(last - first));
  std::fill_n(order_.begin() + static_cast<std::ptrdiff_t>(last - gone), gone, Content::nowhere);
}

// One of any size that may stand for any number. Most stay, which their bound tells.
void EnsembleTransport::drawPieces(Draw& draw, double* row, bool inPieces) {
  const double volume = volumeOf(row);
  if (!(row[packedNumberAt] > 0.0) || lengths_[classOf(volume)] == 0.0) return;
  const double pieces = inPieces ? piecesIn(row[packedNumberAt], draw.whole) : 1.0;
  const int node = exponentOf(volume) - smallest;
  if (pieces == 1.0 && node >= 0 && node < static_cast<int>(nodes)) {
    double drawn = draw.point;
    nextEvenPoint(drawn);
    if (drawn >= draw.bounds[static_cast<std::size_t>(node)]) {
      draw.point = drawn;
      return;
    }
  }
  SideValues upTo, leaving{};
  const Size size = sizeOf(volume, sphereDiameter(volume), row[2]);
  const double sum = sumChances(size, draw.sides, upTo);
  if (sum > 1.0 && !draw.isLimited[size.ofClass]) ++limited_;
  bool isLeaving = false;
  for (int piece = 0; piece < static_cast<int>(pieces); ++piece) {
    nextEvenPoint(draw.point);
    const double drawn = sum > 1.0 ? draw.point * sum : draw.point;
    if (drawn >= sum) continue;
    leaving[sideAt(drawn, std::span(upTo).first(draw.sides.size()))] += 1.0;
    isLeaving = true;
  }
  if (isLeaving) leave(draw, row, size.ofClass, leaving, pieces);
}

// So many of its pieces go through each side.
void EnsembleTransport::leave(Draw& draw, double* row, int ofClass, const SideValues& pieces, double of) {
  const std::size_t length = options_.rows.lengthOf(row);
  const double number = row[packedNumberAt], inCell = number * context_.mesh.volume[draw.cell];
  double stay = of;
  for (std::size_t s = 0; s < draw.sides.size(); ++s) {
    if (!(pieces[s] > 0.0)) continue;
    stay -= pieces[s];
    const Side& side = draw.sides[s];
    Rows& to = side.beyond < 0 ? gone_ : leavingRows_;
    if (side.beyond >= 0)
      leaving_.push_back({side.face, side.beyond, ofClass, to.size()});
    else
      goneThrough_.push_back(side.face);
    to.insert(to.end(), row, row + length);
    to[to.size() - length + packedNumberAt] = inCell * pieces[s] / of;
  }
  row[packedNumberAt] = stay > 0.0 ? number * stay / of : 0.0;
  draw.content.hasLost = draw.content.hasLost || !(stay > 0.0);
  draw.content.add(ofClass, row[packedNumberAt] - number, stay > 0.0 ? 0 : -1);
}

// Takes out the rows that have the number zero.
void EnsembleTransport::removeGone(Rows& rows, std::size_t head) const {
  if (rows.size() <= head) return;
  std::size_t kept = head, next = head;
  if (!options_.rows.haveLengths) {  // without a branch
    for (std::size_t i = head; i < rows.size(); i += packedParticle) {
      std::array<double, packedParticle> row;
      std::copy_n(&rows[i], packedParticle, row.data());
      std::ranges::copy(row, &rows[kept]);
      kept += row[packedNumberAt] > 0.0 ? packedParticle : 0;
    }
    rows.resize(kept);
    return;
  }
  for (std::size_t i = head; i < rows.size(); i = next) {
    const std::size_t length = options_.rows.lengthOf(&rows[i]);
    next = i + length;
    if (!(rows[i + packedNumberAt] > 0.0)) continue;
    if (kept != i) std::copy_n(&rows[i], length, &rows[kept]);
    kept += length;
  }
  rows.resize(kept);
}

}  // namespace lampblack::coupling
