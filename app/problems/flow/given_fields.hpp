// Quantities of a deck's section over place and time: formulas (`formula.velocity: "0.2*(1 - (r/0.005)^2)"`) and the
// columns of a table (`table: inlet.csv`), under the same names.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/problems/flow/flow_case_parts.hpp"
#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"
#include "flow/boundaries/gas_variation.hpp"
#include "io/deck.hpp"
#include "io/units.hpp"

namespace lampblack::app::flowcase {

// Keys `formula` and `table` of a section; `names`: what may be given, for their descriptions.
void addGivenFieldKeys(DeckSchema& schema, const std::string& section, const std::string& names);

class GivenFields {
 public:
  // What may be given besides mole fractions, `X_<species>`.
  using Names = std::map<std::string, units::Dimension>;

  // Reads both. InputError for a name that is none of these, or is given twice.
  GivenFields(const Deck& deck, const std::string& section, const AxisNames& axes, const Names& names,
              const Mechanism& mechanism);

  [[nodiscard]] bool has(const std::string& name) const { return fields_.contains(name); }
  // Empty where it is not given.
  [[nodiscard]] FieldFunction find(const std::string& name) const;
  // Temperature and mole fractions.
  [[nodiscard]] GasVariation gas() const { return {find("temperature"), moleFractions_}; }
  // Whether this one, which is given, and any of them depends on time.
  [[nodiscard]] bool dependsOnTime(const std::string& name) const { return fields_.at(name).inTime; }
  [[nodiscard]] bool varyInTime() const;
  // The key of the deck that gives the name.
  [[nodiscard]] std::string keyOf(const std::string& name) const;

 private:
  void readFormulas(const Deck& deck, const std::string& section, const AxisNames& axes);
  void readTable(const Deck& deck, const std::string& section, const AxisNames& axes, const Names& names);
  void sortOut(const Deck& deck, const Names& names, const Mechanism& mechanism);

  struct Field {
    FieldFunction value;
    std::string key;
    bool inTime = false;
  };
  std::map<std::string, Field> fields_;
  std::vector<std::pair<std::size_t, FieldFunction>> moleFractions_;
};

}  // namespace lampblack::app::flowcase
