# SPDX-License-Identifier: GPL-3.0-or-later
"""What happens around every call of the extension: its signature for `inspect`, texts with units, errors that name the argument,
warnings of what did not converge, and how objects without columns are pickled.

The extension is called first and as it is. Only where it refuses its arguments does this file look at them: texts with units become
numbers, and what is left is explained.
"""

from __future__ import annotations

import __future__
import difflib
import errno
import functools
import inspect
import math
import os
import re
import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core

if TYPE_CHECKING:
    from collections.abc import Callable


class ConvergenceWarning(UserWarning):
    """A solver ended before it reached its tolerance: the numbers of its result are not an answer."""


class MissingFile(_core.InvalidInput, FileNotFoundError):
    """A file that is to be read, or the folder of one that is to be written, is not there. Also an InvalidInput."""

    def __str__(self) -> str:
        # An OSError with a filename puts its number and that name around the text, which names the file already.
        return str(self.args[0])


def refusal(field: str, value: str, demand: str) -> _core.InvalidInput:
    """As those of the library are made: "field: value constraint; remedy", and the four as attributes."""
    constraint, _, remedy = demand.partition("; ")
    error = _core.InvalidInput(f"{field}: {value} {demand}" if value else f"{field}: {demand}")
    error.field, error.value, error.constraint, error.remedy = field, value, constraint, remedy
    return error


# Arguments whose unit is that of a quantity with another name.
_LIKE = {
    "lx": "size_x", "ly": "size_y", "young": "contact_modulus", "pressures": "pressure",
    "window": "pressure", "hardness": "pressure", "initial_pressure": "pressure", "separations": "separation",
    "mean_indentation": "indentation", "lowest": "indentation", "highest": "indentation", "motion_scale": "indentation",
    "heights": "height", "radius": "contact_radius", "length": "size_x", "amplitude": "rms_height", "tip_radius": "contact_radius", "resolution": "size_x", "shortest_wavelength": "size_x", "noise": "rms_height",
    "resistivity_1": "resistivity", "resistivity_2": "resistivity", "conductivity_1": "conductivity", "conductivity_2": "conductivity",
    "work": "work_of_adhesion", "power": "moment0", "densities": "psd",
    "reference_force": "force", "min_force": "force", "first_load": "force",
    "nominal_pressure": "pressure", "max_pressure": "pressure", "mean_contact_pressure": "pressure", "pressure_window": "pressure",
    "loaded_size": "size_x", "size": "size_x", "edge_radius": "contact_radius", "flat_radius": "contact_radius", "radii": "contact_radius",
    "radius_x": "contact_radius", "radius_y": "contact_radius", "semi_x": "contact_radius", "semi_y": "contact_radius",
    "semi_z": "contact_radius", "r": "contact_radius", "center": "size_x", "shift": "size_x", "x0": "size_x", "x1": "size_x", "y0": "size_x", "y1": "size_x",
    "depth": "height", "mean_plane": "height", "min_prominence": "height", "start": "height", "stop": "height", "target": "rms_height",
    "range": "gap", "tangential_range": "displacement", "max_amplitude": "normal_amplitude", "velocities": "velocity",
    "q": "wavenumber", "qx": "wavenumber", "qy": "wavenumber", "direction": "phase", "checkpoint_every": "time",
    "normal_angular_frequency": "angular_frequency", "tangential_angular_frequency": "angular_frequency",
    "max_angular_frequency": "angular_frequency", "angular_frequencies": "angular_frequency",
    "frequency": "threshold_frequency", "pixel_size": "size_x", "crop": "size_x", "duration": "time", "correlation_length": "rolloff", "force_amplitude": "force", "transverse": "displacement",
}  # fmt: skip
# Arrays over the grid; every other array has one dimension.
_FIELDS = {"heights", "initial_pressure", "contact", "pressure"}
_KINDS = {
    "float": "a number", "int": "a whole number", "bool": "True or False", "str": "a text", "None": "None",
    "numpy.typing.ArrayLike": "an array of numbers", "os.PathLike[str]": "a path",
    "mpi4py.MPI.Intracomm": "a communicator of mpi4py",
}  # fmt: skip
_HINTS = {
    "Surface": "make one with salebra.Surface(heights, size_x, size_y)",
    "Material": "make one with salebra.Material(contact_modulus, poisson=…)",
    "Grid2D": "make one with salebra.Grid2D(nx, ny, lx, ly)",
}


