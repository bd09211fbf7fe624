#include "particles/spheres/ballistic_joining.hpp"

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"

namespace lampblack::particles {
namespace {

constexpr std::size_t fewPairs = 64 * 64;  // all of which are looked at

// The height at which the second of a pair touches the first, above `contact`.
void look(const RigidSphere& a, const RigidSphere& b, std::size_t i, std::size_t j,
          std::optional<SphereContact>& contact) {
  const double dx = a.centre[0] - b.centre[0], dy = a.centre[1] - b.centre[1], s = a.radius + b.radius;
  const double square = s * s - dx * dx - dy * dy;
  if (!(square > 0)) return;
  const double height = a.centre[2] - b.centre[2] + std::sqrt(square);
  if (!contact || height > contact->height) contact = {height, i, j};
}

void turn(const SphereAggregate& aggregate, const Rotation& by, const Vector3& shift, std::vector<RigidSphere>& to) {
  to.clear();
  for (const AggregateSphere& s : aggregate.spheres()) to.push_back({sum(turned(by, s.centre), shift), s.radius});
}

// Spheres seen from above, in squares as wide as the widest pair: those that one may touch lie in nine of them.
class Squares {
 public:
  Squares(std::span<const RigidSphere> spheres, double width) : width_(width) {
    low_ = {spheres[0].centre[0], spheres[0].centre[1]};
    std::array<double, 2> high = low_;
    for (const RigidSphere& s : spheres)
      for (std::size_t d = 0; d < 2; ++d) {
        low_[d] = std::min(low_[d], s.centre[d]);
        high[d] = std::max(high[d], s.centre[d]);
      }
    // Where they are far apart, fewer and wider squares.
    const double most = 2 * std::sqrt(static_cast<double>(spheres.size())) + 8;
    for (std::size_t d = 0; d < 2; ++d) width_ = std::max(width_, (high[d] - low_[d]) / most);
    for (std::size_t d = 0; d < 2; ++d) size_[d] = static_cast<std::int64_t>((high[d] - low_[d]) / width_) + 1;
    starts_.assign(static_cast<std::size_t>(size_[0] * size_[1]) + 1, 0);
    for (const RigidSphere& s : spheres) ++starts_[squareOf(s) + 1];
    for (std::size_t k = 1; k < starts_.size(); ++k) starts_[k] += starts_[k - 1];
    members_.resize(spheres.size());
    std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
    for (std::size_t i = 0; i < spheres.size(); ++i) members_[next[squareOf(spheres[i])]++] = i;
  }
  template <class F>
  void near(const RigidSphere& s, const F& f) const {
    const std::int64_t x = place(s, 0), y = place(s, 1);
    for (std::int64_t q = std::max<std::int64_t>(y - 1, 0); q <= std::min(y + 1, size_[1] - 1); ++q) {
      const std::int64_t from = std::max<std::int64_t>(x - 1, 0), to = std::min(x + 1, size_[0] - 1);
      if (from > to) return;
      const auto row = static_cast<std::size_t>(q * size_[0]);
      for (std::size_t m = starts_[row + static_cast<std::size_t>(from)];
           m < starts_[row + static_cast<std::size_t>(to) + 1]; ++m)
        f(members_[m]);
    }
  }

