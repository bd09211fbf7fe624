#include "particles/trees/tree_fragmentation.hpp"

#include "particles/trees/tree_parts.hpp"

namespace lampblack::particles {

std::size_t TreeFragmentation::drawNeck(const Tree& tree, RandomStream& random) {
  const auto necks = tree.necks();
  double sum = 0;
  for (const TreeNeck& neck : necks) sum += 1 - sinteringLevel(neck);
  double at = random.uniform() * sum;
  std::size_t k = 0;
  while (k + 1 < necks.size() && (at -= 1 - sinteringLevel(necks[k])) >= 0) ++k;
  return k;
}

std::uint64_t TreeFragmentation::breakUp(Tree& tree, double oxidation, double dt, RandomStream& random,
                                         std::vector<Tree>& parts) {
  std::uint64_t broken = 0;
  const auto follow = [&](Tree& one, double left) {
    while (true) {
      const double rate = oxidation * perOxidation(one.head());
      if (!(rate > 0)) break;
      left -= random.exponential(rate);
      if (!(left > 0)) break;
      std::vector<Tree> sides = sidesOfNeck(type_, one, drawNeck(one, random));
      ++broken;
      one = std::move(sides[0]);
      waiting_.emplace_back(std::move(sides[1]), left);
    }
  };
  follow(tree, dt);
  while (!waiting_.empty()) {
    auto [part, left] = std::move(waiting_.back());
    waiting_.pop_back();
    follow(part, left);
    parts.push_back(std::move(part));
  }
  return broken;
}

}  // namespace lampblack::particles