class _Annotation(str):
    """An annotation as a text, which inspect shows without quotes."""

    def __repr__(self) -> str:
        return self.replace("salebra.", "")


def signatures_of(native: Any) -> list[inspect.Signature]:
    """The signatures of a function of the extension, one of each overload, their annotations as texts."""
    return [_signature(*overload) for overload in native.__nb_signature__]


def _signature(text: str, _documentation: str | None, *defaults: Any) -> inspect.Signature:
    source = re.sub(r"\\(\d+)", r"_defaults[\1]", text) + ": ..."
    names: dict[str, Any] = {"_defaults": defaults[0] if defaults else ()}
    code = compile(re.sub(r"def \w+\(", "def _(", source), "<signature>", "exec", flags=__future__.annotations.compiler_flag)
    exec(code, names)  # of the extension's own text
    bare = inspect.signature(names["_"])
    parameters = [value.replace(annotation=_annotation(value.annotation)) for value in bare.parameters.values()]
    return bare.replace(parameters=parameters, return_annotation=_annotation(bare.return_annotation))


def _annotation(text: Any) -> Any:
    return text if text is inspect.Parameter.empty else _Annotation(text)


def _without_self(signature: inspect.Signature) -> inspect.Signature:
    return signature.replace(parameters=list(signature.parameters.values())[1:])


class _Signatures:
    """The signatures of a function, made when one is asked for: of hundreds, a script needs few. inspect finds them as what the
    function wraps."""

    def __init__(self, native: Any) -> None:
        self._native = native

    @functools.cached_property
    def all(self) -> list[inspect.Signature]:
        return signatures_of(self._native)

    @property
    def __signature__(self) -> inspect.Signature:
        return self.all[0]

    def __call__(self, *arguments: Any, **keywords: Any) -> Any:
        return self._native(*arguments, **keywords)


class _ConstructorSignature:
    """The signature of a class, likewise."""

    def __init__(self, native: Any) -> None:
        self._signatures = _Signatures(native)

    def __get__(self, made: Any, kind: type) -> inspect.Signature:
        return _without_self(self._signatures.__signature__).replace(return_annotation=inspect.Signature.empty)


def _parts(annotation: str) -> list[str]:
    """The alternatives of a union."""
    parts, depth = [""], 0
    for token in re.split(r"( \| |[\[\]])", annotation):
        depth += (token == "[") - (token == "]")
        if token == " | " and depth == 0:
            parts.append("")
        else:
            parts[-1] += token
    return parts


def _kind(part: str) -> str:
    if part in _KINDS:
        return _KINDS[part]
    if part.startswith("typing.Literal["):
        return "one of " + part[len("typing.Literal[") : -1]
    if part.startswith("collections.abc.Callable"):
        return "a function"
    if part.startswith(("collections.abc.Sequence", "list")):
        return "a list"
    if part.startswith("tuple"):
        return "a tuple"
    name = part.rsplit(".", 1)[-1]
    return f"{'an' if name[0] in 'AEIOU' else 'a'} {name}"


def _wanted(annotation: str) -> str:
    kinds = [_kind(part) for part in _parts(annotation) if part != "None"]
    return " or ".join(dict.fromkeys(kinds))


def _came(value: Any) -> str:
    if isinstance(value, np.ndarray):
        return f"an array of shape {value.shape} and type {value.dtype}"
    if isinstance(value, (str, int, float, bool)) or value is None:
        return repr(value)
    return f"{type(value).__module__.split('.')[0]}.{type(value).__name__}" if not _builtin(value) else f"a {type(value).__name__}"


