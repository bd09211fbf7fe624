#include "app/deck/soot_models/soot_models.hpp"

namespace lampblack::app {

const std::vector<SootModelEntry>& sootModels() {
  static const std::vector<SootModelEntry> table{twoEquationDimerEntry(), leungEntry(), mossBrookesEntry(),
                                                 sectionalEntry(),        hmomEntry(),  momicEntry()};
  return table;
}

}  // namespace lampblack::app
