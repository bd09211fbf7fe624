#include "app/problems/flow/initial_flow.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "app/problems/flow/box_places.hpp"
#include "app/problems/flow/flow_case.hpp"
#include "core/errors.hpp"
#include "core/text_file.hpp"
#include "flow/models/carried_operator.hpp"
#include "io/csv.hpp"
#include "io/deck_keys.hpp"
#include "io/grid_table.hpp"
#include "io/hdf5_reader.hpp"
#include "io/table_column.hpp"

namespace lampblack::app::flowcase {
namespace {

const std::string section = "initial.flow", swirl = "swirl_velocity";
constexpr double mostWithoutPlace = 0.02;  // of the mass of a cell, in species that the mechanism lacks

// The step that the deck asks for: the last, or that at the time next to `time`.
std::string stepOf(const Hdf5Reader& results, std::optional<double> time) {
  const std::vector<std::string> steps = results.names("/steps");
  if (steps.empty()) throw InputError(fmt::format("{} holds no fields of a flow", results.name()));
  const auto distance = [&](const std::string& step) {
    return std::abs(results.numberAttribute("/steps/" + step, "time") - *time);
  };
  return "/steps/" + (time ? *std::ranges::min_element(steps, {}, distance) : steps.back());
}

// Values of all cells of one component of a vector with `components`.
std::vector<double> component(const std::vector<double>& values, std::size_t components, std::size_t which) {
  std::vector<double> of;
  for (std::size_t i = which; i < values.size(); i += components) of.push_back(values[i]);
  return of;
}

void requireSameGeometry(const Hdf5Reader& results, const Deck& earlier, const MeshSpec& mesh) {
  if (earlier.has("mesh.file"))
    throw InputError(fmt::format("{} is of a mesh with 'mesh.file'; expected a plane box", results.name()));
  if (earlier.choice("mesh.geometry") == "space")
    throw InputError(fmt::format("{} is three-dimensional; expected a plane box", results.name()));
  const bool wasBent = earlier.has("mesh.floor") || earlier.has("mesh.ceiling"), isBent = static_cast<bool>(mesh.map);
  if (wasBent != isBent)
    throw InputError(fmt::format("{} is of a box {} a floor or a ceiling of its own; expected one {}", results.name(),
                                 wasBent ? "with" : "without", isBent ? "as this mesh has" : "without, as this mesh"));
  const Geometry geometry = mesh.geometry;
  const bool wasAxisymmetric = earlier.choice("mesh.geometry") == "axisymmetric";
  if (wasAxisymmetric != (geometry == Geometry::Axisymmetric))
    throw InputError(fmt::format("{} is of {} geometry; expected that of this mesh", results.name(),
                                 wasAxisymmetric ? "axisymmetric" : "planar"));
}

// Of two meshes of one bent box floors and ceilings meet but for what is bent between the columns of the coarser: a
// share of what they rise and fall by.
constexpr double mostApart = 0.1;

// The places of the earlier run's cells, and, of a bent box, how those of this mesh are told on it.
struct EarlierPlaces {
  std::vector<std::vector<double>> cells;  // of each coordinate
  std::optional<BoxPlaces> box;            // of this mesh, where it is bent
};

EarlierPlaces placesOf(const Hdf5Reader& results, const MeshSpec& mesh, EarlierDeck deck) {
  const std::vector<double> centres = results.numbers("/mesh/cellCentre");
  EarlierPlaces places{.cells = {component(centres, 3, 0), component(centres, 3, 1)}, .box = std::nullopt};
  if (!mesh.map) return places;
  const BoxPlaces earlier(results.numbers("/mesh/vertices"));
  places.box.emplace(mesh);
  const double apart = std::max(earlier.apart(*places.box), places.box->apart(earlier));
  const double most = mostApart * places.box->rise();
  if (deck == EarlierDeck::AnyOther && apart > most)
    throw InputError(
        fmt::format("{} has another floor or ceiling than this mesh: {:.3g} m apart, expected {:.3g} m at "
                    "most",
                    results.name(), apart, most));
  for (std::size_t c = 0; c < places.cells[0].size(); ++c) {
    const auto [along, share] = earlier.middle(places.cells[0][c], places.cells[1][c]);
    places.cells[0][c] = along;
    places.cells[1][c] = share;
  }
  return places;
}

// Rounding of a length apart; of a bent box along its columns.
void requireCover(const Hdf5Reader& results, const MeshSpec& mesh) {
  const std::vector<double> vertices = results.numbers("/mesh/vertices");
  const AxisNames names = axisNames(mesh.geometry, mesh.dimension());
  const std::size_t axes = mesh.map ? 1 : 2;
  for (std::size_t axis = 0; axis < axes; ++axis) {
    const std::vector<double> of = component(vertices, 3, axis);
    const auto [first, last] = std::ranges::minmax(of);
    const double slack = 1e-9 * (last - first);
    if (mesh.vertices[axis].front() < first - slack || mesh.vertices[axis].back() > last + slack)
      throw InputError(fmt::format("{} reaches from {} = {:g} to {:g} m; this mesh goes from {:g} to {:g} m",
                                   results.name(), names[axis], first, last, mesh.vertices[axis].front(),
                                   mesh.vertices[axis].back()));
  }
}

// The columns of all species of the earlier mechanism, in its order.
std::vector<std::vector<double>> earlierMoleFractions(const Hdf5Reader& results, const std::string& step,
                                                      const std::vector<std::string>& species) {
  std::vector<std::vector<double>> X;
  for (const std::string& one : species) {
    const std::string name = "X_" + one;
    if (!results.has(step + "/" + name))
      throw InputError(
          fmt::format("{} has no '{}'; expected a run with 'output: {{species: [all]}}'", results.name(), name));
    X.push_back(results.numbers(step + "/" + name));
  }
  return X;
}

// What the mechanism has no place for: its largest mass fraction in a cell, together and by species, the largest first.
struct MassWithoutPlace {
  double largest = 0.0;
  std::vector<std::pair<std::string, double>> species;
};

MassWithoutPlace massWithoutPlace(const std::vector<std::string>& species, const std::vector<double>& molarMass,
                                  const std::vector<std::vector<double>>& X, const Mechanism& mechanism) {
  std::vector<double> all(X.front().size(), 0.0), without(all.size(), 0.0);  // kg/mol, of each cell
  for (std::size_t k = 0; k < species.size(); ++k)
    for (std::size_t c = 0; c < all.size(); ++c) all[c] += X[k][c] * molarMass[k];
  MassWithoutPlace mass;
  for (std::size_t k = 0; k < species.size(); ++k) {
    if (mechanism.findSpecies(species[k])) continue;
    double largest = 0.0;
    for (std::size_t c = 0; c < all.size(); ++c) {
      without[c] += X[k][c] * molarMass[k];
      largest = std::max(largest, X[k][c] * molarMass[k] / all[c]);
    }
    mass.species.emplace_back(species[k], largest);
  }
  for (std::size_t c = 0; c < all.size(); ++c) mass.largest = std::max(mass.largest, without[c] / all[c]);
  std::ranges::sort(mass.species, std::ranges::greater{}, &std::pair<std::string, double>::second);
  return mass;
}

// Mole fractions of the mechanism's species in all cells; what has no place is left out and the rest scaled to one.
// InputError where that is much; else the user is told.
std::vector<std::vector<double>> readMoleFractions(const Hdf5Reader& results, const std::string& step,
                                                   FlowCase& flowCase) {
  const Mechanism& mechanism = *flowCase.mechanism;
  const std::vector<std::string> species = results.texts("/species/name");
  std::vector<std::vector<double>> earlier = earlierMoleFractions(results, step, species);
  const MassWithoutPlace mass = massWithoutPlace(species, results.numbers("/species/molar_mass"), earlier, mechanism);
  std::vector<std::vector<double>> X(mechanism.numSpecies(), std::vector<double>(earlier.front().size(), 0.0));
  for (std::size_t k = 0; k < species.size(); ++k)
    if (const auto own = mechanism.findSpecies(species[k])) X[*own] = std::move(earlier[k]);
  if (mass.species.empty()) return X;
  constexpr std::size_t named = 3;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(named, mass.species.size()); ++i)
    names.push_back(fmt::format("{} (up to {:.2g})", mass.species[i].first, mass.species[i].second));
  if (mass.species.size() > named) names.push_back(fmt::format("{} others", mass.species.size() - named));
  const std::string what =
      fmt::format("{} has species that the mechanism lacks, up to {:.2g} of the mass of a cell: {}", results.name(),
                  mass.largest, fmt::join(names, ", "));
  if (mass.largest > mostWithoutPlace)
    throw InputError(fmt::format("{}; expected {:g} at most", what, mostWithoutPlace));
  flowCase.notes.push_back(what + "; they are left out and the others scaled to sum one");
  for (std::size_t c = 0; c < X.front().size(); ++c) {
    double sum = 0.0;
    for (const std::vector<double>& of : X) sum += of[c];
    for (std::vector<double>& of : X) of[c] /= sum;
  }
  return X;
}

// Whether all scalars of this run's model stand in the earlier one's results with the same meaning, sections of the
// same sizes among them: some of them alone are no particles. Else the user is told, as where this run has no model.
bool hasScalars(const Hdf5Reader& results, const std::string& step, const std::vector<CarriedScalar>& scalars,
                FlowCase& flowCase) {
  const auto isMissing = [&](const CarriedScalar& scalar) {
    const std::string field = step + "/" + scalar.name;
    return !results.has(field) || results.textAttribute(field, "description") != scalar.description;
  };
  const auto missing = std::ranges::find_if(scalars, isMissing);
  if (!scalars.empty() && missing == scalars.end()) return true;
  const bool hadParticles = std::ranges::any_of(
      results.names(step), [](const std::string& name) { return name.ends_with("_volume_fraction"); });
  if (!scalars.empty())
    flowCase.notes.push_back(fmt::format("{} has no '{}' ({}): its particles are left out of the start", results.name(),
                                         missing->name, missing->description));
  else if (hadParticles)
    flowCase.notes.push_back(fmt::format("the particles of {} are left out of the start: {}", results.name(),
                                         flowCase.ensembles ? "ensembles begin anew" : "this run has none"));
  return false;
}

// Names of the fields that a start of this run's turbulence model takes; empty where there is no model, or where the
// earlier run has not all of them, of which the user is told.
std::vector<std::string> turbulenceFields(const Hdf5Reader& results, const std::string& step, FlowCase& flowCase) {
  const TurbulenceModel* model = flowCase.turbulence.model.get();
  if (model == nullptr) return {};
  std::vector<std::string> names;
  for (const TurbulenceModel::Variable& variable : model->variables()) names.push_back(variable.name);
  names.emplace_back("eddy_viscosity");
  for (const std::string& name : names) {
    if (results.has(step + "/" + name)) continue;
    flowCase.notes.push_back(fmt::format("{} has no '{}': turbulence starts as the deck says", results.name(), name));
    return {};
  }
  return names;
}

std::vector<CarriedScalar> carriedScalars(const FlowCase& flowCase) {
  if (!flowCase.carried) return {};
  return CarriedOperator::blockOf(*flowCase.carried, {}).scalars;
}

bool isClosed(const FlowCase& flowCase) {
  return std::ranges::none_of(flowCase.boundaries, [](const auto& b) { return b.kind == BoundaryKind::Outlet; });
}

// A column of the history, which stands in the results of a run that went to its end, and always in a table beside
// them.
std::vector<double> historyColumn(const Hdf5Reader& results, const std::string& name) {
  if (results.has("/history/" + name)) return results.numbers("/history/" + name);
  const auto file = std::filesystem::path(results.name()).parent_path() / "history.csv";
  const TextTable table = readCsv(readTextFile(file, "the history of a run"));
  const auto column =
      std::ranges::find_if(table.columns, [&](const std::string& text) { return text.starts_with(name + " ["); });
  if (column == table.columns.end() || table.rows.empty())
    throw InputError(fmt::format("{} has no '{}', which tells the pressure of a closed vessel", file.string(), name));
  std::vector<double> values;
  const TableColumn reader(name, "", units::dimensionless);  // the table is in SI
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    values.push_back(
        reader.read(table.rows[row][static_cast<std::size_t>(column - table.columns.begin())], table.lines[row]));
  return values;
}

// Pa, by the history of the earlier run at the time of the step.
double thermodynamicPressure(const Hdf5Reader& results, const std::string& step) {
  const std::vector<double> times = historyColumn(results, "time");
  const double time = results.numberAttribute(step, "time");
  const auto row = std::ranges::min_element(times, {}, [&](double t) { return std::abs(t - time); });
  return historyColumn(results, "thermodynamic_pressure").at(static_cast<std::size_t>(row - times.begin()));
}

}  // namespace

