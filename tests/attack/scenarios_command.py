"""Command lines: settings, folders for the results, other commands with files that are none."""

import os
import pathlib

RUN = ["run", "DECK", "--out", "FOLDER/out"]
GAS = ["gas", "CASES/mechanisms/hydrogen_h2o2_10.yaml"]


def prepare(folder: pathlib.Path) -> None:
    """What the words name beside the deck."""
    (folder / "file").write_text("mine\n", encoding="utf-8")
    (folder / "loop").symlink_to("loop")
    (folder / "full").symlink_to("/dev/full")
    os.mkfifo(folder / "pipe")


def setting(text: str, expected: str) -> tuple:
    return f"--set {text[:50]!r}", [*RUN, "--set", text], expected


def out(folder: str, expected: str) -> tuple:
    return f"--out {folder!r}", ["run", "DECK", "--out", folder], expected


def gas(expected: str, *words) -> tuple:
    return "gas " + " ".join(words)[:60], [*GAS, *words], expected


SCENARIOS = [
    setting('initial.composition="H2: 2, O2: 1, N2: 3.76"', "accepted"),
    setting("initial.composition='H2: 2, O2: 1, N2: 3.76'", "accepted"),
    setting("initial.composition=H2: 2, O2: 1, N2: 3.76", "accepted"),
    setting("initial.composition=H2:2,O2:1", "accepted"),
    setting("initial.composition={H2: 2, O2: 1}", "refused"),
    setting("=1", "refused"), setting("", "refused"), setting("pressure", "refused"), setting("pressure=", "refused"),
    setting("pressure==1 atm", "refused"), setting("pressure=[", "refused"), setting("pressure={a: 1}", "refused"),
    setting("pressure=1 atm\npressure: 2 atm", "refused"), setting("a..b=1", "refused"), setting(".=1", "refused"),
    setting("pressure.=1 atm", "refused"), setting("initial[0]=1", "refused"), setting("ignition.species[0]=H", "accepted refused"),
    setting("ignition.species[1]=H", "accepted refused"), setting("ignition.species[1000000000]=H", "refused"),
    setting("ignition.species[4294967296]=H", "refused"), setting("ignition.species[-1]=H", "refused"),
    setting("ignition.species[]=H", "refused"), setting("ignition.species[x]=H", "refused"), setting("ignition.species[0=H", "refused"),
    setting("initial=null", "refused"), setting("problem=flow", "refused"), setting("problem.x=1", "refused"),
    setting("mechanism.x=1", "refused"), setting("k" * 100_000 + "=1", "refused"), setting("title=" + "x" * 100_000, "accepted refused"),
    setting("title=*a", "accepted refused"), setting("title=\x1b[2J", "accepted refused"), setting(".".join("a" * 10_000) + "=1", "refused"),
    setting("pressure=1e400 Pa", "refused"), setting("pressure=nan", "refused"), setting("pressure=1 atm", "accepted"),
    ("a setting twice", [*RUN, "--set", "pressure=1 atm", "--set", "pressure=2 atm"], "accepted refused"),
    out("", "refused"), out("FOLDER/file", "refused"), out("FOLDER/file/out", "refused"), out("FOLDER/loop", "refused"),
    out("FOLDER/pipe", "refused"), out("/dev/null", "refused"), out("FOLDER/full", "refused"), out("/proc/none", "refused"),
    out("FOLDER/" + "x" * 300, "refused"), out("FOLDER/a b\n\u00e9", "accepted"),
    out("FOLDER/deck.yaml", "refused"), out("FOLDER/a/../b/./c", "accepted"),
    ("a deck that is a folder", ["run", "FOLDER", "--out", "FOLDER/out"], "refused"),
    ("a deck that is a pipe", ["check", "FOLDER/pipe"], "refused"),
    ("a deck that is a loop", ["check", "FOLDER/loop"], "refused"),
    ("a deck that never ends", ["check", "/dev/zero"], "refused"),
    ("a deck as a study", ["sweep", "DECK", "--out", "FOLDER/out"], "refused"),
    ("a study as a deck", ["run", "CASES/flame1d/free_hydrogen/study.yaml", "--out", "FOLDER/out"], "refused"),
    ("a mechanism as a deck", ["run", "CASES/mechanisms/hydrogen_h2o2_10.yaml", "--out", "FOLDER/out"], "refused"),
    ("replay of a folder", ["replay", "."], "refused"), ("replay of a deck", ["replay", "DECK"], "refused"),
    ("replay of what never ends", ["replay", "/dev/zero"], "refused"), ("replay of a pipe", ["replay", "FOLDER/pipe"], "refused"),
    ("mechanism of a deck", ["mechanism", "DECK"], "refused"), ("mechanism of a folder", ["mechanism", "."], "refused"),
    ("mechanism without end", ["mechanism", "/dev/zero"], "refused"), ("mechanism of nothing", ["mechanism", "/dev/null"], "refused"),
    ("mechanism into a folder", ["mechanism", "CASES/mechanisms/hydrogen_h2o2_10.yaml", "-o", "FOLDER"], "refused"),
    ("mechanism onto a full disk", ["mechanism", "CASES/mechanisms/hydrogen_h2o2_10.yaml", "-o", "/dev/full"], "refused numerics"),
    ("mechanism onto itself", ["mechanism", "DECK", "-o", "DECK"], "refused"),
    gas("accepted", "--T", "1500", "--X", "H2:2, O2:1"), gas("refused", "--T", "nan", "--X", "H2:1"),
    gas("refused", "--T", "1e300", "--X", "H2:1"), gas("refused", "--T", "300", "--p", "0", "--X", "H2:1"),
    gas("", "--T", "300", "--p", "1e300", "--X", "H2:1", "--hp"), gas("", "--T", "300", "--p", "1e-300", "--X", "H2:1, O2:1", "--hp"),
    gas("refused", "--T", "300", "--X", ""), gas("accepted", "--T", "300", "--X", "H2:1e308, O2:1e308"),
    gas("refused", "--T", "300", "--X", "H2:-1"), gas("refused", "--T", "300", "--X", "H2:1,H2:1"),
    gas("", "--T", "200", "--X", "H2:2, O2:1", "--tp"), gas("", "--T", "3000", "--X", "H2:2, O2:1", "--uv", "--json"),
    gas("", "--T", "300", "--X", "AR:1", "--hp"), gas("", "--T", "300", "--X", "AR:1", "--sp"),
    gas("", "--T", "1000", "--X", "H:1", "--uv"), gas("", "--T", "300", "--X", "H2:1, O2:1e-300", "--hp"),
]
