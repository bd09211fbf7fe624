// Decks with the sections `soot`, `stochastic` and `particles` of former versions are read as those of the one section.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "app/shell/problem.hpp"
#include "core/errors.hpp"
#include "core/modules.hpp"
#include "io/deck.hpp"
#include "tests/every_module.hpp"
#include "tests/messages.hpp"

namespace lampblack::app::former_particles {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string reactor = "problem: reactor\nmechanism: gas.yaml\nreactor: {type: constant_pressure}\n",
                  along = "problem: prescribed_gas\nmechanism: gas.yaml\ngas: {file: gas.csv}\n",
                  flame =
                      "problem: flame1d\nmechanism: gas.yaml\nflame: {type: burner}\n"
                      "inlet: {temperature: 300 K, velocity: 1 m/s, composition: 'N2: 1'}\n",
                  flow =
                      "problem: flow\nmechanism: gas.yaml\n"
                      "mesh: {r: [{to: 1 mm, cells: 2}], z: [{to: 1 mm, cells: 2}]}\n"
                      "boundaries: {low: {type: outlet, side: z-min}}\n"
                      "initial: {layer: none, composition: 'N2: 1'}\ntime: {end: 1 s}\n";

Deck deckOf(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return Deck::parse(text, "deck.yaml", overrides, deckKinds());
}

std::string refusalOf(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return test::messageOf<InputError>([&] { (void)deckOf(text, overrides); });
}

struct Sections {
  std::string problem, former, present;
  std::size_t notes;
};

// JSON of values, without the order in which the deck has its keys.
void expectSame(const Deck& one, const Deck& other) {
  const auto lines = [](const Deck& deck) {
    std::vector<std::string> all;
    std::string line;
    for (std::istringstream text(deck.resolved()); std::getline(text, line);) all.push_back(line);
    std::ranges::sort(all);
    return all;
  };
  EXPECT_EQ(lines(one), lines(other));
}

class FormerParticleSections : public testing::TestWithParam<Sections> {};

TEST_P(FormerParticleSections, AreReadAsTheOneSection) {
  const Sections& sections = GetParam();
  const Deck former = deckOf(sections.problem + sections.former),
             present = deckOf(sections.problem + "particles: {" + sections.present + "}\n");
  expectSame(former, present);
  EXPECT_THAT(present.notes(), IsEmpty());
  EXPECT_EQ(former.notes().size(), sections.notes);
  for (const std::string& note : former.notes()) EXPECT_THAT(note, HasSubstr("since version 0.2; write"));
  EXPECT_THAT(deckOf(former.resolved()).notes(), IsEmpty());
  expectSame(deckOf(former.resolved()), former);
}

INSTANTIATE_TEST_SUITE_P(
    Decks, FormerParticleSections,
    testing::Values(
        Sections{reactor, "soot:\n", "description: two_equation_dimer", 1},
        Sections{reactor, "soot: {model: two_equation}\n", "description: two_equation_dimer", 2},
        Sections{reactor, "soot: {model: hmom, pah: [A3], hmom: {fractal_dimension: 2}, growth: false}\n",
                 "description: hmom, pah: [A3], hmom: {fractal_dimension: 2}, growth: false", 1},
        Sections{reactor, "soot: {model: none, moments: 5}\n", "description: none, moments: 5", 1},
        Sections{reactor, "soot: {pah: [A4], model: none}\nstochastic: {particles: 50, growth: events, seed: 3}\n",
                 "description: ensemble, pah: [A4], number: 50, growth_by: events, seed: 3", 3},
        Sections{reactor, "soot: {density: 1 g/cm^3}\nstochastic: {shape: surface_volume, fractal_dimension: 2}\n",
                 "description: ensemble, density: 1 g/cm^3, shape: surface_volume, fractal_dimension: 2", 2},
        Sections{reactor, "particles: {number: 64, inception: free_molecular, enhancement: 2, coagulation: false}\n",
                 "material: silica, description: trees, number: 64, inception_kernel: free_molecular, van_der_waals: "
                 "2, coagulation: false",
                 2},
        Sections{reactor, "particles:\n", "material: silica, description: trees", 1},
        Sections{reactor, "particles: {shape: trees, sintering: {size: volume_to_surface}}\n",
                 "material: silica, description: trees, sintering: {size: volume_to_surface}", 1},
        Sections{reactor, "particles: {shape: surface_volume, kernel: continuum}\n",
                 "material: silica, description: ensemble, shape: surface_volume, kernel: continuum", 1},
        Sections{reactor, "soot: {inception: false, slip: air}\nparticles: {material: soot, repeats: 3}\n",
                 "description: trees, inception: false, slip: air, repeats: 3, material: soot", 2},
        Sections{along, "soot: {model: momic, moments: 5}\n", "description: momic, moments: 5", 1},
        Sections{along, "stochastic: {method: swa}\nsoot: {alpha_table: [{temperature: 1500 K, alpha: 1}]}\n",
                 "description: ensemble, method: swa, alpha_table: [{temperature: 1500 K, alpha: 1}]", 2},
        Sections{along, "particles: {material: silica, tables_at: [1 s]}\n",
                 "material: silica, description: trees, tables_at: [1 s]", 1},
        Sections{flame, "soot: {model: sectional, sectional: {sections: 20}}\nstochastic: {number: 50}\n",
                 "description: ensemble, carried: sectional, sectional: {sections: 20}, number: 50", 2},
        Sections{flame, "soot: {pah: [A2]}\nstochastic: {coupling: two_way}\n",
                 "description: ensemble, carried: two_equation_dimer, pah: [A2], coupling: two_way", 2},
        Sections{flame, "soot: {model: none}\nparticles: {material: soot}\nstochastic: {heights: [1 mm]}\n",
                 "description: trees, carried: none, heights: [1 mm], material: soot", 3},
        Sections{flame, "particles: {material: silica}\nstochastic: {start: 1 mm}\n",
                 "description: trees, start: 1 mm, material: silica", 2},
        Sections{flow, "soot: {initial: {distribution: none}}\n",
                 "description: two_equation_dimer, initial: {distribution: none}", 1},
        Sections{flow,
                 "soot: {pah: [A2]}\nstochastic: {exchange: one_way, hold_gas: 1 ms, statistics: {start: 1 ms}, "
                 "regions: {a: {from: [0, 0], to: [1, 1]}}}\n",
                 "description: ensemble, pah: [A2], exchange: one_way, frozen_gas: 1 ms, statistics: {start: 1 ms}, "
                 "regions: {a: {from: [0, 0], to: [1, 1]}}",
                 3},
        Sections{flow, "soot: {diffusion: false}\nparticles: {material: soot, number: 60}\nstochastic:\n",
                 "description: trees, diffusion: false, number: 60, material: soot", 3}));

TEST(FormerParticlesInSettings, MeanWhatTheyMeant) {
  const std::string model = "particles: {description: two_equation_dimer, pah: [A3]}\n";
  const auto same = [](const std::string& text, const std::vector<std::string>& former,
                       const std::vector<std::string>& present) {
    expectSame(deckOf(text, former), deckOf(text, present));
  };
  same(reactor + model, {"soot.model=hmom", "soot.pah=[A4]"}, {"particles.description=hmom", "particles.pah=[A4]"});
  same(reactor + model, {"soot.model=none"}, {"particles.description=none"});
  // The section `stochastic` asked for an ensemble: beside the model of a flame, in place of another.
  same(reactor + model, {"soot.model=none", "stochastic.repeats=4"},
       {"particles.description=ensemble", "particles.repeats=4"});
  same(flow + model, {"stochastic={number: 40}"}, {"particles.description=ensemble", "particles.number=40"});
  same(flame + model, {"stochastic.number=40"},
       {"particles.description=ensemble", "particles.carried=two_equation_dimer", "particles.number=40"});
  const std::string ensemble = "particles: {description: ensemble, number: 50, statistics: {start: 1 ms}}\n";
  same(flow + ensemble, {"stochastic.number=60", "stochastic.statistics.block=2 ms", "soot.alpha=1"},
       {"particles.number=60", "particles.statistics.block=2 ms", "particles.alpha=1"});
  same(flame + "particles: {description: trees}\n", {"soot.model=hmom"}, {"particles.carried=hmom"});
  // Of a deck with the former sections.
  const std::string former = "soot: {model: hmom}\n";
  same(reactor + former, {"soot.model=momic"}, {"particles.description=momic"});
  same(reactor + former, {"particles.description=none"}, {"soot.model=none"});
  same(reactor + former, {"soot.model=none", "stochastic.growth=events"},
       {"soot.model=none", "stochastic={growth: events}"});
}

TEST(FormerParticlesInSettings, HoldOverTheNameThatTheDeckHas) {
  const std::string text = reactor + "particles: {description: ensemble, number: 50}\n";
  EXPECT_EQ(deckOf(text, {"stochastic.number=60"}).integer("particles.number"), 60);
  EXPECT_EQ(deckOf(text, {"stochastic.number=60", "particles.number=70"}).integer("particles.number"), 70);
  EXPECT_EQ(deckOf(text, {"particles.number=70", "stochastic.number=60"}).integer("particles.number"), 60);
  EXPECT_THAT(
      deckOf(text, {"stochastic.number=60"}).notes(),
      testing::ElementsAre(HasSubstr("--set stochastic.number: the keys of 'stochastic' stand in 'particles'")));
}

TEST(FormerParticles, BesideThePresentOnesAreAnError) {
  const std::string present = "particles: {description: ensemble, number: 50}\n";
  for (const char* section : {"soot", "stochastic"})
    EXPECT_THAT(refusalOf(reactor + section + ": {}\n" + present),
                HasSubstr(std::string(section) + ": the section 'particles' has taken its place"));
  EXPECT_THAT(refusalOf(flow + "soot: {model: hmom}\nstochastic: {}\n"),
              HasSubstr("soot.model: an ensemble or trees take the place of a model"));
  EXPECT_THAT(refusalOf(flow + present, {"soot.model=hmom"}), HasSubstr("take the place of a model"));
  EXPECT_THAT(refusalOf(reactor + "particles: {description: hmom}\n", {"stochastic={}", "soot.model=momic"}),
              HasSubstr("an ensemble takes the place of the model momic"));
  EXPECT_THAT(refusalOf(reactor + "soot: {pah: [A2]}\nparticles: {material: silica}\n"),
              HasSubstr("soot: the particles of the deck are of silica"));
  EXPECT_THAT(refusalOf(reactor + "soot: {density: 1}\nparticles: {material: soot, density: 2}\n"),
              HasSubstr("soot.density: this is 'particles.density' now, which is given too"));
}

TEST(FormerParticles, MistakesAreFoundAndTellWhereTheKeysAre) {
  EXPECT_THAT(refusalOf(reactor + "soot: {pahh: [A2]}\n"), HasSubstr("unknown key 'pahh'; did you mean 'pah'?"));
  EXPECT_THAT(
      refusalOf(reactor + "soot: {pahh: [A2]}\n"),
      HasSubstr("note: deck.yaml:4: the keys of 'soot' stand in 'particles' since version 0.2; write them there, "
                "'description: two_equation_dimer', as version 0.3 does not read the old one"));
  EXPECT_THAT(refusalOf(reactor + "soot: [A2]\n"), HasSubstr("soot: expected a map of keys, found a list of 1"));
  EXPECT_THAT(refusalOf(reactor + "stochastic: {method: slow}\n"), HasSubstr("found 'slow'"));
  EXPECT_THAT(refusalOf(reactor + "soot: {model: hmmo}\n"), HasSubstr("did you mean 'hmom'?"));
  EXPECT_THAT(refusalOf(reactor + "particles: {material: soot}\n"),
              HasSubstr("particles.description: this key is missing"));
  EXPECT_THAT(refusalOf(reactor + "particles: 50\n"),
              AllOf(HasSubstr("particles: expected a map of keys, found '50'"), Not(HasSubstr("note:"))));
}

}  // namespace
}  // namespace lampblack::app::former_particles
