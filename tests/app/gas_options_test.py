"""The options of `lampblack gas`: ways to say the same, equilibria, and what is told when wrong.

Usage: gas_options_test.py EXECUTABLE RANKS MPIEXEC...
"""

import json
import pathlib
import re
import sys
import tempfile

import running

MECHANISMS = running.SOURCE / "cases/mechanisms"
METHANE = MECHANISMS / "methane_gri30_53.yaml"
HYDROGEN = MECHANISMS / "hydrogen_h2o2_10.yaml"
SILICA = MECHANISMS / "silica_teos_29.yaml"
AIR = "O2:1, N2:3.76"
FLAME = ("--T", "1400", "--p", "101325", "--X", "CH4:1, O2:2, N2:7.52")
# Cantera 3.2.0 (T_equil_HP of the reference tables).
FLAME_TEMPERATURE = 2697.883232506094

# What is wrong, the arguments, and words that the message has.
MISTAKES = [
    ("a mechanism by another's name", ("gri30.yaml", "--T", "300", "--X", "CH4:1"),
     ("none of that name is in", "; did you mean 'methane_gri30_53.yaml'?")),
    ("no composition", (HYDROGEN, "--T", "1500"), ("composition is missing", "--X", "--Y", "--phi")),
    ("two compositions", (HYDROGEN, "--T", "1500", "--X", AIR, "--Y", AIR), ("given twice",)),
    ("half a ratio", (HYDROGEN, "--T", "1500", "--fuel", "H2:1", "--phi", "1"), ("--oxidizer", "all three")),
    ("ratio below zero", (HYDROGEN, "--T", "1500", "--fuel", "H2:1", "--oxidizer", AIR, "--phi", "-1"),
     ("--phi", "at least 0", "-1")),
    ("fuel that does not burn", (HYDROGEN, "--T", "1500", "--fuel", "AR:1", "--oxidizer", AIR, "--phi", "1"),
     ("the fuel needs no oxygen",)),
    ("unknown species", (HYDROGEN, "--T", "1500", "--X", "H2:1, O22:1"), ("--X", "unknown species 'O22'", "'O2'")),
    ("composition without amounts", (HYDROGEN, "--T", "1500", "--X", "H2, O2"), ("--X", "expected ':'")),
    ("wrong unit", (HYDROGEN, "--T", "1500 Pa", "--X", AIR), ("--T", "expected a temperature", "a pressure")),
    ("cold", (HYDROGEN, "--T", "-5", "--X", AIR), ("--T", "temperature above zero", "'-5'")),
    ("colder than the data", (METHANE, "--T", "150", "--X", AIR), ("--T: expected a temperature from 200 to 6000 K", "150")),
    ("hotter than the data", (HYDROGEN, "--T", "9000", "--X", AIR), ("--T: expected a temperature from 200 to", "9000")),
    ("vacuum", (HYDROGEN, "--T", "300", "--p", "0", "--X", AIR), ("--p", "pressure above zero")),
    ("not a number", (HYDROGEN, "--T", "nan", "--X", AIR), ("--T",)),
    ("no temperature", (HYDROGEN, "--X", AIR), ("--T",)),
    ("no mechanism", ("nowhere.yaml", "--T", "300", "--X", AIR), ("nowhere.yaml", "there is no such file")),
    ("unknown transport model", (HYDROGEN, "--T", "300", "--X", AIR, "--transport", "multicomponents"),
     ("--transport", "did you mean 'multicomponent'")),
    ("unknown collision integrals", (HYDROGEN, "--T", "300", "--X", AIR, "--collision-integrals", "neufeld"),
     ("--collision-integrals", "monchick-mason", "wang")),
    ("no transport data for the model asked for", (SILICA, "--T", "300", "--X", "CO:1", "--transport",
                                                   "mixture-averaged"), ("has no transport data",)),
    ("YAML with CHEMKIN data", (HYDROGEN, "therm.dat", "--T", "300", "--X", AIR), ("is YAML", "therm.dat")),
    ("unknown phase", (HYDROGEN, "--phase", "liquid", "--T", "300", "--X", AIR),
     ("there is no phase 'liquid'", "(ideal-gas)")),
    ("phase of CHEMKIN", ("chem.inp", "--phase", "gas", "--T", "300", "--X", AIR), ("--phase", "YAML", "chem.inp")),
    ("two equilibria", (HYDROGEN, "--T", "300", "--X", AIR, "--hp", "--uv"), ("one equilibrium at a time",)),
]


