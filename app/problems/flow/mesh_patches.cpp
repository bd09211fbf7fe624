#include "app/problems/flow/mesh_patches.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "core/errors.hpp"
#include "core/nearest_name.hpp"

namespace lampblack::app {
namespace {

std::vector<std::string> namesInDeck(std::vector<std::string> patches) {
  for (std::string& patch : patches) patch = nameInDeck(std::move(patch));
  return patches;
}

// The patch that a name of the deck stands for; a group without a name goes by its number, too. patches.size(): none.
// InputError where it stands for several.
std::size_t patchOf(const std::vector<std::string>& patches, const std::string& name) {
  const auto isNamed = [&](const std::string& patch) { return nameInDeck(patch) == name; };
  const auto found = std::ranges::find_if(patches, isNamed);
  if (found == patches.end())
    return static_cast<std::size_t>(std::ranges::find(patches, "physical " + name) - patches.begin());
  const auto other = std::find_if(found + 1, patches.end(), isNamed);
  if (other != patches.end())
    throw InputError(fmt::format(
        "the groups '{}' and '{}' of the mesh have this one name in a deck; give one of them another in the mesh file",
        *found, *other));
  return static_cast<std::size_t>(found - patches.begin());
}

// The number of each of the file's patches among the boundaries; -1: periodic. Those that the deck does not name are
// behind the boundaries, for only the mesh knows whether they are part of the surface.
std::vector<int> numbersOf(const std::vector<std::string>& patches, const FlowCase& flowCase) {
  const MeshFile& file = *flowCase.meshFile;
  std::vector<std::string> known = file.periodic;
  for (const BoundaryCondition& boundary : flowCase.boundaries) known.push_back(boundary.name);
  constexpr int unknown = -2;
  std::vector<int> numbers(patches.size(), unknown);
  for (std::size_t k = 0; k < known.size(); ++k) {
    const std::string key = "boundaries." + known[k];
    const std::size_t patch = file.deck.at(key, [&] { return patchOf(patches, known[k]); });
    if (patch == patches.size())
      throw file.deck.error(key, fmt::format("there is no such part of the mesh; {}{}", namesText(patches, flowCase),
                                             didYouMean(known[k], namesInDeck(patches))));
    if (numbers[patch] != unknown)
      throw file.deck.error(
          key,
          fmt::format("this is the group '{}', which has another boundary; leave one of them out", patches[patch]));
    numbers[patch] = k < file.periodic.size() ? -1 : static_cast<int>(k - file.periodic.size());
  }
  auto behind = static_cast<int>(flowCase.boundaries.size());
  for (int& patch : numbers)
    if (patch == unknown) patch = behind++;
  return numbers;
}

}  // namespace

std::string nameInDeck(std::string patch) {
  std::ranges::replace_if(
      patch, [](char c) { return c == '.' || c == '[' || c == ']'; }, '_');
  return patch;
}

std::string namesText(const std::vector<std::string>& patches, const FlowCase& flowCase) {
  const std::string file = flowCase.meshFile->path.string();
  if (patches.empty())
    return fmt::format("{} has no names: give the {} of its surface physical groups", file,
                       flowCase.dimension == 3 ? "faces" : "lines");
  return fmt::format("{} has these names: {}", file, fmt::join(namesInDeck(patches), ", "));
}

std::vector<std::string> orderPatches(MeshBlock& block, const FlowCase& flowCase) {
  const std::vector<int> boundaryOf = numbersOf(block.patches, flowCase);
  for (MeshBlock::NamedFace& face : block.named) face.patch = boundaryOf[static_cast<std::size_t>(face.patch)];
  std::erase_if(block.named, [](const MeshBlock::NamedFace& face) { return face.patch < 0; });
  std::vector<std::string> others;
  for (std::size_t patch = 0; patch < block.patches.size(); ++patch)
    if (boundaryOf[patch] >= static_cast<int>(flowCase.boundaries.size())) others.push_back(block.patches[patch]);
  block.patches.clear();
  for (const BoundaryCondition& boundary : flowCase.boundaries) {
    block.patches.push_back(boundary.name);
    block.isThinWall.push_back(boundary.kind == BoundaryKind::Wall ? 1 : 0);
  }
  block.patches.insert(block.patches.end(), others.begin(), others.end());
  block.isThinWall.resize(block.patches.size(), 0);
  return others;
}

}  // namespace lampblack::app