def _builtin(value: Any) -> bool:
    return type(value).__module__ == "builtins"


def _fits(part: str, value: Any) -> bool:
    """Whether a value may be meant by one alternative of an annotation; what cannot be told counts as meant."""
    if part == "None":
        return value is None
    if value is None:
        return False
    if part == "float":
        return isinstance(value, (int, float, np.number)) or (hasattr(value, "__float__") and np.ndim(value) == 0)
    if part == "int":
        return hasattr(value, "__index__") and np.ndim(value) == 0
    if part == "bool":
        return isinstance(value, (bool, np.bool_))
    if part == "str" or part.startswith("typing.Literal["):
        return isinstance(value, str)
    if part == "os.PathLike[str]":
        return hasattr(value, "__fspath__")
    if part == "mpi4py.MPI.Intracomm":
        return hasattr(value, "py2f")
    if part.startswith("collections.abc.Callable"):
        return callable(value)
    if part.startswith(("collections.abc.Sequence", "list", "tuple")):
        return hasattr(value, "__len__") and not isinstance(value, str)
    kind = getattr(_core, part.rsplit(".", 1)[-1], None)
    return not isinstance(kind, type) or isinstance(value, kind)


def _like(argument: str) -> str:
    """The quantity whose units an argument has."""
    like = _LIKE.get(argument, "contact_modulus" if argument == "material" else argument)
    if like.endswith("s") and _core.quantity(like)[1] == like:  # a list of what the quantity is
        like = like[:-1]
    return like


def _number(text: str, argument: str) -> float:
    try:
        return float(_core.parse_quantity(text, _like(argument)))
    except _core.InvalidInput as error:
        demand = f"{error.constraint}; {error.remedy}" if error.remedy else error.constraint
        raise refusal(argument, error.value, demand) from None


def _has_unit(value: Any) -> bool:
    """Whether a value is a quantity of pint or of astropy."""
    return hasattr(value, "to") and (hasattr(value, "units") or hasattr(value, "unit"))


def _in_si(quantity: Any, argument: str) -> Any:
    """The number, or the array, of a quantity of pint or of astropy."""
    unit = _core.quantity(_like(argument))[0]
    try:
        converted = quantity.to("" if unit == "1" else unit.replace(" ", "*"))
    except Exception as error:  # of the other library
        raise refusal(argument, str(quantity), f"is not in {unit}: {error}") from None
    return converted.magnitude if hasattr(converted, "magnitude") else converted.value


def _is_bare(item: Any) -> bool:
    """Whether it is a number without a unit that needs one: zero is the same in every unit."""
    try:
        return float(item) != 0
    except (TypeError, ValueError):
        return False


def _from_text(value: Any, argument: str, annotation: str) -> Any:
    """The numbers of a text or an object with a unit, or of a list of them, where numbers are wanted; else the value itself."""
    parts = _parts(annotation)
    if _has_unit(value) and ("float" in parts or "numpy.typing.ArrayLike" in parts):
        return _in_si(value, argument)
    if any(part == "str" or part.startswith("typing.Literal[") for part in parts):
        return value
    wants_array = "numpy.typing.ArrayLike" in parts or any(part.startswith(("tuple", "collections.abc.Sequence")) for part in parts)
    if isinstance(value, str):
        if "float" in parts or wants_array:
            return _number(value, argument)
        if any(part.endswith("Material") for part in parts):
            return _core.Material(_number(value, argument))
    if wants_array and isinstance(value, (list, tuple)) and any(isinstance(item, str) or _has_unit(item) for item in value):
        bare = [item for item in value if _is_bare(item)]
        if bare and len(bare) < len(value):
            listed = ", ".join(str(item) for item in value)
            raise refusal(argument, f"[{listed}]", f"has a unit at some of its numbers alone; give {bare[0]} one too, or none to all")
        return type(value)(
            _number(item, argument) if isinstance(item, str) else _in_si(item, argument) if _has_unit(item) else item for item in value
        )
    return value


