// The table of soot models. A model is one row of it and one file beside this one, with its keys and how they are read.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"
#include "io/deck.hpp"
#include "particles/gas/soot_gas.hpp"
#include "particles/models/particle_model.hpp"

namespace lampblack::app {

struct SootModelEntry {
  std::string name;              // as in `particles.description`
  std::string description;       // what it carries, who published it
  void (*addKeys)(DeckSchema&);  // those of this model alone; null where it has none, or where an earlier row has them
  SootModelOptions (*defaults)();  // of what the section says of PAH, surface and switches
  // Of a deck with this model. InputError, pointing into the deck or not.
  std::unique_ptr<ParticleModel> (*read)(const Deck&, const Mechanism&);
};

SootModelEntry twoEquationDimerEntry();
SootModelEntry leungEntry();
SootModelEntry mossBrookesEntry();
SootModelEntry sectionalEntry();
SootModelEntry hmomEntry();
SootModelEntry momicEntry();

const std::vector<SootModelEntry>& sootModels();

}  // namespace lampblack::app
