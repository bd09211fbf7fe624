"""How the pictures look, and saying what was made and what was not."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend has to be chosen first)
import numpy as np  # noqa: E402
from PIL import Image  # noqa: E402  (without Pillow there is no matplotlib)

plt.rcParams.update(
    {
        "figure.dpi": 100,
        "savefig.dpi": 160,
        "font.size": 10,
        "axes.grid": False,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "legend.frameon": False,
        "lines.linewidth": 1.6,
        "figure.constrained_layout.use": True,
    }
)


class Pictures:
    """Saves figures to a folder; keeps what was made and why something was not."""

    def __init__(self, folder):
        self.folder = folder
        self.made = []
        self.skipped = []

    def save(self, figure, name):
        self.folder.mkdir(parents=True, exist_ok=True)
        path = self.folder / f"{name}.png"
        temporary = self.folder / f".{name}.png"
        figure.savefig(temporary, format="png")
        temporary.replace(path)
        plt.close(figure)
        self.made.append(path)

    def film(self, figure, name, frame, count, per_second=4):
        """An animated GIF; frame(i) draws into the figure."""
        self.folder.mkdir(parents=True, exist_ok=True)
        path = self.folder / f"{name}.gif"
        temporary = self.folder / f".{name}.gif"
        figure.set_dpi(90)
        frames = []
        for i in range(count):
            frame(i)
            figure.canvas.draw()
            frames.append(Image.fromarray(np.asarray(figure.canvas.buffer_rgba())).convert("RGB"))
        frames[0].save(temporary, format="GIF", save_all=True, append_images=frames[1:], duration=round(1000 / per_second), loop=0)
        temporary.replace(path)
        plt.close(figure)
        self.made.append(path)

    def skip(self, what, why):
        self.skipped.append(f"{what}: {why}")


def shown_time(seconds):
    """A time with the unit that suits it."""
    if seconds >= 1.0:
        return f"{seconds:.3g} s"
    return f"{seconds * 1e3:.3g} ms"


def scaled_fraction(values):
    """Values of a small fraction in the unit that suits its largest, and that unit's name."""
    largest = max(float(values.max()), 0.0)
    for unit, factor in (("", 1.0), ("ppm", 1e6), ("ppb", 1e9), ("ppt", 1e12)):
        if largest * factor >= (0.005 if unit == "" else 0.1):
            return values * factor, unit
    return values, ""
