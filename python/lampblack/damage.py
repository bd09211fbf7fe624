"""What a script says of a file that is damaged or not of this program: one line with its name, and an exit code of 2."""

import os
import pathlib
import signal
import sys
import tempfile
import traceback
import warnings

from .errors import ResultsError


_read = []


def reading(path):
    """Notes the file that is read from here on, and returns it. A pipe or device could keep its reader waiting."""
    path = pathlib.Path(path)
    if path.exists() and not path.is_file():
        raise ResultsError(f"{path}: this is not a file")
    _read.append(path)
    return path


def _cause(error):
    """The reason in a line: HDF5's can be several."""
    words = " ".join(str(error).split())
    place = traceback.extract_tb(error.__traceback__)[-1]
    ours = [frame for frame in traceback.extract_tb(error.__traceback__) if pathlib.Path(__file__).parent in
            pathlib.Path(frame.filename).parents or pathlib.Path(frame.filename).parent.name == "scripts"]
    place = ours[-1] if ours else place
    return f"{type(error).__name__}: {words[:200]}, at line {place.lineno} of {pathlib.Path(place.filename).name}"


def _caught(main):
    """The exit code of a script's main(); an exception of the contents of a file becomes a line."""
    warnings.simplefilter("ignore", RuntimeWarning)  # of means over nothing: the picture shows the gap
    try:
        return main()
    except ResultsError as error:
        print(" ".join(str(error).split()), file=sys.stderr)
    except (ImportError, KeyboardInterrupt):
        raise
    except Exception as error:  # noqa: BLE001: a file can hold anything
        files = " or ".join(dict.fromkeys(map(str, _read[-3:])))
        print(f"{files or 'input'}: damaged, or without what is read from it ({_cause(error)})", file=sys.stderr)
    return 2


CRASHES = (signal.SIGABRT, signal.SIGSEGV, signal.SIGBUS, signal.SIGFPE, signal.SIGILL)


def guarded(main):
    """Runs a script's main() and returns its exit code. Whatever the contents of a file lead to ends in a line; HDF5 crashes
    on some damaged files, therefore main() has a process of its own."""
    sys.stdout.flush()
    sys.stderr.flush()
    with tempfile.TemporaryFile() as said:
        child = os.fork()
        if child == 0:
            os.dup2(said.fileno(), 2)
            return _caught(main)
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # the child's to answer
        code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        if -code in CRASHES:
            files = " or ".join(word for word in sys.argv[1:] if pathlib.Path(word).exists())
            print(f"{files}: damaged: the library that reads it crashed ({signal.Signals(-code).name})", file=sys.stderr)
            return 2
        said.seek(0)
        sys.stderr.write(said.read().decode("utf-8", "replace"))
    if code < 0:
        if -code != signal.SIGKILL:
            signal.signal(-code, signal.SIG_DFL)
        os.kill(os.getpid(), -code)
    return code
