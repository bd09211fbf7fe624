"""What a script says of a file that is damaged or not of this program: one line with its name, and an exit code of 2."""

import pathlib
import sys
import traceback
import warnings


class ResultsError(Exception):
    """The file or folder does not hold results that can be read; the message says so to the user."""


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
    ours = [frame for frame in traceback.extract_tb(error.__traceback__) if "lampblack_plots" in frame.filename
            or pathlib.Path(frame.filename).parent.name == "scripts"]
    place = ours[-1] if ours else place
    return f"{type(error).__name__}: {words[:200]}, at line {place.lineno} of {pathlib.Path(place.filename).name}"


def guarded(main):
    """Runs a script's main() and returns its exit code. Whatever the contents of a file lead to ends in a line."""
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
