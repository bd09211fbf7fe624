"""The blocks of docs/tutorial.md, one after the other in one shell, with the program installed.

Usage: tutorial_test.py BUILD_FOLDER CMAKE
"""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import install_test
import running


def main(build, cmake):
    text = (running.SOURCE / "docs/tutorial.md").read_text(encoding="utf-8")
    blocks = re.findall(r"^```sh\n(.*?)^```", text, re.S | re.M)
    assert len(blocks) > 12, "the page has lost its blocks"
    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        prefix = install_test.install(build, cmake, work)
        folder = work / "tutorial"
        folder.mkdir()
        env = dict(running.environment(), PATH=f"{prefix}/bin:{pathlib.Path(cmake).parent}:/usr/bin:/bin", LAMPBLACK_PREFIX=str(prefix))
        env.pop("PYTHONPATH", None)
        done = subprocess.run(["bash", "-xeuo", "pipefail", "-c", "\n".join(blocks)], cwd=folder, env=env, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        print(done.stdout)
        assert done.returncode == 0, "a block failed"
        said = done.stdout
        # What the page says comes of it.
        speed = {run: json.loads((folder / f"results/{run}/run.json").read_text())["results"]["flame_speed_m_per_s"]
                 for run in ("methane", "lean", "fine", "hydrogen", "hydrogen_own")}
        assert speed["lean"] < speed["methane"] and abs(speed["fine"] / speed["methane"] - 1) < 0.02
        assert 1.01 < speed["hydrogen_own"] / speed["hydrogen"] < 1.1
        assert said.count("exit code 2") >= 2 and "did you mean" in said
        strained = [float(x) for x in re.findall(r"1/s   ([0-9.]+) ppb", said)]
        assert len(strained) == 3 and strained == sorted(strained, reverse=True), strained
        left, law = map(float, re.search(r"C2H2 left (\S+) of it, by the law (\S+)", said).groups())
        assert abs(left / law - 1) < 1e-2
        stick = float(re.search(r"^stick,([0-9.e-]+),", said, re.M)[1])
        assert 2e-4 < stick < 5e-3, stick
        for picture in ("methane", "soot", "strain", "ignition", "duct_fit"):
            assert list((folder / f"results/{picture}/pictures").glob("*.png")), picture
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
