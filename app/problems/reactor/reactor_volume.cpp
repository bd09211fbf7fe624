// The given volume of a closed reactor: a table, a formula, a piston, or a pressure that rises by itself.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "app/deck/gas_input.hpp"
#include "app/deck/two_columns.hpp"
#include "app/problems/reactor/reactor_case_parts.hpp"
#include "core/errors.hpp"
#include "io/deck_keys.hpp"
#include "io/formula.hpp"

namespace lampblack::app::reactorcase {
namespace {

const std::string lawKey = "volume.law";

VolumeLaw tableLaw(const Deck& deck) {
  const bool listed = deck.has("volume.time") || deck.has("volume.volume");
  if (listed == deck.has("volume.file")) throw deck.error("volume", "expected either 'time' and 'volume' or 'file'");
  return deck.at(listed ? "volume" : "volume.file", [&] {
    if (listed) {
      if (!deck.has("volume.time") || !deck.has("volume.volume"))
        throw InputError("'time' and 'volume' belong together: give both or neither");
      return VolumeLaw::table(deck.quantities("volume.time"), deck.quantities("volume.volume"));
    }
    TwoColumns columns =
        readTwoColumns(deck.resolvePath(deck.string("volume.file")), units::time, units::volume,
                       "time [ms],volume [cm^3]", [](double volume) {
                         if (!(volume > 0))
                           throw InputError(fmt::format("expected volumes above zero, found {:g}", volume));
                       });
    return VolumeLaw::table(std::move(columns.points), std::move(columns.values));
  });
}

VolumeLaw formulaLaw(const Deck& deck, double end) {
  return deck.at("volume.formula", [&] {
    const Formula formula(deck.string("volume.formula"), {"t"});
    const auto volume = [formula](double t) { return formula(std::array{t}); };
    for (int i = -1; i <= 1001; ++i)  // a little beyond, for differences
      if (const double t = end * i / 1000; !(volume(t) > 0))
        throw InputError(
            fmt::format("the volume has to be above zero until time.end; it is {:g} at t = {:g} s", volume(t), t));
    return VolumeLaw::formula(volume, end);
  });
}

VolumeLaw pistonLaw(const Deck& deck, ClosedKind& closed) {
  SliderCrank crank{neededQuantity(deck, "volume", "bore", "a piston"),
                    neededQuantity(deck, "volume", "stroke", "a piston"),
                    neededQuantity(deck, "volume", "rod", "a piston"), 0};
  if (!deck.has("volume.compression_ratio"))
    throw deck.error("volume", "a piston needs 'compression_ratio', largest over smallest volume");
  crank.compressionRatio = deck.number("volume.compression_ratio");
  if (!(crank.rod > 0.5 * crank.stroke))
    throw deck.error("volume.rod",
                     fmt::format("the rod has to be longer than half the stroke, {:g} m", 0.5 * crank.stroke));
  closed.startAngle = deck.quantity("volume.start_angle");
  closed.angularSpeed = neededQuantity(deck, "volume", "speed", "a piston");
  return VolumeLaw::piston(crank, *closed.startAngle, *closed.angularSpeed);
}

}  // namespace

void addVolumeKeys(DeckSchema& schema) {
  SectionKeys keys("volume");
  const std::string piston = "slider_crank";
  keys.section(Presence::optional, "The volume of a closed reactor in time, whose gas works on what moves.",
               {{"reactor.type", {"given_volume"}}});
  keys.choice("law", {"table", "formula", piston, "pressure_rise"}, rules(),
              "table: by points, of a rapid compression machine; formula: of the time; slider_crank: over a piston; "
              "pressure_rise: that of an isentrope whose pressure rises evenly, as behind the reflected shock of a "
              "shock tube.");
  keys.quantity("time", units::time, rules().list().optional().onlyWith(lawKey, {"table"}),
                "Times of the points, rising.");
  keys.quantity("volume", units::volume, rules().list().optional().onlyWith(lawKey, {"table"}),
                "Volumes at the points; their ratios count.");
  keys.text(
      "file", rules().optional().onlyWith(lawKey, {"table"}),
      "CSV file with the points, in place of lists, of two columns, time in s and volume in any unit; a first "
      "line of names, in a comment or not, may say other units, 'time [ms],volume [cm^3]'; other lines that begin "
      "with # are skipped. Relative to the deck. Between points a monotone cubic, constant beyond them.");
  keys.text("formula", rules().optional().onlyWith(lawKey, {"formula"}),
            "The volume as an expression of t in s, '1 - 0.9*min(t/0.03, 1)'; its ratios count.");
  keys.quantity("bore", units::length, rules().optional().above(0).onlyWith(lawKey, {piston}),
                "Diameter of the piston.");
  keys.quantity("stroke", units::length, rules().optional().above(0).onlyWith(lawKey, {piston}),
                "Way of the piston, twice the radius of the crank.");
  keys.quantity("rod", units::length, rules().optional().above(0).onlyWith(lawKey, {piston}),
                "Length of the connecting rod.");
  keys.number("compression_ratio", rules().optional().above(1).onlyWith(lawKey, {piston}),
              "Largest over smallest volume.");
  keys.quantity("speed", units::angularVelocity, rules().optional().above(0).onlyWith(lawKey, {piston}),
                "Speed of the crank.");
  keys.quantity("start_angle", units::angle, rules().byDefault("-180 deg").onlyWith(lawKey, {piston}),
                "Angle of the crank at time zero, after top dead centre: negative before it.");
  keys.quantity("pressure_rise", units::frequency, rules().optional().onlyWith(lawKey, {"pressure_rise"}),
                "Rise of the pressure of the unreacted gas over its first value, (dp/dt)/p_0: '3 %/ms'.");
  schema.add(keys.schema());
}

void readVolume(const Deck& deck, const ReactorCase& reactorCase, ClosedKind& closed) {
  if (!deck.has("volume")) throw deck.error("reactor.type", "'given_volume' needs the section 'volume'");
  const std::string law = deck.choice(lawKey);
  if (law == "table") {
    closed.volume = tableLaw(deck);
  } else if (law == "formula") {
    if (!deck.has("volume.formula")) throw deck.error("volume", "the law 'formula' needs the key 'formula'");
    closed.volume = formulaLaw(deck, closed.duration);
  } else if (law == "slider_crank") {
    closed.volume = pistonLaw(deck, closed);
  } else {
    const double rate = neededQuantity(deck, "volume", "pressure_rise", "a rise of pressure");
    const GasState& gas = closed.initial;
    closed.volume = deck.at("volume.pressure_rise", [&] {
      return VolumeLaw::pressureRise(*reactorCase.mechanism, gas.temperature, gas.Y, rate, closed.duration);
    });
  }
  if (deck.choice("ignition.from") == "start") return;
  if (law == "pressure_rise") {
    if (deck.isGiven("ignition.from"))
      throw deck.error("ignition.from", "a rise of pressure has no end of compression; count delays from the start");
    return;
  }
  const double compressed = closed.volume->smallestAt(closed.duration);
  // A volume that still falls at the end of the run, or never does, has no end of compression.
  if (compressed < closed.duration)
    closed.ignitionFrom = compressed;
  else if (deck.isGiven("ignition.from"))
    throw deck.error(
        "ignition.from",
        "the volume is smallest at the end of the run, time.end; give a later end, or count delays from the start");
}

}  // namespace lampblack::app::reactorcase