# Thermodynamic data in fixed columns: 2.5 R for the atom, 3.5 R for the molecule.
def chemkin_species(name: str, atoms: str, numbers: list) -> str:
    head = f"{name:<18}{'':6}{atoms:<20}G{300:10.3f}{5000:10.3f}{1000:8.2f}"
    values = [*numbers, *numbers]
    lines = [f"{head:<79}1"]
    for row in range(3):
        text = "".join(f"{value:15.8E}" for value in values[5 * row:5 * row + 5])
        lines.append(f"{text:<79}{row + 2}")
    return "\n".join(lines) + "\n"


CHEMKIN = "ELEMENTS H END\nSPECIES H H2 END\nREACTIONS\n2H+M=H2+M 1.E18 -1. 0.\nEND\n"
CHEMKIN_THERMO = ("THERMO\n   300.000  1000.000  5000.000\n"
                  + chemkin_species("H", "H   1", [2.5, 0, 0, 0, 0, 25474, -0.45])
                  + chemkin_species("H2", "H   2", [3.5, 0, 0, 0, 0, -1000, -3.3]) + "END\n")


class Checker:
    def __init__(self, program: running.Program):
        self.program = program
        self.failures = 0

    def require(self, what: str, holds: bool, details: str = "") -> None:
        self.failures += not holds
        print(f"{'ok' if holds else 'FAILED':8}{what}{'' if holds else ': ' + details}")

    def gas(self, *arguments) -> dict:
        result = self.program("gas", *arguments, "--json")
        if result.code != 0:
            raise AssertionError(f"{arguments}: exit code {result.code}\n{result.err}")
        return json.loads(result.out)

    def close(self, what: str, value: float, expected: float, relative: float) -> None:
        self.require(what, abs(value / expected - 1) <= relative, f"{value}, expected {expected}")

    def same_gas(self, what: str, *arguments) -> None:
        """Arguments that describe stoichiometric methane/air at 1 bar and 1500 K."""
        if not hasattr(self, "plain"):
            self.plain = self.gas(METHANE, "--T", "1500", "--p", "1e5", "--X", "CH4:1, O2:2, N2:7.52")
        self.close(what, self.gas(METHANE, *arguments)["entropy_mass"], self.plain["entropy_mass"], 1e-14)


def spellings(check: Checker) -> None:
    check.same_gas("units", "--T", "1.5 kK", "--p", "1 bar", "--X", "CH4:1, O2:2, N2:7.52")
    check.same_gas("amounts of any sum", "--T", "1500", "--p", "1e5", "--X", "CH4=0.5 O2=1 N2=3.76")
    check.same_gas("equivalence ratio", "--T", "1500", "--p", "1e5", "--fuel", "CH4:3", "--oxidizer", AIR,
                   "--phi", "1")
    fractions = check.plain["mass_fractions"]
    check.same_gas("mass fractions", "--T", "1500", "--p", "1e5", "--Y",
                   ", ".join(f"{name}: {value}" for name, value in fractions.items()))
    check.require("one atmosphere unless told", check.gas(METHANE, "--T", "300", "--X", AIR)["pressure"] == 101325)


def equilibria(check: Checker) -> None:
    start = check.gas(METHANE, *FLAME)
    for options in (("--hp",), ("--equilibrium", "--hp"), ("--hp", "--equilibrium")):
        flame = check.gas(METHANE, *FLAME, *options)
        check.close(" ".join(options), flame["temperature"], FLAME_TEMPERATURE, 1e-9)
        check.require("  says so", flame["equilibrium"] == "HP")
        check.close("  same enthalpy", flame["enthalpy_mass"], start["enthalpy_mass"], 1e-12)
    for options in (("--equilibrium",), ("--tp",)):
        burnt = check.gas(METHANE, "--T", str(flame["temperature"]), *FLAME[2:], *options)
        check.close(" ".join(options), burnt["mole_fractions"]["CO"], flame["mole_fractions"]["CO"], 1e-9)
        check.require("  same temperature", burnt["temperature"] == flame["temperature"])
    bomb = check.gas(METHANE, *FLAME, "--uv")
    check.close("--uv: same density", bomb["density"], start["density"], 1e-12)
    check.close("--uv: same energy", bomb["enthalpy_mass"] - bomb["pressure"] / bomb["density"],
                start["enthalpy_mass"] - start["pressure"] / start["density"], 1e-11)
    check.close("--tv: same density", check.gas(METHANE, *FLAME, "--tv")["density"], start["density"], 1e-12)
    check.close("--sp: same entropy", check.gas(METHANE, *FLAME, "--sp")["entropy_mass"], start["entropy_mass"], 1e-12)
    check.require("no equilibrium unless asked for", start["equilibrium"] is None)


