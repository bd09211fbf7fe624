"""Runs that a signal stops in the middle."""

import pathlib
import signal
import subprocess
import time

import running


def stopped_in_the_middle(command: list, out: pathlib.Path) -> str:
    """Stops a run by SIGTERM a moment after it has begun, which its record in `out` tells. What it says on standard error."""
    with subprocess.Popen([*command, "--out", str(out)], env=running.environment(), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as run:
        begun = time.monotonic()
        while not (out / "run.json").exists() and time.monotonic() < begun + 30:
            time.sleep(0.05)
        time.sleep(0.3)
        run.send_signal(signal.SIGTERM)
        _, err = run.communicate(timeout=60)
    assert run.returncode == 128 + signal.SIGTERM, err
    return err
