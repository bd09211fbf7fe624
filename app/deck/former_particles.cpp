#include "app/deck/former_particles.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <utility>
#include <vector>

#include "io/deck_former_sections.hpp"
#include "io/deck_node.hpp"

namespace lampblack::app {
namespace {

using Settings = std::vector<std::string>;

std::string textOf(const DeckNode* section, const char* key, const char* otherwise) {
  const DeckNode* node = section == nullptr ? nullptr : section->child(key);
  return node != nullptr && node->kind == DeckNode::Kind::scalar ? node->text : otherwise;
}

// A key that the section says by being there.
void say(DeckNode& section, const char* key, const std::string& text, Settings& said) {
  if (section.kind == DeckNode::Kind::null) section.kind = DeckNode::Kind::map;
  if (section.kind != DeckNode::Kind::map) return;  // which is told where its keys move
  DeckNode node;
  node.kind = DeckNode::Kind::scalar;
  node.name = key;
  node.text = text;
  node.nameAt = node.at = section.nameAt;
  section.children.push_back(std::move(node));
  said.push_back(fmt::format("'{}: {}'", key, text));
}

void rename(DeckNode& section, const char* before, const char* now, Settings& said) {
  DeckNode* node = section.child(before);
  if (node == nullptr) return;
  node->name = now;
  said.push_back(fmt::format("'{}' as '{}'", before, now));
}

void remove(DeckNode& section, const char* key) {
  std::erase_if(section.children, [&](const DeckNode& child) { return child.name == key; });
}

// Beside other particles the model was one in their place, or the one that the gas carries.
void settleModel(const DeckSource& source, DeckNode& soot, bool besideModel, Settings& said) {
  DeckNode* model = soot.child("model");
  if (besideModel) {
    if (model == nullptr)
      say(soot, "carried", "two_equation_dimer", said);
    else
      rename(soot, "model", "carried", said);
    return;
  }
  if (model == nullptr) return;
  if (model->text != "none")
    throw deckError(source, model->nameAt, "soot.model",
                    "an ensemble or trees take the place of a model: leave this out, or what the deck says of them");
  remove(soot, "model");
}

// Trees were a section of their own, of silica unless it said otherwise.
void settleTrees(const DeckSource& source, DeckNode& trees, DeckNode* soot, bool besideModel, Settings& said) {
  const std::string material = textOf(&trees, "material", "silica");
  if (soot != nullptr && material != "soot")
    throw deckError(source, soot->nameAt, "soot",
                    fmt::format("the particles of the deck are of {}; leave out one of the two", material));
  if (trees.child("material") == nullptr) say(trees, "material", material, said);
  if (textOf(&trees, "shape", "trees") == "surface_volume") {
    say(trees, "description", "ensemble", said);
  } else {
    if (textOf(&trees, "shape", "") == "trees") remove(trees, "shape");
    say(trees, "description", "trees", said);
  }
  rename(trees, "inception", "inception_kernel", said);
  if (soot != nullptr) settleModel(source, *soot, besideModel, said);
}

// A deck that has the section of now, and former ones from --set. `stochastic` asked for an ensemble.
void settleBesidePresent(const DeckSource& source, DeckNode& root, bool besideModel, Settings& said) {
  DeckNode& description = *root.child("particles")->child("description");
  const bool isOfFile = description.at.overrideIndex == -1;
  for (const char* former : {"soot", "stochastic"})
    if (const DeckNode* node = root.child(former))
      if (node->nameAt.overrideIndex == -1 && isOfFile)
        throw deckError(source, node->nameAt, former,
                        "the section 'particles' has taken its place, and is given too; write its keys there");
  DeckNode* soot = root.child("soot");
  const bool isModel = description.text != "ensemble" && description.text != "trees";
  if (isModel && root.child("stochastic") != nullptr && isOfFile) {
    const std::string model = textOf(soot, "model", besideModel ? description.text.c_str() : "none");
    if (!besideModel && model != "none")
      throw deckError(
          source, root.child("stochastic")->nameAt, "stochastic",
          fmt::format("an ensemble takes the place of the model {}: set 'particles.description=ensemble'", model));
    if (soot != nullptr) remove(*soot, "model");
    description.text = "ensemble";
    said.emplace_back("'description: ensemble'");
    if (besideModel) say(*root.child("particles"), "carried", model, said);
  } else if (!isModel && soot != nullptr && soot->child("model") != nullptr) {
    settleModel(source, *soot, besideModel, said);
  }
}

Settings settle(const DeckSource& source, DeckNode& root, bool besideModel, std::vector<std::string>& notes) {
  Settings said;
  DeckNode *soot = root.child("soot"), *stochastic = root.child("stochastic"), *trees = root.child("particles");
  if (trees != nullptr && trees->child("description") != nullptr) {
    settleBesidePresent(source, root, besideModel, said);
    return said;
  }
  if (trees != nullptr) {
    if (trees->kind == DeckNode::Kind::scalar || trees->kind == DeckNode::Kind::list)
      return said;  // a mistake that the check of the keys tells
    // Trees of soot needed a section of soot, and had no such keys: here the key `description` has been forgotten.
    const bool isOfSoot = textOf(trees, "material", "") == "soot" || trees->child("pah") != nullptr;
    if (isOfSoot && soot == nullptr && stochastic == nullptr) return said;
    settleTrees(source, *trees, soot, besideModel, said);
    notes.push_back(formerNote(source, trees->nameAt, "trees are one description of 'particles'",
                               fmt::format("write {} there", fmt::join(said, ", "))));
    return {};
  }
  if (stochastic != nullptr) {
    say(*stochastic, "description", "ensemble", said);
    if (soot != nullptr) settleModel(source, *soot, besideModel, said);
  } else if (soot != nullptr && soot->child("model") == nullptr) {
    say(*soot, "description", "two_equation_dimer", said);
  }
  return said;
}

}  // namespace

FormerSections formerParticleSections(bool besideModel) {
  return {{{"soot", "particles"},
           {"soot.model", "particles.description"},
           {"stochastic", "particles"},
           {"stochastic.growth", "particles.growth_by"}},
          [besideModel](const DeckSource& source, DeckNode& root, std::vector<std::string>& notes) {
            return settle(source, root, besideModel, notes);
          }};
}

}  // namespace lampblack::app
