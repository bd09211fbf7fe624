// Two aggregates that meet on a straight line, as in a gas without collisions: both turned at random, the line drawn
// uniformly in a disc that holds all lines on which they may touch, and moved until they touch, exactly. They become
// one, joined where they touched. docs/theory/spheres.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "core/random.hpp"
#include "particles/spheres/sphere_aggregate.hpp"

namespace lampblack::particles {

using Rotation = std::array<Vector3, 3>;  // rows
[[nodiscard]] inline Vector3 turned(const Rotation& by, const Vector3& v) {
  return {dot(by[0], v), dot(by[1], v), dot(by[2], v)};
}
// Uniform over all rotations (Shoemake 1992); three random numbers.
[[nodiscard]] Rotation randomRotation(RandomStream& random);

struct RigidSphere {
  Vector3 centre{};
  double radius = 0;
};
struct SphereContact {
  double height = 0;  // by which the second is moved along z as it comes down from above and touches the first
  std::size_t first = 0, second = 0;
};
// None where they pass each other.
[[nodiscard]] std::optional<SphereContact> firstContact(std::span<const RigidSphere> first,
                                                        std::span<const RigidSphere> second);
// The same by looking at all pairs.
[[nodiscard]] std::optional<SphereContact> firstContactOfPairs(std::span<const RigidSphere> first,
                                                               std::span<const RigidSphere> second);

class BallisticJoining {
 public:
  // Joined in point contact.
  [[nodiscard]] SphereAggregate join(const SphereAggregate& first, const SphereAggregate& second, RandomStream& random);
  // One line, and where they touch on it; none where they pass each other.
  [[nodiscard]] std::optional<SphereContact> draw(const SphereAggregate& first, const SphereAggregate& second,
                                                  RandomStream& random);
  // Where the second touches the first; how both stand then, the second not yet moved by the height of the contact, is
  // in firstPlaces() and secondPlaces().
  SphereContact meet(const SphereAggregate& first, const SphereAggregate& second, RandomStream& random);
  [[nodiscard]] std::span<const RigidSphere> firstPlaces() const { return first_; }
  [[nodiscard]] std::span<const RigidSphere> secondPlaces() const { return second_; }
  [[nodiscard]] std::uint64_t tries() const { return tries_; }  // lines drawn by all calls

 private:
  std::vector<RigidSphere> first_, second_;
  std::uint64_t tries_ = 0;
};

// The spheres of an aggregate from one of them on, each behind the one that it is joined to; the place of that one
// among them, and the sphere of the aggregate that has their neck.
struct RootedSpheres {
  std::vector<std::size_t> order, joinedTo, neckOf;
};
[[nodiscard]] RootedSpheres rootedAt(std::span<const AggregateSphere> spheres, std::size_t root);

// Both as they stand, the second moved by `shift`, joined by a neck without width between these two spheres.
[[nodiscard]] SphereAggregate joinedAt(std::span<const RigidSphere> firstPlaces, const SphereAggregate& first,
                                       std::span<const RigidSphere> secondPlaces, const SphereAggregate& second,
                                       const Vector3& shift, std::size_t atFirst, std::size_t atSecond);

}  // namespace lampblack::particles
