// Every soot model with its published constants, for tests that hold for all of them.
#pragma once

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "particles/models/moments/hmom.hpp"
#include "particles/models/moments/momic_soot.hpp"
#include "particles/models/sectional/sectional_soot.hpp"
#include "particles/models/semi_empirical/semi_empirical_soot.hpp"
#include "particles/models/two_equation/dimer_soot.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

inline const std::vector<std::string> publishedModels{"two_equation_dimer", "leung", "moss_brookes",
                                                      "sectional",          "hmom",  "momic"};

// With the PAH and the atomic weights of `shared`, of which the semi-empirical models take the carbon's.
inline std::unique_ptr<SootModel> publishedModel(const std::string& name, const SootModelOptions& shared) {
  const auto with = [&](auto options) {
    options.soot.pah = shared.pah;
    options.soot.carbonWeight = shared.carbonWeight;
    options.soot.hydrogenWeight = shared.hydrogenWeight;
    return options;
  };
  const auto semiEmpirical = [&](SemiEmpiricalOptions options) {
    options.carbonWeight = shared.carbonWeight;
    return std::make_unique<SemiEmpiricalSoot>(options);
  };
  if (name == "two_equation_dimer") return std::make_unique<DimerSoot>(shared);
  if (name == "leung") return semiEmpirical(leungSoot());
  if (name == "moss_brookes") return semiEmpirical(mossBrookesSoot());
  if (name == "sectional") return std::make_unique<SectionalSoot>(with(SectionalSootOptions{}));
  if (name == "hmom") return std::make_unique<HmomSoot>(with(HmomOptions{}));
  if (name == "momic") return std::make_unique<MomicSoot>(with(MomicOptions{}));
  throw std::logic_error("no test knows the soot model " + name);
}

}  // namespace lampblack::test
