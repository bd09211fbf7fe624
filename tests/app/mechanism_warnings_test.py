"""Every command that reads a mechanism tells its warnings once, on any number of ranks, and goes on; so it does with former
names of a deck.

Usage: mechanism_warnings_test.py EXECUTABLE RANKS MPIEXEC...
"""

import pathlib
import sys
import tempfile

import running

WARNING = "lampblack: warning: "


def former_names(program: running.Program, folder: pathlib.Path) -> bool:
    """A deck with the names of version 0.1: a note for each, once, from `check` and from `run`; the run is as any other."""
    source = running.SOURCE / "cases/population_balance/soot_growth.yaml"
    deck = folder / "former.yaml"
    deck.write_text(source.read_text().replace("unbiased_moments: []", "claims: []", 1))
    short = running.settings("repeats=2", "time.outputs=2", "methods={sections: {type: sectional, sections: 20, smallest: 3.8e-28 m^3, "
                             "spacing: 2, overflow: 1, claims: []}}")
    old = [program("check", deck), program("run", deck, *short, "--out", folder / "former")]
    both = program("check", deck, *running.settings("methods={one: {type: dsmc, claims: [M0], unbiased_moments: [M0]}}"))
    good = both.code == 2 and "this is the former name of 'unbiased_moments', which is given too; leave 'claims' out" in both.err
    for result in old:
        told = [line for line in result.err.splitlines() if line.startswith(WARNING)]
        good = good and result.code == 0 and len(told) == 1 and ".claims is called " in told[0] and "since version 0.2" in told[0]
    print(f"{'ok' if good else 'FAILED':8}former names: {[(one.code, one.err) for one in (*old, both)]}")
    return good


def main() -> int:
    program = running.Program(sys.argv[1], sys.argv[3:], int(sys.argv[2]))
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        deck = running.small_case(pathlib.Path(folder))
        mechanism = deck.parents[1] / "mechanisms" / running.MECHANISM
        text = mechanism.read_text()
        # The heat capacity of nitrogen above 1000 K, 0.1 R too large.
        spoilt = text.replace("2.92664", "3.02664", 1)
        line = text[:text.index("name: N2\n")].count("\n") + 1
        for content, expected in ((text, 0), (spoilt, 1)):
            mechanism.write_text(content)
            for command in (("check", deck), ("mechanism", mechanism),
                            ("gas", mechanism, "--T", "1500", "--X", "N2:1", "--json")):
                result = program(*command)
                told = [one for one in result.err.splitlines() if one.startswith(WARNING)]
                good = result.code == 0 and len(told) == expected and WARNING not in result.out
                for warning in told:
                    good = good and f"{running.MECHANISM}:{line}: species 'N2'" in warning and "cp/R by 0.1 " in warning
                failures += not good
                print(f"{'ok' if good else 'FAILED':8}{command[0]}, {expected} expected: {result.code} {result.err}")
        failures += not former_names(program, pathlib.Path(folder))
    return min(failures, 1)


if __name__ == "__main__":
    sys.exit(main())