class _Call:
    """One call whose arguments were refused."""

    def __init__(self, name: str, signature: inspect.Signature, arguments: tuple[Any, ...], keywords: dict[str, Any]) -> None:
        self.name = name
        self.parameters = dict(signature.parameters)
        self.arguments = arguments
        self.keywords = dict(keywords)

    def error(self, text: str) -> TypeError:
        return TypeError(f"{self.name}: {text}")

    def bind(self) -> dict[str, Any]:
        """The arguments by name. Raises TypeError for those that no parameter takes, and for what is missing."""
        places = [name for name, parameter in self.parameters.items() if parameter.kind is not inspect.Parameter.KEYWORD_ONLY]
        if len(self.arguments) > len(places):
            after = [name for name in self.parameters if name not in places]
            advice = f"; give what follows by name: {', '.join(after)}" if after else ""
            raise self.error(f"{len(self.arguments)} arguments, at most {len(places)} go by place ({', '.join(places)}){advice}")
        bound = dict(zip(places, self.arguments))
        for key, value in self.keywords.items():
            if key not in self.parameters:
                close = difflib.get_close_matches(key, self.parameters, 1, 0.5)
                advice = f"did you mean {close[0]}?" if close else f"it takes {', '.join(self.parameters)}"
                raise self.error(f"no argument {key}; {advice}")
            if key in bound:
                raise self.error(f"{key} was given twice, by its place and by its name")
            bound[key] = value
        for name, parameter in self.parameters.items():
            if name not in bound and parameter.default is inspect.Parameter.empty:
                raise self.error(f"{name} is missing; give {_wanted(parameter.annotation)}")
        return bound

    def checked(self, name: str, value: Any) -> Any:
        """The value, made of a text where it is one. Raises TypeError "…: name: wanted …, got …"."""
        annotation = str(self.parameters[name].annotation)
        value = _from_text(value, name, annotation)
        parts = _parts(annotation)
        if "numpy.typing.ArrayLike" in parts and value is not None:
            self.check_shape(name, value, len(parts) > 1 and not isinstance(value, str))
        elif not any(_fits(part, value) for part in parts):
            hint = next((_HINTS[part.rsplit(".", 1)[-1]] for part in parts if part.rsplit(".", 1)[-1] in _HINTS), "")
            raise self.error(f"{name}: wanted {_wanted(annotation)}, got {_came(value)}" + (f"; {hint}" if hint else ""))
        return value

    def check_shape(self, name: str, value: Any, optional: bool) -> None:
        try:
            array = np.asarray(value)
            is_complex = array.dtype.kind == "c"
            array = array if is_complex else array.astype(float)
        except (TypeError, ValueError):
            raise self.error(f"{name}: wanted an array of numbers, got {_came(value)}") from None
        if is_complex:
            raise self.error(f"{name}: wanted real numbers, got {_came(value)}; take its .real")
        field = name in _FIELDS and not (name == "pressure" and "material" in self.parameters)
        if field and array.ndim != 2:
            raise self.error(f"{name}: wanted two dimensions (nx, ny), got shape {array.shape}")
        if not field and array.ndim > 1:
            raise self.error(f"{name}: wanted one dimension, got shape {array.shape}")

    def again(self, native: Callable[..., Any], error: TypeError) -> Any:
        """The call with what its texts mean."""
        bound = self.bind()
        checked = {name: self.checked(name, value) for name, value in bound.items()}
        if all(checked[name] is bound[name] for name in bound):
            raise self.error(str(error).split("\n")[0]) from None
        return native(**checked)


