// All soot models that a gas can carry, by the names that decks use, with their published constants.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "particles/soot/hmom.hpp"
#include "particles/soot/momic_soot.hpp"
#include "particles/soot/sectional_soot.hpp"
#include "particles/soot/semi_empirical_soot.hpp"
#include "particles/soot/soot_model.hpp"
#include "particles/soot_gas.hpp"

namespace lampblack {

// SootModelOptions are those of the dimer two-equation model.
using SootModelChoice =
    std::variant<SootModelOptions, SemiEmpiricalOptions, SectionalSootOptions, HmomOptions, MomicOptions>;

// "two_equation_dimer", "leung", "moss_brookes", "sectional", "hmom", "momic".
[[nodiscard]] const std::vector<std::string>& sootModelNames();

// The model of this name as published, without PAH. Throws InputError for another name.
[[nodiscard]] SootModelChoice publishedSootModel(std::string_view name);

// The options that a choice shares with the other models; null for the semi-empirical ones, which have none.
[[nodiscard]] SootModelOptions* sharedOptions(SootModelChoice& choice);

[[nodiscard]] std::unique_ptr<SootModel> makeSootModel(const SootModelChoice& choice);  // throws InputError

}  // namespace lampblack
