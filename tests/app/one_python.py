"""Python for the program's commands, started once: `LAMPBLACK_PYTHON` names a small program that hands its words, folder, environment
and streams over to a process that has the packages already and does each call in a fork of itself.

Usage: one_python.py SOCKET PACKAGE...   (the process; OnePython starts it)
"""

import json
import os
import pathlib
import runpy
import signal
import socket
import subprocess
import sys

CLIENT = """#!{python} -SEs
import json, os, socket, sys
if sys.argv[1] == "-c":  # which packages it has
    sys.exit(0)
server = socket.socket(socket.AF_UNIX)
server.connect({place!r})
call = json.dumps([sys.argv[1:], os.getcwd(), dict(os.environ)]).encode()
socket.send_fds(server, [len(call).to_bytes(8, "little")], [0, 1, 2])
server.sendall(call)
sys.exit(int(server.recv(16) or b"1"))
"""


class OnePython:
    """Within `with`, commands of the program that need Python have this one."""

    def __init__(self, folder: pathlib.Path, *packages: str):
        self.place, self.client = str(folder / "python.socket"), folder / "python3"
        self.client.write_text(CLIENT.format(python=sys.executable, place=self.place), encoding="utf-8")
        self.client.chmod(0o755)
        self.packages = packages

    def __enter__(self):
        self.process = subprocess.Popen([sys.executable, __file__, self.place, *self.packages], stdout=subprocess.PIPE)
        assert self.process.stdout.readline() == b"ready\n", "the Python for all calls did not begin"
        os.environ["LAMPBLACK_PYTHON"] = str(self.client)
        return self

    def __exit__(self, *_):
        del os.environ["LAMPBLACK_PYTHON"]
        self.process.terminate()
        self.process.wait()
        self.process.stdout.close()


def answer(connection: socket.socket) -> int:
    """One call, in a fork: the exit code."""
    head, streams, _, _ = socket.recv_fds(connection, 8, 3)
    with connection.makefile("rb") as caller:
        words, folder, environment = json.loads(caller.read(int.from_bytes(head, "little")))
    for stream, place in zip(streams, (0, 1, 2)):
        os.dup2(stream, place)
        os.close(stream)
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(environment)
    sys.path[0:1] = environment.get("PYTHONPATH", "").split(":")
    assert words[0] == "-m", words
    sys.argv = words[1:]
    try:
        runpy.run_module(words[1], run_name="__main__", alter_sys=True)
        code = 0
    except SystemExit as end:
        code = end.code if isinstance(end.code, int) else 0 if end.code is None else 1
        if isinstance(end.code, str):
            print(end.code, file=sys.stderr)
    except BaseException:
        sys.excepthook(*sys.exc_info())
        code = 1
    sys.stdout.flush()
    sys.stderr.flush()
    return code


def serve(place: str, packages: list) -> None:
    for package in packages:
        __import__(package)
    server = socket.socket(socket.AF_UNIX)
    server.bind(place)
    server.listen()
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # nobody waits for the forks
    print("ready", flush=True)
    while True:
        connection, _ = server.accept()
        if os.fork() == 0:
            signal.signal(signal.SIGCHLD, signal.SIG_DFL)
            server.close()
            connection.sendall(b"%d" % answer(connection))
            os._exit(0)
        connection.close()


if __name__ == "__main__":
    serve(sys.argv[1], sys.argv[2:])