def _missing_file(error: Exception, signature: inspect.Signature, arguments: tuple[Any, ...], keywords: dict[str, Any]) -> None:
    """Raises MissingFile in place of an error about a file that is not there."""
    for name, value in [*zip(signature.parameters, arguments), *keywords.items()]:
        parameter = signature.parameters.get(name)
        if parameter is None or "PathLike" not in str(parameter.annotation) or not isinstance(value, (str, os.PathLike)):
            continue
        path = os.fspath(value)
        if path and not os.path.exists(path) and os.path.basename(path) in str(error):
            writes = "overwrite" in signature.parameters
            if not writes or not os.path.isdir(os.path.dirname(path) or "."):
                missing = MissingFile(str(error))
                missing.__dict__.update(error.__dict__)
                missing.filename = path
                missing.errno = errno.ENOENT
                raise missing from None


def _warn(name: str, signatures: _Signatures, result: Any) -> None:
    converged = getattr(result, "converged", True)
    if converged is True or getattr(result, "termination", None) == "interrupted":
        return
    if isinstance(converged, np.ndarray):
        failed = int(np.size(converged) - np.count_nonzero(converged))
        if failed == 0:
            return
        what = f"{failed} of {np.size(converged)} samples did not converge; they are marked"
    elif converged is False:
        residual = getattr(result, "residual", None)
        what = "did not converge" + (f", residual {residual:.1e}" if isinstance(residual, float) else "")
        what += "; its numbers are not an answer"
    else:
        return
    remedies = " or ".join(option for option in ("max_iterations", "tolerance") if option in signatures.__signature__.parameters)
    warnings.warn(f"{name}: {what}" + (f". Raise {remedies}" if remedies else ""), ConvergenceWarning, stacklevel=3)


def _warn_of_pressure(name: str, result: Any, arguments: tuple[Any, ...], keywords: dict[str, Any]) -> None:
    """Warns of a contact pressed by more than a tenth of E*: as a rule a unit was forgotten."""
    if isinstance(result, _core.NormalContactState):
        pressure, modulus = result.mean_pressure, result.contact_modulus
    elif isinstance(result, _core.ForceCurve):
        materials = [value for value in (*arguments, *keywords.values()) if isinstance(value, _core.Material)]
        if not materials or len(result) == 0:
            return
        pressure, modulus = float(np.max(result.pressure)), materials[0].contact_modulus
    else:
        return
    warning = _core._warning_of_pressure(pressure, modulus)
    if warning:
        warnings.warn(f"{name}: {warning}", stacklevel=3)


def _refused(error: TypeError) -> bool:
    return "incompatible function arguments" in str(error)


def _once_more(
    native: Callable[..., Any], name: str, signatures: list[inspect.Signature], arguments: tuple[Any, ...],
    keywords: dict[str, Any], error: TypeError,
) -> Any:
    """The call by the first overload that can be meant; the error of the first where none can."""
    refusals = []
    for signature in signatures:
        try:
            return _Call(name, signature, arguments, keywords).again(native, error)
        except TypeError as refusal:
            refusals.append(refusal)
    raise refusals[0] from None


def function(native: Any, name: str, module: str = "salebra", method: bool = False) -> Callable[..., Any]:
    """A Python function of one of the extension, which a user finds in the module."""
    signatures = _Signatures(native)

    def call(*arguments: Any, **keywords: Any) -> Any:
        try:
            result = native(*arguments, **keywords)
        except TypeError as error:
            if not _refused(error):
                raise
            here = functools.partial(native, arguments[0]) if method and arguments else native
            overloads = [_without_self(overload) for overload in signatures.all] if method else signatures.all
            result = _once_more(here, name, overloads, arguments[1:] if method else arguments, keywords, error)
        except (_core.InvalidInput, _core.IoError) as error:
            _missing_file(error, signatures.__signature__, arguments, keywords)
            raise
        _warn_of_pressure(name, result, arguments, keywords)
        _warn(name, signatures, result)
        _remember(result, name, arguments, keywords)
        return result

    call.__name__ = name.rsplit(".", 1)[-1]
    call.__qualname__ = name
    call.__module__ = module
    call.__doc__ = native.__doc__.split("\n", 2)[-1].strip() if native.__doc__ else None
    call.__wrapped__ = signatures  # type: ignore[attr-defined]
    return call