 private:
  [[nodiscard]] std::int64_t place(const RigidSphere& s, std::size_t d) const {
    return static_cast<std::int64_t>(std::floor((s.centre[d] - low_[d]) / width_));
  }
  [[nodiscard]] std::size_t squareOf(const RigidSphere& s) const {
    return static_cast<std::size_t>(place(s, 1) * size_[0] + place(s, 0));
  }
  double width_;
  std::array<double, 2> low_{};
  std::array<std::int64_t, 2> size_{};
  std::vector<std::size_t> starts_, members_;
};

}  // namespace

Rotation randomRotation(RandomStream& random) {
  const double u = random.uniform(), a = 2 * constants::pi * random.uniform(), b = 2 * constants::pi * random.uniform();
  const double x = std::sqrt(1 - u) * std::sin(a), y = std::sqrt(1 - u) * std::cos(a);
  const double z = std::sqrt(u) * std::sin(b), w = std::sqrt(u) * std::cos(b);
  return {Vector3{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
          Vector3{2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
          Vector3{2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}};
}

std::optional<SphereContact> firstContactOfPairs(std::span<const RigidSphere> first,
                                                 std::span<const RigidSphere> second) {
  std::optional<SphereContact> contact;
  for (std::size_t i = 0; i < first.size(); ++i)
    for (std::size_t j = 0; j < second.size(); ++j) look(first[i], second[j], i, j, contact);
  return contact;
}

std::optional<SphereContact> firstContact(std::span<const RigidSphere> first, std::span<const RigidSphere> second) {
  if (first.size() * second.size() <= fewPairs) return firstContactOfPairs(first, second);
  const auto widest = [](std::span<const RigidSphere> spheres) {
    double width = 0;
    for (const RigidSphere& s : spheres) width = std::max(width, s.radius);
    return width;
  };
  const Squares squares(first, widest(first) + widest(second));
  std::optional<SphereContact> contact;
  for (std::size_t j = 0; j < second.size(); ++j)
    squares.near(second[j], [&](std::size_t i) { look(first[i], second[j], i, j, contact); });
  return contact;
}

RootedSpheres rootedAt(std::span<const AggregateSphere> tree, std::size_t root) {
  const std::size_t n = tree.size();
  // Children of each, one behind the other.
  std::vector<std::size_t> starts(n + 1, 0), children(n), next;
  for (std::size_t k = 1; k < n; ++k) ++starts[tree[k].parent + 1];
  for (std::size_t k = 1; k <= n; ++k) starts[k] += starts[k - 1];
  next.assign(starts.begin(), starts.end() - 1);
  for (std::size_t k = 1; k < n; ++k) children[next[tree[k].parent]++] = k;
  RootedSpheres rooted{{root}, {0}, {0}};
  for (std::size_t at = 0; at < rooted.order.size(); ++at) {
    const std::size_t i = rooted.order[at], from = at == 0 ? n : rooted.order[rooted.joinedTo[at]];
    const auto add = [&](std::size_t j, std::size_t neck) {
      if (j == from) return;
      rooted.order.push_back(j);
      rooted.joinedTo.push_back(at);
      rooted.neckOf.push_back(neck);
    };
    if (i != 0) add(tree[i].parent, i);
    for (std::size_t c = starts[i]; c < starts[i + 1]; ++c) add(children[c], children[c]);
  }
  return rooted;
}

SphereAggregate joinedAt(std::span<const RigidSphere> firstPlaces, const SphereAggregate& first,
                         std::span<const RigidSphere> secondPlaces, const SphereAggregate& second, const Vector3& shift,
                         std::size_t atFirst, std::size_t atSecond) {
  SphereAggregate joined = first;
  std::vector<AggregateSphere>& spheres = joined.change();
  const std::size_t n = first.count();
  for (std::size_t k = 0; k < n; ++k) spheres[k].centre = firstPlaces[k].centre;
  spheres.reserve(n + second.count());
  const RootedSpheres rooted = rootedAt(second.spheres(), atSecond);
  for (std::size_t k = 0; k < rooted.order.size(); ++k) {
    AggregateSphere s = second.spheres()[rooted.order[k]];
    s.centre = sum(secondPlaces[rooted.order[k]].centre, shift);
    s.parent = static_cast<std::uint32_t>(k == 0 ? atFirst : n + rooted.joinedTo[k]);
    s.neck = k == 0 ? 0 : second.spheres()[rooted.neckOf[k]].neck;
    spheres.push_back(s);
  }
  joined.place();
  return joined;
}

std::optional<SphereContact> BallisticJoining::draw(const SphereAggregate& first, const SphereAggregate& second,
                                                    RandomStream& random) {
  const double widest = first.reach() + second.reach();
  ++tries_;
  const Rotation byFirst = randomRotation(random), bySecond = randomRotation(random);
  const double r = widest * std::sqrt(random.uniform()), angle = 2 * constants::pi * random.uniform();
  turn(first, byFirst, {}, first_);
  turn(second, bySecond, {r * std::cos(angle), r * std::sin(angle), 0}, second_);
  return firstContact(first_, second_);
}

SphereContact BallisticJoining::meet(const SphereAggregate& first, const SphereAggregate& second,
                                     RandomStream& random) {
  while (true)
    if (const auto contact = draw(first, second, random)) return *contact;
}

SphereAggregate BallisticJoining::join(const SphereAggregate& first, const SphereAggregate& second,
                                       RandomStream& random) {
  const SphereContact at = meet(first, second, random);
  return joinedAt(first_, first, second_, second, {0, 0, at.height}, at.first, at.second);
}

}  // namespace lampblack::particles
