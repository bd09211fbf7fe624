#include "app/deck/checkpoint_deck.hpp"

namespace lampblack::app {

DeckKeys<CheckpointTimes> checkpointKeys(const std::string& more) {
  DeckKeys<CheckpointTimes> keys("checkpoint");
  keys.quantity("wall_time", units::time, &CheckpointTimes::wallTime, rules().byDefault("30 min").above(0),
                "Wall time between two checkpoints.");
  keys.boolean("at_end", &CheckpointTimes::atEnd, rules().byDefault("false"),
               "Write a checkpoint at the end of the run too, from which it can go on to " + more + ".");
  return keys;
}

}  // namespace lampblack::app