def _of_labelled(arguments: tuple[Any, ...], keywords: dict[str, Any]) -> tuple[tuple[Any, ...], dict[str, Any]]:
    """Arguments of a Surface: those of an xarray.DataArray over x and y with its order of axes, its coordinates and its units."""
    named = {**dict(zip(("heights", "size_x", "size_y"), arguments)), **keywords}
    heights = named.get("heights")
    if set(getattr(heights, "dims", ())) != {"x", "y"} or not hasattr(heights, "coords") or len(arguments) > 3:
        return arguments, keywords
    array: Any = heights
    for axis in array.coords.keys() & {"x", "y"}:
        array = array.sortby(axis)
        points = array.coords[axis]
        steps = np.diff(points.values.astype(float))
        if f"size_{axis}" in named or steps.size == 0:
            continue
        if not np.allclose(steps, steps.mean(), rtol=1e-3, atol=0):
            raise refusal(f"heights.{axis}", "", "is not evenly spaced; interpolate the heights to a grid")
        named[f"size_{axis}"] = (steps.size + 1) * float(steps.mean()) * _metres(points, f"size_{axis}")
    # As to_xarray() says of the whole surface: a part of it has another size and does not repeat itself.
    whole = all(np.isclose(array.attrs.get(f"size_{axis}", math.nan), named.get(f"size_{axis}", math.nan)) for axis in "xy")
    if whole and "periodic" in array.attrs:
        named.setdefault("periodic", bool(array.attrs["periodic"]))
    named["heights"] = array.transpose("x", "y").values
    if "units" in array.attrs:
        factor = _metres(array, "heights")
        named["heights"] = named["heights"] if factor == 1 else named["heights"] * factor
    return (), named


def _metres(labelled: Any, argument: str) -> float:
    units = labelled.attrs.get("units")
    return _number(f"1 {units}", argument) if units else 1.0


# Of which f may be given for ω = 2πf.
_OSCILLATIONS = ("Drag", "EqualFrequency")


def _of_frequency(keywords: dict[str, Any]) -> dict[str, Any]:
    if "angular_frequency" in keywords:
        raise refusal("frequency", "", "was given beside angular_frequency; give one of them")
    rest = {key: value for key, value in keywords.items() if key != "frequency"}
    given = keywords["frequency"]
    frequency = _number(given, "frequency") if isinstance(given, str) else float(given)
    return {**rest, "angular_frequency": 2 * math.pi * frequency}


_constructors: dict[str, Callable[..., Any]] = {}


def construct(name: str, made: Any, arguments: tuple[Any, ...], keywords: dict[str, Any]) -> None:
    """Called by the extension where an object is made."""
    if name == "Surface":
        arguments, keywords = _of_labelled(arguments, keywords)
    elif name in _OSCILLATIONS and "frequency" in keywords:
        keywords = _of_frequency(keywords)
    _constructors[name](made, *arguments, **keywords)
    if name == "Surface":
        warning = _core._warning_of_heights(made)
        if warning:
            warnings.warn(f"{name}: {warning}", stacklevel=2)
    _remember(made, name, arguments, keywords)


# ---- objects that are what a call made of its arguments

def _kept(value: Any) -> Any:
    return value.copy() if isinstance(value, np.ndarray) else value


def _remember(made: Any, name: str, arguments: tuple[Any, ...], keywords: dict[str, Any]) -> None:
    if type(made).__dictoffset__ and isinstance(made, _REMADE):
        made.__dict__.setdefault(
            "_call", (name, tuple(_kept(value) for value in arguments), {key: _kept(value) for key, value in keywords.items()})
        )


def _again(name: str, arguments: tuple[Any, ...], keywords: dict[str, Any]) -> Any:
    return getattr(_core, name)(*arguments, **keywords)


def _reduce(self: Any) -> Any:
    if "_call" not in self.__dict__:
        raise TypeError(f"cannot pickle this {type(self).__name__}: it was not made by a call of Python")
    return _again, self.__dict__["_call"]