void addInitialFlowKeys(DeckSchema& schema) {
  SectionKeys keys(section);
  keys.section(Presence::optional,
               "An earlier run of problem flow to start from, on a mesh of its own: gas, velocity, and soot and "
               "turbulence where their models are the earlier run's; 'layer' is none. The mechanism and the model may "
               "be others: species go by name. Linear between the earlier run's cells, beside solids as in the cell "
               "next to them. A closed vessel takes the earlier run's thermodynamic pressure in place of 'pressure'.",
               {{"initial.layer", {"none"}}});
  keys.text("results", rules(),
            "The earlier run's folder, or its results.h5, relative to the deck; of a run that was stopped the folder "
            "or results.h5.part. It holds all species of its mechanism ('output: {species: [all]}').");
  keys.quantity("time", units::time, rules().optional(),
                "Time of the earlier run; the output next to it is taken. Absent: the last output.");
  keys.boolean(
      "light", rules().byDefault("false"),
      "true: what is mixed in the earlier run burns at the start: each cell whose mixture burns to a gas at least 500 "
      "K hotter becomes that gas, of 2200 K at most. For a flame behind a body, in gas that has found its way there.");
  schema.add(keys.schema());
}

InitialFields readEarlierFlow(const std::filesystem::path& file, std::optional<double> time, FlowCase& flowCase,
                              EarlierDeck earlierDeck) {
  if (flowCase.meshFile || flowCase.dimension != 2)
    throw InputError("an earlier run is laid over plane boxes only, bent or not");
  const Hdf5Reader results(file);
  const Deck earlier = Deck::parse(results.textAttribute("/", "deck"), results.name(), {}, flowSchema());
  requireSameGeometry(results, earlier, flowCase.mesh);
  requireCover(results, flowCase.mesh);
  const std::string step = stepOf(results, time);
  InitialFields fields;
  if (isClosed(flowCase)) fields.thermodynamicPressure = thermodynamicPressure(results, step);
  GridTable::Numbers numbers;
  numbers.columns = {results.numbers(step + "/temperature")};
  for (std::vector<double>& of : readMoleFractions(results, step, flowCase)) numbers.columns.push_back(std::move(of));
  std::vector<CarriedScalar> scalars = carriedScalars(flowCase);
  if (!hasScalars(results, step, scalars, flowCase)) scalars.clear();
  for (const CarriedScalar& scalar : scalars) numbers.columns.push_back(results.numbers(step + "/" + scalar.name));
  const std::vector<std::string> turbulence = turbulenceFields(results, step, flowCase);
  for (const std::string& name : turbulence) numbers.columns.push_back(results.numbers(step + "/" + name));
  const bool swirls = results.has(step + "/" + swirl);
  if (swirls) numbers.columns.push_back(results.numbers(step + "/" + swirl));
  const std::vector<double> velocity = results.numbers(step + "/velocity");
  for (std::size_t axis = 0; axis < 2; ++axis) numbers.columns.push_back(component(velocity, 3, axis));
  EarlierPlaces places = placesOf(results, flowCase.mesh, earlierDeck);
  numbers.places = std::move(places.cells);
  numbers.names.resize(numbers.columns.size());
  fillHoles(numbers);
  const auto table = std::make_shared<GridTable>(
      std::vector<GridTable::Coordinate>{{"first", units::length}, {"second", units::length}}, numbers);
  std::size_t column = 0;
  const auto next = [&]() -> FieldFunction {
    return [table, at = column++, box = places.box](const Vector3& place, double) {
      return box ? table->value(at, box->of(place[0], place[1])) : table->value(at, place);
    };
  };
  fields.gas.temperature = next();
  for (std::size_t k = 0; k < flowCase.mechanism->numSpecies(); ++k)
    // Advection leaves some slightly below zero.
    fields.gas.moleFractions.emplace_back(
        k, [value = next()](const Vector3& place, double t) { return std::max(value(place, t), 0.0); });
  for (std::size_t s = 0; s < scalars.size(); ++s) fields.carried.push_back(next());
  for (std::size_t v = 0; v < turbulence.size(); ++v) fields.turbulence.push_back(next());
  if (swirls) fields.swirl = next();
  for (FieldFunction& velocityAlong : fields.velocity) velocityAlong = next();
  return fields;
}

InitialFields readInitialFlow(const Deck& deck, FlowCase& flowCase) {
  return deck.at(section + ".results", [&] {
    std::filesystem::path file = deck.resolvePath(deck.string(section + ".results"));
    if (std::filesystem::is_directory(file)) {
      // Of a run that did not reach its end there is the part that it wrote.
      const std::filesystem::path part = file / "results.h5.part";
      file /= "results.h5";
      if (!std::filesystem::exists(file) && std::filesystem::exists(part)) file = part;
    }
    InitialFields fields =
        readEarlierFlow(file, deck.optionalQuantity(section + ".time"), flowCase, EarlierDeck::AnyOther);
    fields.isLit = deck.boolean(section + ".light");
    return fields;
  });
}

}  // namespace lampblack::app::flowcase
