"""Interreflect in Python: the same engine, and the same bits, as interreflect-cli.

    import interreflect as ir

    e = ir.Experiment("ldm-ao", "builtin:cornell", size=(400, 300), directions=64)
    picture = e.render(outputs="gbuffer.*", progress=print)
    picture.image                      # a NumPy array, without a copy
    ir.compare(picture, e.match(samples=256).render())["rmse"]
    ir.sweep(e, {"directions": [16, 64, 256]}, reference=256)   # a DataFrame

Whatever is wrong is an Error with one line. The manual's page is docs/python.md.
"""

import inspect as _inspect
import io as _io

from . import _core
from ._core import (
    BudgetError,
    Cancelled,
    Error,
    Experiment,
    InputError,
    Machine,
    Picture,
    Project,
    Scene,
    UsageError,
    __version__,
    commit,
    describe,
    manual,
    methods,
    metrics,
    read,
    samples_folder,
)

__all__ = [
    "BudgetError",
    "Cancelled",
    "Error",
    "Experiment",
    "InputError",
    "Machine",
    "Metrics",
    "Picture",
    "Project",
    "Scene",
    "UsageError",
    "commit",
    "compare",
    "describe",
    "manual",
    "method",
    "methods",
    "metrics",
    "read",
    "samples_folder",
    "sweep",
]

for _type in (Experiment, Machine, Picture, Project, Scene):
    _type.__module__ = __name__


class Metrics(dict):
    """Errors by metric, and of how many pixels they are."""

    def __init__(self, values, pixels, skipped):
        super().__init__(values)
        self.pixels = pixels
        """That were compared."""
        self.skipped = skipped
        """That are not valid in either picture."""


def compare(image, reference, metrics=None, *, layer="", mask=None, rectangle=None, allow_different=(),
            pixels_per_degree=None):
    """Errors of an image against a reference.

    Both may be pictures, arrays of linear values, or files. What they say of themselves (transport, scene,
    camera, light) must be alike; allow_different names what may differ.

    metrics: names of metrics(); None: all.
    layer: of pictures and EXR files; empty: the main result.
    mask: an array; only pixels above 0.5 count.
    rectangle: x, y, width and height; only pixels inside count.
    pixels_per_degree: for flip, of visual angle; None: those of a desktop screen.
    """
    found = _core._compare(image, reference, metrics, layer, mask, rectangle, allow_different, pixels_per_degree)
    return Metrics(found["metrics"], found["pixels"], found["skipped"])


def sweep(experiment, axes, *, reference=None, repeats=None, references=None, progress=None, cancel=None,
          each=None, machine=None):
    """Renders all combinations of some values, and returns a pandas.DataFrame with a row for each.

    axes: values by key: parameters, size, seed, frames, time, camera, lights or scene; the last is fastest.
    reference: measures each variation against its ground truth of so many samples; True: as match() has it.
    repeats: warm runs of each variation after the first; None: one with a reference, else none.
    references: a folder for ground truths, which later sweeps read again.
    progress, cancel, machine: as Experiment.render has them.
    each: called as each(coordinates, picture) for every variation.

    Columns are those of `interreflect-cli sweep --csv`. A variation that fails is a row with its problem.
    """
    import pandas

    samples = None if reference is None or reference is False else 0 if reference is True else reference
    if repeats is None:
        repeats = 0 if samples is None else 1
    text = _core._sweep(experiment, axes, samples, repeats, references, progress, cancel, each, machine)
    texts = ["id", "device", "build", "key", "reference", "image", "problem"]
    return pandas.read_csv(_io.StringIO(text), dtype={name: str for name in texts}, keep_default_na=True)


def method(id):
    """A method as a function that makes its experiments: its signature has the parameters with their defaults,
    its help is the method's page of the manual."""
    described = describe(id)

    def make(scene, **settings):
        return Experiment(id, scene, **settings)

    parameter = _inspect.Parameter
    make.__name__ = make.__qualname__ = id.replace("-", "_")
    make.__doc__ = manual(id)
    make.__signature__ = _inspect.Signature(
        [parameter("scene", parameter.POSITIONAL_OR_KEYWORD)]
        + [parameter(each["key"], parameter.KEYWORD_ONLY, default=each["default"]) for each in described["parameters"]]
        + [parameter("settings", parameter.VAR_KEYWORD)]
    )
    return make
