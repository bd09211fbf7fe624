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
#include "io/deck_keys.hpp"

namespace lampblack::app {
namespace {

const std::string ownTable = "particles.table.";

void addReactions(DeckSchema& schema) {
  SectionKeys keys("particles");
  keys.quantity("growth_rate", units::volume / units::amount / units::time,
                rules().optional().atLeast(0).onlyWith(ofOtherMaterials()),
                "Rate constant of the surface reaction for each site; silica: 1e13 cm^3/mol/s.");
  keys.quantity("growth_energy", units::molarEnergy,
                rules().byDefault("0 J/mol").atLeast(0).onlyWith(ofOtherMaterials()),
                "Activation energy of the surface reaction.");
  keys.boolean("intra_particle", rules().byDefault("true").onlyWith(ofOtherMaterials()),
               "Whether pairs of sites react within particles as fast as molecules react with sites; silica then tends "
               "to SiO2 (Shekar et al. 2011, eq. 59, bounded at zero).");
  keys.choice("burnt_primaries", {"break", "join"}, rules().byDefault("break").onlyWith(ofTrees()).onlyWith(ofSoot()),
              "What becomes of a particle of which a primary has burnt away. break: the parts that it held together go "
              "apart (as Neoh, Howard, Sarofim 1985 saw); join: they touch its closest neighbour.");
  auto [breaks, factor] =
      fragmentationKeys("particles",
                        "Whether oxidation breaks aggregates at their necks, also where no primary has "
                        "burnt away: into the two parts of a neck, which is drawn.");
  for (DeckKey* key : {&breaks, &factor}) keys.add(key->onlyWith(ofTrees()).onlyWith(ofSoot()));
  schema.add(keys.schema());
}

DeckKeys<SiteReactions> tableKeys() {
  DeckKeys<SiteReactions> keys("particles.table");
  keys.section(Presence::optional,
               "A material of the deck's own: up to three components, and the reactions of one precursor in the gas, "
               "as those of silica. Atoms have to be kept.",
               {{materialKey, {"table"}}});
  keys.text("name", rules(), "Name of the material, with which the columns of results begin.");
  keys.text("components[].name", rules(), "Name of the component.");
  keys.quantity("components[].weight", units::molarMass, rules().above(0), "Mass of a mole of its units.");
  keys.text("components[].elements", rules().list(), "Elements that a unit is made of.");
  keys.number("components[].atoms", rules().list().above(0), "Atoms in a unit, a number for each element.");
  keys.text("precursor", &SiteReactions::precursor, rules().required(),
            "Species of the gas that particles are made of and grow by.");
  keys.text("product", &SiteReactions::product, rules().required(), "Species that reactions give back to the gas.");
  keys.quantity("molecule_mass", units::mass, &SiteReactions::moleculeMass, rules().required().above(0),
                "Mass of a molecule of the precursor as it collides.");
  keys.quantity("molecule_diameter", units::length, &SiteReactions::moleculeDiameter, rules().required().above(0),
                "Diameter of a molecule of the precursor as it collides.");
  keys.number("nucleus", rules().list().atLeast(0), "Units of each component in a new particle.");
  keys.number("nucleus_products", &SiteReactions::nucleusProducts, rules().byDefault("1").atLeast(0),
              "Molecules of the product that two molecules of the precursor give back as they become a new particle.");
  keys.text("site", rules(), "Component whose units are the sites that react.");
  keys.text("bridge", rules(),
            "Component of which two sites become one unit, with a molecule of the product, as a particle sinters or "
            "reacts within.");
  keys.number("growth", rules().list(), "Units of each component that a particle gains as a molecule reacts with it.");
  keys.number("growth_products", &SiteReactions::growthProducts, rules().byDefault("1").atLeast(0),
              "Molecules of the product that this gives back.");
  keys.number("growth_power", &SiteReactions::power, rules().byDefault("0"),
              "Power n of the temperature in the rate constant growth_rate T^n exp(-growth_energy/(R T)).");
  return keys;
}

DeckKeys<SinteringLaw> sinteringKeys() {
  DeckKeys<SinteringLaw> keys("particles.sintering");
  keys.section(Presence::defaulted, "How primaries that touch become one.", {ofEqualWeights()});
  addSinteringLawKeys(keys.schema(), "particles.sintering");
  keys.choice(
      "size", &SinteringLaw::size,
      {{"smaller", SinteringLaw::Size::smaller}, {"volume_to_surface", SinteringLaw::Size::volumeToSurface}},
      rules().byDefault("smaller").onlyWith(ofPrimaries()),
      "The size d in the law: that of the smaller of two neighbours (Shekar et al. 2011), or 6 V/S of what sinters.");
  keys.choice("between", &SinteringLaw::between,
              {{"neighbours", SinteringLaw::Between::neighbours}, {"parts", SinteringLaw::Between::parts}},
              rules().byDefault("neighbours").onlyWith(ofPrimaries()),
              "What sinters: pairs of neighbours (Shekar et al. 2011, eq. 40); or the two parts of an aggregate that a "
              "collision joined, with the whole volume and surface of both, as the program MOpS does.");
  keys.choice("inner_parts", &SinteringLaw::innerSpheres, {{"sphere", true}, {"nothing", false}},
              rules().byDefault("sphere").onlyWith(ofPrimaries()),
              "What the surface of parts within an aggregate goes towards where parts sinter: that of the sphere of "
              "their volume; or nothing, as the program MOpS computes it.");
  return keys;
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
  SiteReactions r = tableKeys().read(deck);
  r.nucleus = readUnits(deck, ownTable + "nucleus", count);
  r.site = readComponent(deck, ownTable + "site", m.components);
  r.bridge = readComponent(deck, ownTable + "bridge", m.components);
  r.growth = readUnits(deck, ownTable + "growth", count);
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
  schema.add(tableKeys().schema());
  schema.add(sinteringKeys().schema());
}

SinteringLaw readSintering(const Deck& deck, SinteringLaw law) {
  const std::string s = "particles.sintering.";
  law = readSinteringLaw(deck, "particles.sintering", law);
  sinteringKeys().read(deck, law, "particles.sintering");
  if (deck.has(s + "size")) {
    if (!law.innerSpheres && law.between == SinteringLaw::Between::neighbours)
      throw deck.error(s + "inner_parts", "only where 'between' is 'parts' do parts within an aggregate sinter");
    if (law.between == SinteringLaw::Between::parts && law.size == SinteringLaw::Size::smaller)
      throw deck.error(s + "size", "parts of an aggregate sinter by 'volume_to_surface'");
  }
  requirePrefactor(deck, "particles.sintering", law);
  if (const std::string key = s + "tolerance"; !law.active() && deck.isGiven(key))
    throw deck.error(key, "nothing sinters without 'mechanism'; give one, or leave this out");
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