def tables(check: Checker) -> None:
    result = check.program("gas", METHANE, *FLAME, "--reactions")
    check.require("tables", result.code == 0 and result.err == "" and "CH4 " in result.out and "325  " in result.out)
    check.require("only what is there", "C3H8" not in result.out.split("rate constants")[0])
    everything = check.program("gas", METHANE, *FLAME, "--all")
    check.require("--all", "C3H8" in everything.out)


def chemkin(check: Checker) -> None:
    with tempfile.TemporaryDirectory() as folder:
        mechanism, thermo, converted = (pathlib.Path(folder) / name for name in ("chem.inp", "therm.dat", "mech.yaml"))
        mechanism.write_text(CHEMKIN, encoding="utf-8")
        thermo.write_text(CHEMKIN_THERMO, encoding="utf-8")
        options = ("--T", "2000", "--X", "H:1, H2:1")
        gas = check.gas(mechanism, thermo, *options)
        check.close("CHEMKIN files", gas["forward_rate_constants"][0], 1e18 * 1e-12 / 2000, 1e-12)
        result = check.program("mechanism", mechanism, thermo, "-o", converted)
        check.require("CHEMKIN files converted", result.code == 0, result.err)
        again = check.gas(converted, *options)
        check.close("  same rates", again["net_production_rates"]["H"], gas["net_production_rates"]["H"], 1e-13)
        check.close("  same entropy", again["entropy_mass"], gas["entropy_mass"], 1e-13)


def equal_reactions(check: Checker) -> None:
    """Duplicates that are not marked: an error that says how, or marked by --permissive; like warnings are counted."""
    with tempfile.TemporaryDirectory() as folder:
        mechanism, thermo, converted = (pathlib.Path(folder) / name for name in ("chem.inp", "therm.dat", "mech.yaml"))
        twice = "2H+M=H2+M 1.E18 -1. 0.\nH2+M=2H+M 1.E10 0. 0.\n2O=O2 1. 0. 0.\nDUP\n2O+H2=O2+2H 1. 0. 0.\nDUP\n"
        text = CHEMKIN.replace("2H+M=H2+M 1.E18 -1. 0.\n", twice).replace("ELEMENTS H", "ELEMENTS H O").replace("H H2 END", "H H2 O O2 END")
        mechanism.write_text(text, encoding="utf-8")
        oxygen = (chemkin_species("O", "O   1", [2.5, 0, 0, 0, 0, 29000, 4])
                  + chemkin_species("O2", "O   2", [3.5, 0, 0, 0, 0, -1000, 4]))
        thermo.write_text(CHEMKIN_THERMO.replace("END", oxygen + "END"), encoding="utf-8")
        refused = check.program("mechanism", mechanism, thermo)
        check.require("equal reactions", refused.code == 2 and "DUPLICATE" in refused.err and "--permissive" in refused.err,
                      refused.err)
        taken = check.program("mechanism", mechanism, thermo, "--permissive", "-o", converted)
        told = taken.err.splitlines()
        check.require("  --permissive", taken.code == 0 and sum("is marked as a duplicate: it is" in line for line in told) == 1,
                      taken.err)
        marks = [line for line in told if "no other one like it" in line]
        check.require("  one warning of a kind", len(marks) == 1 and marks[0].endswith("(1 more like this)"), taken.err)
        every = check.program("mechanism", mechanism, thermo, "--permissive", "--all-warnings")
        check.require("  --all-warnings", every.err.count("no other one like it") == 2, every.err)
        check.require("  both in the file", converted.read_text(encoding="utf-8").count("duplicate: true") == 2)
        options = ("--T", "2000", "--X", "H:1, H2:1")
        check.require("  gas", check.gas(mechanism, thermo, "--permissive", *options)["net_production_rates"]
                      == check.gas(converted, *options)["net_production_rates"])


