"""Ways to damage a file. Those that leave no file to read have to be refused; what random damage does is not known."""

import os
import pathlib
import random


def cut(data: bytes, chance: random.Random) -> bytes:
    return data[:chance.randrange(len(data))]


def flip(data: bytes, chance: random.Random) -> bytes:
    changed = bytearray(data)
    for _ in range(chance.choice([1, 1, 3, 20])):
        changed[chance.randrange(len(changed))] ^= 1 << chance.randrange(8)
    return bytes(changed)


def garbage(data: bytes, chance: random.Random) -> bytes:
    place = chance.randrange(len(data) + 1)
    return data[:place] + chance.randbytes(chance.choice([1, 10, 1000])) + data[place:]


def printable(data: bytes, chance: random.Random) -> bytes:
    """Some characters replaced by those that mean something in files of text."""
    changed = bytearray(data)
    for _ in range(chance.choice([1, 2, 5])):
        changed[chance.randrange(len(changed))] = ord(chance.choice("{}[]:,'\"#&*!|>%@`-+.eE0123456789 \t\n/="))
    return bytes(changed)


def lost_lines(data: bytes, chance: random.Random) -> bytes:
    lines = data.splitlines(keepends=True)
    for _ in range(chance.choice([1, 2, 5])):
        del lines[chance.randrange(len(lines)):][:1]
    return b"".join(lines)


def moved(data: bytes, chance: random.Random) -> bytes:
    """A piece of the file again at another place."""
    begin = chance.randrange(len(data))
    place = chance.randrange(len(data))
    return data[:place] + data[begin:begin + chance.choice([10, 100, 5000])] + data[place:]


def zeros(data: bytes, chance: random.Random) -> bytes:
    begin = chance.randrange(len(data))
    length = min(chance.choice([1, 64, 4096]), len(data) - begin)
    return data[:begin] + bytes(length) + data[begin + length:]


def mark(data: bytes, chance: random.Random) -> bytes:
    return b"\xef\xbb\xbf" + data


def windows(data: bytes, chance: random.Random) -> bytes:
    return data.replace(b"\n", b"\r\n")


def wide(data: bytes, chance: random.Random) -> bytes:
    return data.decode("latin-1").encode("utf-16")


def long_line(data: bytes, chance: random.Random) -> bytes:
    place = chance.randrange(len(data))
    return data[:place] + b"x" * 2_000_000 + data[place:]


# Weighted: what is random wants to be done often.
OF_BYTES = [cut] * 4 + [flip] * 5 + [garbage] * 3 + [printable] * 6 + [lost_lines] * 3 + [moved] * 3 + [zeros] * 3 \
    + [mark, windows, wide, long_line]


def nothing(path: pathlib.Path) -> None:
    path.write_bytes(b"")


def a_folder(path: pathlib.Path) -> None:
    path.mkdir()


def null_device(path: pathlib.Path) -> None:
    path.symlink_to("/dev/null")


def endless_device(path: pathlib.Path) -> None:
    path.symlink_to("/dev/urandom")


def silent_pipe(path: pathlib.Path) -> None:
    os.mkfifo(path)


def loop(path: pathlib.Path) -> None:
    path.symlink_to(path.name)


def missing(path: pathlib.Path) -> None:
    pass


OF_FILES = [nothing, a_folder, null_device, endless_device, silent_pipe, loop, missing]


def damage(path: pathlib.Path, chance: random.Random) -> tuple:
    """Damages a file; returns what was done and whether no reader can accept it."""
    data = path.read_bytes()
    if chance.random() < 0.25:
        path.unlink()
        kind = chance.choice(OF_FILES)
        kind(path)
        return kind.__name__.replace("_", " "), True
    kind = chance.choice(OF_BYTES)
    path.write_bytes(kind(data, chance))
    return kind.__name__.replace("_", " "), False
