"""Every command that reads a mechanism tells its warnings once, on any number of ranks, and goes on.

Usage: mechanism_warnings_test.py EXECUTABLE RANKS MPIEXEC...
"""

import pathlib
import sys
import tempfile

import running

WARNING = "lampblack: warning: "


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
    return min(failures, 1)


if __name__ == "__main__":
    sys.exit(main())
