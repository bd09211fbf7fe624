"""The pieces of Python in docs/python.md, one after the other in one session, as their reader would type them.

Usage: python_docs_test.py EXECUTABLE
"""

import os
import pathlib
import re
import sys
import tempfile
import time

import running

running.needs("h5py")
running.needs("matplotlib")


def main(executable):
    page = running.SOURCE / "docs/python.md"
    text = page.read_text(encoding="utf-8")
    pieces = [(match.group(1), text[: match.start(1)].count("\n")) for match in re.finditer(r"^```python\n(.*?)^```", text, re.S | re.M)]
    assert len(pieces) >= 6, "the page has lost its pieces"
    running.load_plots()
    os.environ.update(running.environment(), LAMPBLACK_PROGRAM=os.path.abspath(executable), PYTHONPATH=str(running.SOURCE / "python"))
    sys.path.insert(0, str(running.SOURCE / "python"))
    names = {"cases": str(running.SOURCE / "cases")}
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for piece, line in pieces:
            begun = time.perf_counter()
            exec(compile("\n" * line + piece, str(page), "exec"), names)  # lines of errors are those of the page
            print(f"ok  line {line + 1}: {time.perf_counter() - begun:.1f} s")
        assert list(pathlib.Path("results/ignition/pictures").glob("*.png"))
        os.chdir("/")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
