#!/usr/bin/python3
"""Which of the errors that insert.py put into a build are caught by its fast tests.

Usage: campaign.py BUILD LIST.json OUT.json [--jobs 2] [--only 3,7] [--labels-left-out long] [--seconds 3600]

First every test runs once without an error: that gives its time and the errors whose lines it reaches (kept in OUT.json.reached,
which a second call reads again). Then each error runs through the tests that reach it, those of its own module first, then the quickest, until one
fails or the seconds for an error are over.
The table at the end says by module how many errors were caught, and names those that were not.
"""

import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time


def tests_of(build: pathlib.Path, left_out: set) -> list:
    """The entries of ctest: name, command, folder, environment."""
    listing = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], capture_output=True, text=True, check=True)
    found = []
    for test in json.loads(listing.stdout)["tests"]:
        properties = {p["name"]: p["value"] for p in test.get("properties", [])}
        if "command" not in test or left_out & set(properties.get("LABELS", [])):
            continue
        found.append({"name": test["name"], "command": test["command"], "folder": properties.get("WORKING_DIRECTORY", str(build)),
                      "environment": dict(v.split("=", 1) for v in properties.get("ENVIRONMENT", [])),
                      "skip": properties.get("SKIP_RETURN_CODE", 77)})
    return found


def environment(test: dict, more: dict) -> dict:
    basic = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1",
             "OMPI_MCA_hwloc_base_binding_policy": "none", "OMPI_MCA_mpi_yield_when_idle": "1", "GTEST_FAIL_FAST": "1"}
    return {**os.environ, **basic, **test["environment"], **more}


def run(test: dict, timeout: float, **more) -> tuple:
    """Whether it passed, its seconds, and what it printed."""
    begin = time.monotonic()
    with tempfile.TemporaryFile("w+", errors="replace") as out:
        process = subprocess.Popen(test["command"], cwd=test["folder"], env=environment(test, more), stdin=subprocess.DEVNULL, stdout=out,
                                   stderr=subprocess.STDOUT, start_new_session=True)
        try:
            code = process.wait(timeout)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, 9)
            process.wait()
            code = "no end"
        out.seek(0)
        return code in (0, test["skip"]), time.monotonic() - begin, out.read()


def reach(tests: list, jobs: int, timeout: float) -> dict:
    """Of each test its seconds and the errors it reaches."""
    def one(test):
        with tempfile.TemporaryDirectory() as folder:
            passed, seconds, out = run(test, timeout, LAMPBLACK_INSERTED_REACHED=folder)
            numbers = {int(line) for file in pathlib.Path(folder).iterdir() for line in file.read_text().split()}
        if not passed:
            print(f"fails without any error: {test['name']}\n{out[-2000:]}", flush=True)
        return test["name"], {"passed": passed, "seconds": seconds, "reached": sorted(numbers)}

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        return dict(pool.map(one, tests))


def failing_case(out: str) -> str:
    found = re.findall(r"^\[  FAILED  \] (\S+?),? .*$|^FAILED\s+(.*)$", out, re.MULTILINE)
    return next((a or b for a, b in found if a or b), "")[:90]


def hunt(error: dict, tests: dict, reached: dict, seconds: float) -> dict:
    own = f"/tests/{error['file'].split('/')[0]}"
    names = sorted((name for name, what in reached.items() if error["number"] in what["reached"] and what["passed"]),
                   key=lambda name: (own not in tests[name]["folder"], reached[name]["seconds"]))
    begin = time.monotonic()
    for tried, name in enumerate(names, start=1):
        if time.monotonic() - begin > seconds:
            return {"caught_by": None, "tests_reaching": len(names), "tried": tried - 1, "seconds": time.monotonic() - begin}
        passed, _, out = run(tests[name], max(30.0, 6 * reached[name]["seconds"]), LAMPBLACK_INSERTED_ERROR=str(error["number"]))
        if not passed:
            return {"caught_by": name, "case": failing_case(out), "tests_reaching": len(names), "tried": tried,
                    "seconds": time.monotonic() - begin}
    return {"caught_by": None, "tests_reaching": len(names), "tried": len(names), "seconds": time.monotonic() - begin}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("list", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--only", default="")
    parser.add_argument("--seconds", type=float, default=3600)
    parser.add_argument("--labels-left-out", default="long")
    arguments = parser.parse_args()
    errors = json.loads(arguments.list.read_text(encoding="utf-8"))
    tests = {test["name"]: test for test in tests_of(arguments.build, set(arguments.labels_left_out.split(",")))}
    kept = arguments.out.with_name(arguments.out.name + ".reached")
    if not kept.exists():
        kept.write_text(json.dumps(reach(list(tests.values()), arguments.jobs, 900)))
    reached = json.loads(kept.read_text())
    only = {int(n) for n in arguments.only.split(",") if n}
    result = json.loads(arguments.out.read_text()) if arguments.out.exists() else {}
    wanted = [e for e in errors if (e["number"] in only if only else str(e["number"]) not in result)]
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        pending = {pool.submit(hunt, error, tests, reached, arguments.seconds): error for error in wanted}
        for done in concurrent.futures.as_completed(pending):
            error, what = pending[done], done.result()
            result[str(error["number"])] = what
            arguments.out.write_text(json.dumps(result, indent=1))
            print(f"{error['number']:3} {'caught' if what['caught_by'] else 'MISSED'} {error['file']}:{error['line']} [{error['what']}] "
                  f"{what['caught_by'] or ''} {what.get('case', '')} ({what['tried']} of {what['tests_reaching']}, {what['seconds']:.0f} s)", flush=True)
    by_module = collections.defaultdict(lambda: [0, 0])
    for error in errors:
        if str(error["number"]) in result:
            count = by_module[error["file"].split("/")[0]]
            count[0] += result[str(error["number"])]["caught_by"] is not None
            count[1] += 1
    for module, (caught, all_) in by_module.items():
        print(f"{module:10} {caught} of {all_} caught")
    for error in errors:
        if str(error["number"]) in result and result[str(error["number"])]["caught_by"] is None:
            print(f"missed {error['number']}: {error['file']}:{error['line']} [{error['what']}] {error['text']}")
    return 0


sys.exit(main())