def _same(one: Any, other: Any) -> bool:
    if isinstance(one, np.ndarray) or isinstance(other, np.ndarray):
        return np.array_equal(one, other, equal_nan=True)
    if isinstance(one, (tuple, list)) and isinstance(other, (tuple, list)):
        return len(one) == len(other) and all(map(_same, one, other))
    if isinstance(one, dict) and isinstance(other, dict):
        return one.keys() == other.keys() and all(_same(one[key], other[key]) for key in one)
    return bool(one == other)


def _equal(self: Any, other: object) -> bool:
    if self is other:
        return True
    mine, its = self.__dict__.get("_call"), getattr(other, "__dict__", {}).get("_call")
    return type(self) is type(other) and mine is not None and its is not None and _same(mine, its)


def _hash(self: Any) -> int:
    return hash(self.__getstate__())


def _hash_of_call(self: Any) -> int:
    """The same for what _equal() calls equal. Arrays, lists and objects that have no hash count by their size alone."""
    if "_call" not in self.__dict__:
        return object.__hash__(self)

    def digest(value: Any) -> int:
        if isinstance(value, (np.ndarray, list, tuple, dict)) or type(value).__hash__ is None:
            return int(np.size(value)) if not isinstance(value, dict) else len(value)
        return hash(value)

    name, arguments, keywords = self.__dict__["_call"]
    return hash((name, *map(digest, arguments), *((key, digest(keywords[key])) for key in sorted(keywords))))


_REMADE: tuple[type, ...] = (
    _core.ContactLaw, _core.AsperityModel, _core.Spectrum, _core.ProfileSpectrum, _core.HeightDistribution, _core.IndenterProfile,
    _core.PerssonTheory, _core.BearingCurve, _core.ContactSets, _core.ResultReader,
)  # fmt: skip


def _answer_class(kind: Any) -> None:
    """Constructor, methods, pickle and repr of a class of the extension."""
    from . import _show

    own = vars(kind)
    name = kind.__name__
    if type(own.get("__init__")).__name__ == "nb_method":
        signature = _ConstructorSignature(own["__init__"])
        _constructors[name] = function(own["__init__"], name, method=True)
        _core._answer_constructor(kind, name)
        kind.__signature__ = signature
    for key, value in list(own.items()):
        if key.startswith("_"):
            continue
        if type(value).__name__ == "nb_method":
            setattr(kind, key, function(value, f"{name}.{key}", method=True))
        elif type(value).__name__ == "nb_func":
            setattr(kind, key, staticmethod(function(value, f"{name}.{key}")))
        elif isinstance(value, property) and value.__doc__:  # of those without a text: what they return, as it was called at first
            value.__doc__ = value.__doc__.replace("salebra._core.", "salebra.")
    if issubclass(kind, _REMADE):
        kind.__reduce__ = _reduce
        kind.__eq__ = _equal
        kind.__hash__ = _hash_of_call
    elif "__eq__" in own and "__hash__" not in own:
        kind.__hash__ = None if name in ("Surface", "NonGaussianSurface") else _hash
    if "__repr__" not in own and not (issubclass(kind, BaseException)):
        kind.__repr__ = _show.text
    kind._repr_html_ = _show.html


def answer() -> None:
    """Puts everything of this file around the extension. Called once, when the package is imported."""
    # First of all, since signatures and documentation name the module of every class. Messages and pickles show it too.
    for kind in [*vars(_core).values(), MissingFile, ConvergenceWarning]:
        if isinstance(kind, type):
            kind.__module__ = "salebra"
    for module, public in ((_core, "salebra"), (_core._closed_form, "salebra.closed_form")):
        for name, value in list(vars(module).items()):
            if name.startswith("_"):
                continue
            if type(value).__name__ == "nb_func":
                setattr(module, name, function(value, name, public))
            elif isinstance(value, type) and not issubclass(value, BaseException):
                _answer_class(value)
