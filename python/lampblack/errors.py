"""Errors of the program as exceptions, with the place that its message names."""

import re
import signal


class LampblackError(Exception):
    """What the program or its results had to say. `message` is the whole text, `exit_code` that of the program, or None."""

    def __init__(self, message, exit_code=None):
        super().__init__(message)
        self.message, self.exit_code = message, exit_code


class ResultsError(LampblackError):
    """The file or folder does not hold results that can be read; the message says so to the user."""


class InputError(LampblackError):
    """The input is wrong (exit code 2). `file`, `line` and `column`, or `setting` where a --set is wrong, and `key` say where, as
    far as the message does; otherwise they are None."""

    def __init__(self, message, exit_code=2):
        super().__init__(message, exit_code)
        line, given = _LINE.match(message), _SETTING.match(message)
        place = line or given or _FILE.match(message)
        self.file = place["file"] if place and not given else None
        self.line, self.column = (int(line["line"]), int(line["column"])) if line else (None, None)
        self.setting = given["setting"] if given else None
        key = _KEY.match(message[place.end():] if place else message)
        self.key = key["key"] if key else None


class NumericsError(LampblackError):
    """The numbers failed (exit code 3): what, where, when is in the message."""


class MachineError(LampblackError):
    """The machine failed (exit code 3): a full disk, no memory."""


class Stopped(LampblackError):
    """A signal or a limit of time ended the run; `signal` is its number. What was computed is kept."""

    def __init__(self, message, exit_code):
        super().__init__(message, exit_code)
        self.signal = signal.Signals(exit_code - 128)


class ProgramBug(LampblackError):
    """A mistake of Lampblack itself: please report it."""


_KEY_WORDS = r"[A-Za-z_]\w*(?:\[\d+\])?(?:\.\w+(?:\[\d+\])?)*"
_LINE = re.compile(r"(?P<file>[^\n]*?):(?P<line>\d+):(?P<column>\d+): ")
_FILE = re.compile(r"(?P<file>[^\n:]+\.ya?ml): ")
_SETTING = re.compile(rf"--set (?P<setting>[^\n]*?): (?={_KEY_WORDS}: )")
_KEY = re.compile(rf"(?P<key>{_KEY_WORDS}): ")
_NAME = "lampblack: "


def error_of(exit_code, text):
    """The exception of a run that ended with this code and said this on its standard error."""
    told = text.rpartition("\n" + _NAME)[2] if not text.startswith(_NAME) or "\n" + _NAME in text else text[len(_NAME):]
    told = told.strip() or f"the program ended with exit code {exit_code} and said nothing"
    if exit_code == 2:
        return InputError(told)
    if exit_code == 3:
        numerics = told.startswith("numerics: ")
        return NumericsError(told[len("numerics: "):], 3) if numerics else MachineError(told, 3)
    if exit_code < 0:  # ended by a signal that it could not answer
        exit_code = 128 - exit_code
    if exit_code > 128:
        return Stopped(told, exit_code)
    return ProgramBug(told, exit_code)