def names(check: Checker) -> None:
    """Species in another case than the mechanism has them."""
    with tempfile.TemporaryDirectory() as folder:
        lower = pathlib.Path(folder) / "low.yaml"
        lower.write_text(re.sub(r"\b(O2|N2|H2)\b", lambda found: found[0].lower(), HYDROGEN.read_text(encoding="utf-8")),
                         encoding="utf-8")
        options = ("--T", "300", "--fuel", "H2:1", "--oxidizer", AIR, "--phi", "1", "--hp")
        check.close("names in another case", check.gas(lower, *options)["temperature"],
                    check.gas(HYDROGEN, *options)["temperature"], 1e-14)


def without_transport(check: Checker) -> None:
    gas = check.gas(SILICA, "--T", "1500", "--X", "C8H20O4SI:1, N2:9")
    check.require("no transport data: null and why",
                  gas["viscosity"] is None and gas["thermal_conductivity"] is None
                  and gas["mixture_diffusion_coefficients"] is None and gas["thermal_diffusion_coefficients"] is None
                  and "has no transport data" in gas["transport_note"])
    check.require("no transport data: rates all the same", any(gas["net_production_rates"].values()))


def beyond_the_data(check: Checker) -> None:
    result = check.program("gas", METHANE, "--T", "5500", "--X", AIR, "--json")
    check.require("a warning beyond the range of the data",
                  result.code == 0 and result.err.count("lampblack: warning: ") == 1 and "narrowest" in result.err
                  and json.loads(result.out)["temperature"] == 5500, result.err)
    result = check.program("gas", HYDROGEN, "--T", "5900", "--p", "1e10", "--X", "H:1", "--hp", "--json")
    check.require("no such equilibrium: an error of the numbers",
                  result.code == 3 and result.out == "" and "no temperature between" in result.err, result.err)


def mistake(check: Checker, name: str, arguments: tuple, words: tuple) -> None:
    result = check.program("gas", *arguments, "--json")
    told = result.err.startswith("lampblack: ") and all(word in result.err for word in words)
    check.require(name, result.code == 2 and result.out == "" and told,
                  f"exit code {result.code}\n{result.out}{result.err}")


def command_line(check: Checker) -> None:
    """Words that are no command or option are answered by what was meant."""
    deck = str(running.SOURCE / "cases/reactor/ignition_hydrogen/deck.yaml")
    study = str(running.SOURCE / "cases/flame1d/free_hydrogen/study.yaml")
    for words, told in (((deck,), f"is a file, not a command; a deck is run by: lampblack run {deck}"),
                        ((study,), f"a study is run by: lampblack sweep {study}"),
                        ((str(running.SOURCE / "cases"),), "there is no command '"),
                        (("chekc", deck), "there is no command 'chekc'; did you mean 'check'? Commands: run, check"),
                        (("run", deck, "-np", "2"), "'lampblack run' has no option '-np'; did you mean '--ranks'?"),
                        (("run", deck, "--fource"), "has no option '--fource'; did you mean '--force'?"),
                        (("--verison",), "'lampblack' has no option '--verison'; did you mean '--version'?"),
                        (("run", deck, "--set", "pressure=1", "bar"), '--set "pressure=1 bar"'),
                        (("run", deck, "--set", "title=a", "pressure=1"), "each setting has its own --set: --set pressure=1"),
                        (("run", deck, "--ranks", "0"), "Value 0 not in range 1 to ")):
        result = check.program(*words)
        check.require(f"command line: {' '.join(words[:1] + words[2:])}",
                      result.code == 2 and result.out == "" and result.err.count("lampblack: ") == 1 and told in result.err,
                      f"exit code {result.code}\n{result.out}{result.err}")


def ranks(check: Checker) -> None:
    """What every rank computes is printed once."""
    result = running.Program(sys.argv[1], sys.argv[3:], 2)("gas", METHANE, *FLAME, "--json")
    alone = check.program("gas", METHANE, *FLAME, "--json")
    check.require("two ranks", result.code == 0 and result.out == alone.out, result.err)


def main() -> int:
    program = running.Program(sys.argv[1], sys.argv[3:], int(sys.argv[2]))

    def failures(task: tuple) -> int:
        part, *arguments = task
        check = Checker(program)
        part(check, *arguments)
        return check.failures

    parts = (spellings, equilibria, tables, chemkin, equal_reactions, names, without_transport, beyond_the_data, command_line, ranks)
    failed = running.at_once(failures, [(part,) for part in parts] + [(mistake, *one) for one in MISTAKES])
    return 1 if sum(failed) else 0


if __name__ == "__main__":
    sys.exit(main())
