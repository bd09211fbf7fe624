// Published models of soot in the gas of the 101 species of ethylene.
#pragma once

#include <memory>
#include <string>

#include "tests/coupling/toy_particles.hpp"
#include "tests/particles/models/published_models.hpp"

namespace lampblack::test {

inline std::unique_ptr<SootModel> modelOf(const std::string& name) {
  const auto weight = [](const char* element) { return ethylene().atomicWeight(ethylene().elementIndex(element)); };
  SootModelOptions shared;
  shared.pah = {{"A2", 10, 8, 2e-3}};
  shared.carbonWeight = weight("C");
  shared.hydrogenWeight = weight("H");
  return publishedModel(name, shared);
}

}  // namespace lampblack::test
