"""What `cmake --install` leaves, moved to a folder with a space in its name and used from anywhere by somebody without rights: the
program and what ships with it, runs on several ranks, pictures, completion in bash, and a user's own program.

Usage: install_test.py BUILD_FOLDER CMAKE
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import running

running.needs("h5py")
running.needs("matplotlib")
NOBODY = 65534
# One of the smallest flames, made smaller.
SMALL = running.settings("grid.slope=0.5", "grid.curve=0.8")


class User:
    """Somebody with a home that is for reading only, in a folder of their own; nobody where the test has root's rights."""

    def __init__(self, work: pathlib.Path, program: pathlib.Path):
        self.folder, self.program = work / "work here", program
        home, self.temporary = work / "home", work / "tmp"
        for folder in (self.folder, self.temporary):
            folder.mkdir(mode=0o777)
            folder.chmod(0o777)
        home.mkdir(mode=0o555)
        self.rights = {"user": NOBODY, "group": NOBODY, "extra_groups": []} if os.geteuid() == 0 else {}
        # Nothing of the caller's but where programs are.
        self.env = {"HOME": str(home), "TMPDIR": str(self.temporary), "PATH": f"{program.parent}:/usr/bin:/bin", "LC_ALL": "C.UTF-8",
                    "OMPI_MCA_pml": "ob1"}

    def __call__(self, *command, code=0, timeout=120):
        done = subprocess.run(list(map(str, command)), cwd=self.folder, env=self.env, stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, timeout=timeout, check=False, **self.rights)
        assert done.returncode == code, f"{command}: exit code {done.returncode}: {done.stdout}{done.stderr}"
        return done


def install(build, cmake, work) -> pathlib.Path:
    """The prefix, after it was moved."""
    first, prefix = work / "first", work / "moved here"
    subprocess.run([cmake, "--install", build, "--prefix", str(first)], check=True, stdout=subprocess.DEVNULL)
    for file in [*first.rglob("*.cmake"), *first.rglob("*.hpp")]:
        named = re.search(rf"(?<![\w/}}]){re.escape(str(running.SOURCE))}(?![\w-])", file.read_text())
        assert not named, f"{file} names the sources"
    first.rename(prefix)
    return prefix


def check_cases(user, prefix):
    listed = [line.split()[0] for line in user("lampblack", "cases").stdout.splitlines()]
    shipped = {str(deck.parent.relative_to(running.SOURCE / "cases")) for deck in (running.SOURCE / "cases").rglob("deck.yaml")}
    assert shipped <= set(listed) and "mechanisms" not in listed, listed
    for part, folder in (("cases", "cases"), ("mechanisms", "cases/mechanisms"), ("python", "python")):
        assert user("lampblack", "where", part).stdout == f"{prefix}/share/lampblack/{folder}\n"
    # Each case by itself: what its decks name comes along.
    for name in ("flow/burner_ensembles", "free_hydrogen"):
        folder = pathlib.Path(name).name
        user("lampblack", "cases", "copy", name)
        for deck in (user.folder / folder).glob("*.yaml"):
            assert "../" not in deck.read_text(), f"{deck} names files of other folders"
    assert (user.folder / "burner_ensembles/burner.msh").is_file()
    user("lampblack", "check", "free_hydrogen/deck.yaml")
    user("lampblack", "sweep", "--check", "free_hydrogen/study.yaml")
    user("lampblack", "cases", "copy", "free_hydrogen", "a folder/of mine")
    again = user("lampblack", "cases", "copy", "free_hydrogen", code=2)
    assert "there is such a folder or file already" in again.stderr
    wrong = user("lampblack", "cases", "copy", "free_hydrogn", code=2)
    assert "did you mean 'free_hydrogen'" in wrong.stderr


