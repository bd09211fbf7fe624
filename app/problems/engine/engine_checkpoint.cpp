#include "app/problems/engine/engine_checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <string>

#include "app/run/content_hash.hpp"
#include "chemistry/mechanism/mechanism_writer.hpp"

namespace lampblack::app {
namespace {

// Of the deck as it is read, with all defaults: its lines but for what does not change a repeat.
std::string linesOf(const Deck& deck) {
  constexpr std::array free{"title", "mechanism", "checkpoint"};
  std::istringstream text(deck.resolved());
  std::string all, line, section;
  while (std::getline(text, line)) {
    if (!line.empty() && line[0] != ' ') section = line.substr(0, line.find(':'));
    const bool isFree = std::ranges::find(free, section) != free.end() ||
                        (section == "sample" && line.find("repeats:") != std::string::npos);
    if (!isFree) all += line + "\n";
  }
  return all;
}

std::string hashOf(const std::string& text) {
  ContentHash hash;
  hash.add(text);
  return hash.text();
}

}  // namespace

Fingerprint engineFingerprint(const Deck& deck, const EngineCase& made) {
  const Mechanism& mechanism = *made.mechanism;
  return {{"problem", "engine"},
          {"number of repeats", made.repeats == 1 ? "one" : "several"},
          {"deck but for repeats and checkpoints", hashOf(linesOf(deck))},
          {"mechanism", fmt::format("{} species, {} reactions, {}", mechanism.numSpecies(), mechanism.numReactions(),
                                    hashOf(mechanismYaml(mechanism)))}};
}

ArchiveOwners engineOwners(EngineProgress& progress) {
  return [&progress](StateArchive& archive) {
    archive.shared("repeats_done", progress.done);
    archive.shared("repeats", progress.repeats);
    archive.shared("first_particles", progress.particles);
    archive.shared("first_cycles", progress.cycles);
    if (progress.present) progress.present->saveOrLoad(archive);
  };
}

}  // namespace lampblack::app
