// Equations of CHEMKIN reactions: names may hold any character and touch each other, so that an equation is read with
// the declared species at hand.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "chemistry/mechanism/reaction.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

struct ChemkinEquation {
  std::vector<StoichiometricTerm> reactants;  // each species once, coefficients added up
  std::vector<StoichiometricTerm> products;
  bool reversible = true;
  bool hasLight = false;                // "+hv" among the products
  bool hasM = false;                    // "+M" on both sides
  bool hasFalloff = false;              // "(+M)" or "(+species)" on both sides
  std::optional<std::size_t> collider;  // the species in "(+species)"
};

class ChemkinEquationParser {
 public:
  // `names` in the order of the species' indices.
  explicit ChemkinEquationParser(std::span<const std::string> names);

  // "H+O2(+M)=HO2(+M)", "2OH<=>O+H2O", "0.5 O2 + H => ...", "...=>1.5E-2BIN6+...": blanks mean nothing. Light, "hv" in
  // either case, may stand among the products unless a species has this name. Where the text can be read in several
  // ways the longest names at the left win. Throws InputError (without file and line) that names what is not known and
  // the nearest known name.
  ChemkinEquation parse(std::string_view text) const;

  std::optional<std::size_t> find(std::string_view name) const;
  // "; did you mean 'CH4'?" or nothing
  std::string suggestion(std::string_view name) const;

 private:
  struct Side {
    std::vector<StoichiometricTerm> terms;
    bool hasM = false;
    bool hasFalloff = false;
    bool hasLight = false;
    std::optional<std::size_t> collider;
  };

  std::optional<Side> parseSide(std::string_view text) const;
  bool takeTerms(std::string_view text, std::size_t at, std::vector<bool>& hopeless, Side& side) const;
  std::optional<std::size_t> falloffEnd(std::string_view text, std::size_t at, Side& side) const;
  [[noreturn]] void explain(std::string_view text) const;

  std::vector<std::string> names_;
  std::unordered_map<std::string, std::size_t> index_;
  std::size_t longest_ = 0;
};

}  // namespace lampblack::chemistry