def check_mechanisms(user):
    """By name alone, in decks and on the command line; a file beside the deck goes first, and a path is a path."""
    deck = user.folder / "own.yaml"
    text = (running.SOURCE / "cases/reactor/ignition_hydrogen/deck.yaml").read_text()
    deck.write_text(text.replace("../../mechanisms/", ""))
    assert "10 species" in user("lampblack", "check", deck).stdout
    shutil.copy(running.SOURCE / "cases/mechanisms/hydrogen_sandiego_9.yaml", user.folder / "hydrogen_h2o2_10.yaml")
    assert "9 species" in user("lampblack", "check", deck, "--set", "ignition.species=[OH]").stdout
    (user.folder / "hydrogen_h2o2_10.yaml").unlink()
    deck.write_text(text)
    assert "there is no such file" in user("lampblack", "check", deck, code=2).stderr
    deck.write_text(text.replace("../../mechanisms/", "./"))  # a path, not a name of what ships
    assert "./hydrogen_h2o2_10.yaml: there is no such file" in user("lampblack", "check", deck, code=2).stderr
    deck.write_text(text.replace("../../mechanisms/hydrogen_h2o2_10", "hydrogen_h202_10"))
    told = user("lampblack", "check", deck, code=2).stderr
    assert "own.yaml:4:12: mechanism: " in told and "did you mean 'hydrogen_h2o2_10.yaml'" in told, told
    assert "325 reactions" in user("lampblack", "gas", "methane_gri30_53.yaml", "--T", "1500", "--X", "CH4:1").stdout


def check_run(user):
    user("lampblack", "run", "free_hydrogen/deck.yaml", *SMALL, "--ranks", "2", "--out", "results/my flame")
    record = json.loads((user.folder / "results/my flame/run.json").read_text())
    assert record["ranks"] == 2 and record["status"] == "done"
    made = user("lampblack", "plot", "results/my flame").stdout
    assert (user.folder / "results/my flame/pictures/flame.png").is_file(), made
    assert "there is no results.h5" in user("lampblack", "plot", "nowhere", code=2).stderr
    assert not list(user.temporary.glob("lampblack.*")), "a run left its session's folder"


def check_python(user):
    """The package finds the program it came with, which need not be in PATH."""
    user.env["PYTHONPATH"] = user("lampblack", "where", "python").stdout.strip()
    path, user.env["PATH"] = user.env["PATH"], "/usr/bin:/bin"
    script = ("import lampblack, lampblack.program as p\nprint(p.executable())\n"
              "print(lampblack.run('free_hydrogen/deck.yaml', set={'grid.slope': 0.5, 'grid.curve': 0.8}, out='by python').profile().rows)")
    program, rows = user("/usr/bin/python3", "-c", script).stdout.splitlines()
    assert program == str(user.program) and int(rows) > 10
    user.env["PATH"] = path


def check_completion(user, prefix):
    script = prefix / "share/bash-completion/completions/lampblack"
    for line, expected in (("che", ["check"]), ("--ver", ["--version"]), ("run --se", ["--set"]), ("run --ran", ["--ranks"]),
                           ("cases co", ["copy"]), ("cases copy flame1d/free_m", ["flame1d/free_methane"]), ("where mech", ["mechanisms"]),
                           ("gas methane_g", ["methane_gri30_53.yaml"]), ("run free_h", ["free_hydrogen"])):
        words = ["lampblack", *line.split()]
        done = user("bash", "-c", f"source '{script}'; COMP_WORDS=({' '.join(words)}); COMP_CWORD={len(words) - 1}; _lampblack; "
                                  "printf '%s\\n' \"${COMPREPLY[@]}\"")
        assert done.stdout.split() == expected, f"{line}: {done.stdout}{done.stderr}"


def check_own_program(user, prefix, cmake):
    """docs/examples/own_program, which finds the package, links one library and gives the number of `lampblack gas`."""
    example = running.SOURCE / "docs/examples/own_program"
    user.env["PATH"] += f":{pathlib.Path(cmake).parent}"
    user(cmake, "-S", example, "-B", "own build", "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={prefix}", "-DCMAKE_BUILD_TYPE=Debug")
    user(cmake, "--build", "own build")
    said = user("own build/flame_temperature", prefix / "share/lampblack/cases/mechanisms/methane_gri30_53.yaml").stdout
    own, fraction = re.fullmatch(r"(\S+) K, mass fraction of CO (\S+)\n", said).groups()
    gas = json.loads(user("lampblack", "gas", "methane_gri30_53.yaml", "--T", "300", "--X", "CH4:1, O2:2, N2:7.52", "--hp", "--json").stdout)
    assert abs(float(own) - gas["temperature"]) < 1e-5 and abs(float(fraction) / gas["mass_fractions"]["CO"] - 1) < 1e-5, (said, gas)


def main(build, cmake):
    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        work.chmod(0o755)
        prefix = install(build, cmake, work)
        user = User(work, prefix / "bin/lampblack")
        check_cases(user, prefix)
        check_mechanisms(user)
        check_run(user)
        check_python(user)
        check_completion(user, prefix)
        check_own_program(user, prefix, cmake)
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
