#include "app/deck/tree_material_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/deck/fragmentation_deck.hpp"
#include "app/deck/gas_input.hpp"
#include "app/deck/particles_deck.hpp"
#include "app/deck/sintering_deck.hpp"
#include "app/deck/soot_deck.hpp"

namespace lampblack::app {
namespace {

const std::string ownTable = "particles.table.";

void addReactions(DeckSchema& schema) {
  schema
      .add(quantityKey("particles.growth_rate", units::volume / units::amount / units::time,
                       "Rate constant of the surface reaction for each site; silica: 1e13 cm^3/mol/s.")
               .optional()
               .atLeast(0)
               .onlyWith(ofOtherMaterials()))
      .add(quantityKey("particles.growth_energy", units::molarEnergy, "Activation energy of the surface reaction.")
               .byDefault("0 J/mol")
               .atLeast(0)
               .onlyWith(ofOtherMaterials()))
      .add(booleanKey("particles.intra_particle",
                      "Whether pairs of sites react within particles as fast as molecules react with sites; silica "
                      "then tends to SiO2 (Shekar et al. 2011, eq. 59, bounded at zero).")
               .byDefault("true")
               .onlyWith(ofOtherMaterials()))
      .add(choiceKey("particles.burnt_primaries", {"break", "join"},
                     "What becomes of a particle of which a primary has burnt away. break: the parts that it held "
                     "together go apart (as Neoh, Howard, Sarofim 1985 saw); join: they touch its closest neighbour.")
               .byDefault("break")
               .onlyWith(ofTrees())
               .onlyWith(ofSoot()));
  auto [breaks, factor] =
      fragmentationKeys("particles",
                        "Whether oxidation breaks aggregates at their necks, also where no primary has "
                        "burnt away: into the two parts of a neck, which is drawn.");
  for (DeckKey* key : {&breaks, &factor}) schema.add(key->onlyWith(ofTrees()).onlyWith(ofSoot()));
}

void addTable(DeckSchema& schema) {
  schema
      .section("particles.table", Presence::optional,
               "A material of the deck's own: up to three components, and the reactions of one precursor in the gas, "
               "as those of silica. Atoms have to be kept.",
               {{materialKey, {"table"}}})
      .add(stringKey(ownTable + "name", "Name of the material, with which the columns of results begin."))
      .add(stringKey(ownTable + "components[].name", "Name of the component."))
      .add(quantityKey(ownTable + "components[].weight", units::molarMass, "Mass of a mole of its units.").above(0))
      .add(stringKey(ownTable + "components[].elements", "Elements that a unit is made of.").list())
      .add(numberKey(ownTable + "components[].atoms", "Atoms in a unit, a number for each element.").list().above(0))
      .add(stringKey(ownTable + "precursor", "Species of the gas that particles are made of and grow by."))
      .add(stringKey(ownTable + "product", "Species that reactions give back to the gas."))
      .add(quantityKey(ownTable + "molecule_mass", units::mass, "Mass of a molecule of the precursor as it collides.")
               .above(0))
      .add(quantityKey(ownTable + "molecule_diameter", units::length,
                       "Diameter of a molecule of the precursor as it collides.")
               .above(0))
      .add(numberKey(ownTable + "nucleus", "Units of each component in a new particle.").list().atLeast(0))
      .add(numberKey(ownTable + "nucleus_products",
                     "Molecules of the product that two molecules of the precursor give "
                     "back as they become a new particle.")
               .byDefault("1")
               .atLeast(0))
      .add(stringKey(ownTable + "site", "Component whose units are the sites that react."))
      .add(stringKey(ownTable + "bridge",
                     "Component of which two sites become one unit, with a molecule of the product, as a particle "
                     "sinters or reacts within."))
      .add(numberKey(ownTable + "growth", "Units of each component that a particle gains as a molecule reacts with it.")
               .list())
      .add(numberKey(ownTable + "growth_products", "Molecules of the product that this gives back.")
               .byDefault("1")
               .atLeast(0))
      .add(numberKey(ownTable + "growth_power",
                     "Power n of the temperature in the rate constant growth_rate T^n "
                     "exp(-growth_energy/(R T)).")
               .byDefault("0"));
}

void addSintering(DeckSchema& schema) {
  const std::string s = "particles.sintering.";
  schema.section("particles.sintering", Presence::defaulted, "How primaries that touch become one.",
                 {ofEqualWeights()});
  addSinteringLawKeys(schema, "particles.sintering");
  schema
      .add(choiceKey(s + "size", {"smaller", "volume_to_surface"},
                     "The size d in the law: that of the smaller of two neighbours (Shekar et al. 2011), or 6 V/S of "
                     "what sinters.")
               .byDefault("smaller")
               .onlyWith(ofPrimaries()))
      .add(choiceKey(s + "between", {"neighbours", "parts"},
                     "What sinters: pairs of neighbours (Shekar et al. 2011, eq. 40); or the two parts of an aggregate "
                     "that a collision joined, with the whole volume and surface of both, as the program MOpS does.")
               .byDefault("neighbours")
               .onlyWith(ofPrimaries()))
      .add(
          choiceKey(s + "inner_parts", {"sphere", "nothing"},
                    "What the surface of parts within an aggregate goes towards where parts sinter: that of the sphere "
                    "of their volume; or nothing, as the program MOpS computes it.")
              .byDefault("sphere")
              .onlyWith(ofPrimaries()));
}

TreeMaterial readSoot(const Deck& deck, const Mechanism& mechanism) {
  SootReactions reactions;
  reactions.soot = readSootModelOptions(deck, mechanism);
  if (reactions.soot.inceptionBy == InceptionBy::monomers && reactions.soot.pah.size() != 1)
    throw deck.error("particles.pah", "nuclei of monomers need one PAH, of which two molecules make a nucleus");
  reactions.alphaOfPrimaries = deck.choice("particles.active_sites") == "primary";
  reactions.keepsHydrogen = deck.boolean("particles.keep_hydrogen");
  reactions.breaksUp = deck.choice("particles.burnt_primaries") == "break";
  reactions.fragmentation = readFragmentation(deck, "particles");
  return sootMaterial(reactions);
}

TreeUnits readUnits(const Deck& deck, const std::string& key, std::size_t components) {
  const std::vector<double> numbers = deck.numbers(key);
  if (numbers.size() != components)
    throw deck.error(key, fmt::format("{} numbers for {} components", numbers.size(), components));
  TreeUnits all{};
  std::copy(numbers.begin(), numbers.end(), all.begin());
  return all;
}

std::size_t readComponent(const Deck& deck, const std::string& key, const std::vector<TreeComponent>& components) {
  const std::string name = deck.string(key);
  const auto at = std::find_if(components.begin(), components.end(), [&](const auto& c) { return c.name == name; });
  if (at == components.end()) throw deck.error(key, fmt::format("there is no component '{}'", name));
  return static_cast<std::size_t>(at - components.begin());
}

TreeMaterial readTable(const Deck& deck) {
  if (!deck.has("particles.table")) throw deck.error(materialKey, "'table' needs the section 'particles.table'");
  if (!deck.has("particles.density"))
    throw deck.error("particles.table", "a material of the deck's own needs the key 'particles.density'");
  TreeMaterial m;
  m.name = deck.string(ownTable + "name");
  const std::size_t count = deck.size(ownTable + "components");
  if (count < 1 || count > mostTreeComponents)
    throw deck.error(ownTable + "components", fmt::format("expected 1 to {} components", mostTreeComponents));
  for (std::size_t c = 0; c < count; ++c) {
    const std::string item = fmt::format("{}components[{}].", ownTable, c);
    TreeComponent component{deck.string(item + "name"), deck.quantity(item + "weight"), {}};
    const std::vector<std::string> elements = deck.strings(item + "elements");
    const std::vector<double> atoms = deck.numbers(item + "atoms");
    if (elements.size() != atoms.size())
      throw deck.error(item + "atoms", fmt::format("{} numbers for {} elements", atoms.size(), elements.size()));
    for (std::size_t e = 0; e < elements.size(); ++e) component.elements.emplace_back(elements[e], atoms[e]);
    m.components.push_back(std::move(component));
  }
  SiteReactions r;
  r.precursor = deck.string(ownTable + "precursor");
  r.product = deck.string(ownTable + "product");
  r.moleculeMass = deck.quantity(ownTable + "molecule_mass");
  r.moleculeDiameter = deck.quantity(ownTable + "molecule_diameter");
  r.nucleus = readUnits(deck, ownTable + "nucleus", count);
  r.nucleusProducts = deck.number(ownTable + "nucleus_products");
  r.site = readComponent(deck, ownTable + "site", m.components);
  r.bridge = readComponent(deck, ownTable + "bridge", m.components);
  r.growth = readUnits(deck, ownTable + "growth", count);
  r.growthProducts = deck.number(ownTable + "growth_products");
  r.power = deck.number(ownTable + "growth_power");
  m.reactions = r;
  return m;
}

}  // namespace

void addTreeMaterialKeys(DeckSchema& schema) {
  schema.add(
      numberKey("particles.smoothing",
                "Surface that the contacts of a primary gain as it grows: 0 none, so that it rounds off, 2 as much "
                "as keeps its shape.")
          .byDefault("1")
          .atLeast(0)
          .atMost(2)
          .onlyWith(ofTrees()));
  addReactions(schema);
  addTable(schema);
  addSintering(schema);
}

SinteringLaw readSintering(const Deck& deck, SinteringLaw law) {
  const std::string s = "particles.sintering.";
  law = readSinteringLaw(deck, "particles.sintering", law);
  if (deck.has(s + "size")) {
    law.size = deck.choice(s + "size") == "smaller" ? SinteringLaw::Size::smaller : SinteringLaw::Size::volumeToSurface;
    law.between =
        deck.choice(s + "between") == "neighbours" ? SinteringLaw::Between::neighbours : SinteringLaw::Between::parts;
    law.innerSpheres = deck.choice(s + "inner_parts") == "sphere";
    if (!law.innerSpheres && law.between == SinteringLaw::Between::neighbours)
      throw deck.error(s + "inner_parts", "only where 'between' is 'parts' do parts within an aggregate sinter");
    if (law.between == SinteringLaw::Between::parts && law.size == SinteringLaw::Size::smaller)
      throw deck.error(s + "size", "parts of an aggregate sinter by 'volume_to_surface'");
  }
  requirePrefactor(deck, "particles.sintering", law);
  return law;
}

TreeMaterial readTreeMaterial(const Deck& deck, const Mechanism& mechanism) {
  const std::string name = deck.choice(materialKey);
  TreeMaterial m = name == "silica" ? silica() : name == "soot" ? readSoot(deck, mechanism) : readTable(deck);
  if (const auto density = deck.optionalQuantity("particles.density")) m.density = *density;
  if (const auto dimension = deck.optionalNumber("particles.fractal_dimension")) m.fractalDimension = *dimension;
  if (m.sites() != nullptr) {
    SiteReactions& r = m.siteReactions();
    if (const auto rate = deck.optionalQuantity("particles.growth_rate")) r.prefactor = *rate;
    r.energy = deck.quantity("particles.growth_energy");
    r.condenses = deck.boolean("particles.intra_particle");
  }
  m.smoothing = deck.optionalNumber("particles.smoothing").value_or(m.smoothing);
  m.sintering = readSintering(deck, m.sintering);
  return m;
}

}  // namespace lampblack::app
