# SPDX-License-Identifier: GPL-3.0-or-later
"""Wraps the functions and the classes of the extension.

A wrapper calls the extension with the arguments as they are. If the extension refuses them, the wrapper converts texts with units to
numbers and calls it again, or raises an error that names the wrong argument. A wrapper also has a signature for `inspect`, warns about
results that did not converge, and makes objects without a description picklable.
"""

from __future__ import annotations

import __future__
import difflib
import errno
import functools
import inspect
import os
import re
import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core, _show

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping


class ConvergenceWarning(UserWarning):
    """A solver ended before it reached its tolerance: do not use the numbers of its result."""


class MissingFile(_core.InvalidInput, FileNotFoundError):
    """A file to read, or the folder of a file to write, does not exist. Also an InvalidInput."""

    def __str__(self) -> str:
        # An OSError with a filename would add its number and the name to a text that has the name already.
        return str(self.args[0])


def refusal(field: str, value: str, demand: str) -> _core.InvalidInput:
    """An InvalidInput like those of the library: "field: value constraint; remedy", and the four as attributes."""
    constraint, _, remedy = demand.partition("; ")
    error = _core.InvalidInput(f"{field}: {value} {demand}" if value else f"{field}: {demand}")
    error.field, error.value, error.constraint, error.remedy = field, value, constraint, remedy
    return error


# ---- units of arguments

# Arguments without the name of their quantity in their own name, by a quantity that has the same unit.
_LIKE = {
    argument: quantity
    for quantity, arguments in {
        "height": "amplitude center correlation_length crop depth highest max_amplitude length loaded_size lowest lx ly mean_plane"
        " min_prominence motion_scale noise pixel_size r radii radius_x radius_y range semi_x semi_y semi_z shift size start stop"
        " tangential_range target transverse width x0 x1 y0 y1",
        "pressure": "c11 c12 c13 c33 c44 c66 material modulus pressure_window window young", "force": "first_load force_amplitude", "wavenumber": "q qx qy",
        "time": "checkpoint_every duration", "angular_frequency": "angular_frequencies", "threshold_frequency": "frequency",
        "velocity": "velocities", "phase": "direction", "psd": "densities", "moment0": "power", "work_of_adhesion": "work",
        "resistivity": "resistivity_1 resistivity_2", "conductivity": "conductivity_1 conductivity_2",
    }.items()
    for argument in arguments.split()
}  # fmt: skip


def _like(argument: str) -> str:
    """The quantity whose unit an argument has: the longest end of its name that the glossary lists, "pressure" for "max_pressure"."""
    words = _LIKE.get(argument, argument).split("_")
    ends = ("_".join(words[first:]) for first in range(len(words)))
    named = (name for end in ends for name in (end, end.removesuffix("s")))
    return next((name for name in named if _core.quantity(name) != ("1", name)), argument)


def _has_unit(value: Any) -> bool:
    """True for texts and for quantities of pint or astropy."""
    return isinstance(value, str) or (hasattr(value, "to") and (hasattr(value, "units") or hasattr(value, "unit")))


def in_si(value: Any, argument: str) -> Any:
    """The number of a text, or the number or array of a quantity of pint or astropy, in the SI unit of the argument."""
    if isinstance(value, str):
        try:
            return float(_core.parse_quantity(value, _like(argument)))
        except _core.InvalidInput as error:
            raise refusal(argument, error.value, "; ".join(filter(None, (error.constraint, error.remedy)))) from None
    unit = _core.quantity(_like(argument))[0]
    try:
        converted = value.to("" if unit == "1" else unit.replace(" ", "*"))
    except Exception as error:  # the other package has exceptions of its own
        raise refusal(argument, str(value), f"is not in {unit}: {error}") from None
    return converted.magnitude if hasattr(converted, "magnitude") else converted.value


def _from_text(value: Any, argument: str, annotation: str) -> Any:
    """The value; where numbers are wanted, texts and quantities are converted to numbers, also those in a list."""
    parts = _parts(annotation)
    wants_array = any(part.startswith(("numpy.typing.ArrayLike", "tuple", "collections.abc.Sequence")) for part in parts)
    wants_text = any(part.startswith(("str", "typing.Literal")) for part in parts)
    if _has_unit(value) and not (wants_text and isinstance(value, str)):
        if "float" in parts or wants_array:
            return in_si(value, argument)
        if any(part.endswith("Material") for part in parts):
            return _core.Material(in_si(value, argument))
    if wants_array and not wants_text and isinstance(value, (list, tuple)) and any(map(_has_unit, value)):
        bare = [item for item in value if not _has_unit(item) and item != 0]  # zero is the same in every unit
        if bare:
            listed = ", ".join(str(item) for item in value)
            raise refusal(argument, f"[{listed}]", f"has a unit on only some of its numbers; give {bare[0]} one too, or none to all")
        return type(value)(in_si(item, argument) if _has_unit(item) else item for item in value)
    return value


# ---- signatures

class _Annotation(str):
    """An annotation as a text, which inspect shows without quotes."""

    def __repr__(self) -> str:
        return self.replace("salebra.", "")


def _annotation(text: Any) -> Any:
    return text if text is inspect.Parameter.empty else _Annotation(text)


def _signature(text: str, _documentation: str | None, *defaults: Any) -> inspect.Signature:
    source = re.sub(r"\\(\d+)", r"_defaults[\1]", text) + ": ..."
    names: dict[str, Any] = {"_defaults": defaults[0] if defaults else ()}
    code = compile(re.sub(r"def \w+\(", "def _(", source), "<signature>", "exec", flags=__future__.annotations.compiler_flag)
    exec(code, names)  # the extension wrote this text
    bare = inspect.signature(names["_"])
    parameters = [value.replace(annotation=_annotation(value.annotation)) for value in bare.parameters.values()]
    return bare.replace(parameters=parameters, return_annotation=_annotation(bare.return_annotation))


class _Signatures:
    """The signatures of a function, one for each overload. They are made on request: a script needs few of hundreds. inspect finds
    the first as `__wrapped__` of a function, or as `__signature__` of a class."""

    def __init__(self, native: Any, method: bool) -> None:
        self._native = native
        self._method = method

    @functools.cached_property
    def all(self) -> list[inspect.Signature]:
        return [_signature(*overload) for overload in self._native.__nb_signature__]

    @functools.cached_property
    def parameters(self) -> list[dict[str, inspect.Parameter]]:
        """The parameters of each overload, without self."""
        return [dict(list(signature.parameters.items())[self._method :]) for signature in self.all]

    @property
    def __signature__(self) -> inspect.Signature:
        return self.all[0]

    def __get__(self, made: Any, kind: type) -> inspect.Signature:
        return inspect.Signature(list(self.parameters[0].values()))

    def __call__(self, *arguments: Any, **keywords: Any) -> Any:
        return self._native(*arguments, **keywords)


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


# ---- calls that the extension refused

def _is_list(value: Any) -> bool:
    return hasattr(value, "__len__") and not isinstance(value, str)


# The first characters of an annotation, how messages name the type, and which values it may accept.
_KINDS: dict[str, tuple[str, Callable[[Any], bool]]] = {
    "float": ("a number", lambda value: hasattr(value, "__float__") and np.ndim(value) == 0),
    "int": ("a whole number", lambda value: hasattr(value, "__index__") and np.ndim(value) == 0),
    "bool": ("True or False", lambda value: isinstance(value, (bool, np.bool_))),
    "str": ("a text", lambda value: isinstance(value, str)),
    "os.PathLike": ("a path", lambda value: hasattr(value, "__fspath__")),
    "mpi4py.MPI": ("a communicator of mpi4py", lambda value: hasattr(value, "py2f")),
    "collections.abc.Callable": ("a function", callable),
    "collections.abc.Sequence": ("a list", _is_list), "list": ("a list", _is_list), "tuple": ("a tuple", _is_list),
    "numpy.typing.ArrayLike": ("an array of numbers", lambda value: value is not None),
}  # fmt: skip
_HINTS = {
    "Surface": "make one with salebra.Surface(heights, size_x, size_y)",
    "Material": "make one with salebra.Material(contact_modulus, poisson=…)",
    "Grid2D": "make one with salebra.Grid2D(nx, ny, lx, ly)",
}
# Arrays over the grid; every other array has one dimension.
_FIELDS = {"heights", "initial_pressure", "contact", "pressure"}


def _kind(part: str) -> tuple[str, Callable[[Any], bool]]:
    """How messages name one alternative of an annotation, and which values it may accept."""
    if part.startswith("typing.Literal["):
        return "one of " + part[len("typing.Literal[") : -1], _KINDS["str"][1]
    for beginning, kind in _KINDS.items():
        if part.startswith(beginning):
            return kind
    name = part.rsplit(".", 1)[-1]
    return f"{'an' if name[0] in 'AEIOU' else 'a'} {name}", lambda value: isinstance(value, getattr(_core, name, object))


def _wanted(annotation: str) -> str:
    return " or ".join(dict.fromkeys(_kind(part)[0] for part in _parts(annotation) if part != "None"))


def _got(value: Any) -> str:
    if isinstance(value, np.ndarray):
        return f"an array of shape {value.shape} and type {value.dtype}"
    if isinstance(value, (str, int, float, bool)) or value is None:
        return repr(value)
    kind = type(value)
    return f"a {kind.__name__}" if kind.__module__ == "builtins" else f"{kind.__module__.split('.')[0]}.{kind.__name__}"


FORMER = {  # names of version 1.0: classes, functions, keywords, attributes
    "Condition": "AssumptionVerdict", "ContactFacts": "ContactParameters", "ContactLevels": "ContactSets",
    "LargestMotion": "MaxMotion", "LawLevels": "LawSprings", "LevelQuadratureResult": "IntervalQuadratureResult",
    "LossWithSlip": "Loss", "Premise": "Assumption", "Premises": "Assumptions", "StudyAnswer": "StudySolution",
    "StudyFlag": "EnsembleWarning", "SurfaceDamping": "DampingResult",
    "boundary_element_levels": "boundary_element_contact_sets", "level_quadrature": "interval_quadrature",
    "premises_of": "assumptions_of",
    "condition": "assumption", "conditions": "verdicts", "contact_levels": "contact_sets", "facts": "parameters",
    "flags": "ensemble_warnings", "largest_amplitude": "max_amplitude",
    "largest_angular_frequency": "max_angular_frequency", "largest_motion": "max_motion",
    "largest_pressure": "max_pressure", "largest_radius": "max_radius", "largest_spot_area": "max_spot_area",
    "largest_spot_share": "max_spot_share", "largest_tension": "max_tension", "level": "spring_depth",
    "levels": "intervals or springs or contact_sets", "most_cycles": "max_cycles", "notes": "warnings", "premises": "assumptions",
    "answer": "solution", "answer_of": "solution_of", "contacts_least": "min_contacts", "contacts_most": "max_contacts",
    "decay_length_closest": "decay_length_at_min_gap", "decay_length_farthest": "decay_length_at_max_gap",
    "full_stick_work": "work_per_cycle_without_slip", "ladder_count": "multilevel_count",
    "law_off_closest": "law_off_at_min_gap", "law_off_farthest": "law_off_at_max_gap", "level_error": "interval_error",
    "needs": "unknown", "scatter": "noise", "scatter_error": "noise_error",
    "work_with_slip_error": "work_per_cycle_error",
    "slip_of_closed_levels": "slip_of_closed_springs", "slip_of_opening_levels": "slip_of_opening_springs",
    "smallest_force": "min_force", "work_by_levels": "work_by_intervals",
}  # fmt: skip


def _attribute(own: Callable[[Any, str], Any] | None) -> Callable[[Any, str], Any]:
    """A __getattr__ that tries the one of the class, if it has one, and names the present name of a former one."""

    def attribute(self: Any, name: str) -> Any:
        missing = f"'{type(self).__name__}' object has no attribute '{name}'"
        try:
            if own:
                return own(self, name)
        except AttributeError as error:
            missing = str(error)
        here = [now for now in FORMER.get(name, "").split(" or ") if now and hasattr(type(self), now)]
        former = f"; {name} is now {here[0]}" if here else ""
        raise AttributeError(missing + former, name=name, obj=self)

    return attribute


def _bound(parameters: Mapping[str, inspect.Parameter], arguments: tuple[Any, ...], keywords: dict[str, Any]) -> dict[str, Any]:
    """The arguments by name. Raises TypeError for arguments that no parameter accepts and for missing ones."""
    positional = [name for name, parameter in parameters.items() if parameter.kind is not parameter.KEYWORD_ONLY]
    if len(arguments) > len(positional):
        rest = ", ".join(name for name in parameters if name not in positional)
        advice = f"; give what follows by name: {rest}" if rest else ""
        raise TypeError(f"{len(arguments)} arguments, at most {len(positional)} go by place ({', '.join(positional)}){advice}")
    bound = dict(zip(positional, arguments))
    for key in keywords:
        if key not in parameters:
            former = [name for name in FORMER.get(key, "").split(" or ") if name in parameters]
            close = former or difflib.get_close_matches(key, parameters, 1, 0.5)
            raise TypeError(f"no argument {key}; " + (f"did you mean {close[0]}?" if close else f"it takes {', '.join(parameters)}"))
        if key in bound:
            raise TypeError(f"{key} was given twice, by its place and by its name")
    bound |= keywords
    for name, parameter in parameters.items():
        if name not in bound and parameter.default is parameter.empty:
            raise TypeError(f"{name} is missing; give {_wanted(parameter.annotation)}")
    return bound


def _checked(parameter: inspect.Parameter, value: Any, beside_material: bool) -> Any:
    """The value, converted if it is a text with a unit. Raises TypeError "name: wanted …, got …"."""
    if value is parameter.default:
        return value
    name, annotation = parameter.name, str(parameter.annotation)
    value = _from_text(value, name, annotation)
    parts = _parts(annotation)
    if "numpy.typing.ArrayLike" in parts and value is not None:
        _check_array(name, value, 2 if name in _FIELDS and not (name == "pressure" and beside_material) else 1)
    elif not any(value is None if part == "None" else _kind(part)[1](value) for part in parts):
        hint = next((f"; {_HINTS[part.rsplit('.', 1)[-1]]}" for part in parts if part.rsplit(".", 1)[-1] in _HINTS), "")
        raise TypeError(f"{name}: wanted {_wanted(annotation)}, got {_got(value)}{hint}")
    return value


def _check_array(name: str, value: Any, dimensions: int) -> None:
    try:
        array = np.asarray(value)
        array = array if array.dtype.kind == "c" else array.astype(float)
    except (TypeError, ValueError):
        raise TypeError(f"{name}: wanted an array of numbers, got {_got(value)}") from None
    if array.dtype.kind == "c":
        raise TypeError(f"{name}: wanted real numbers, got {_got(value)}; take its .real")
    if array.ndim > dimensions or array.ndim < dimensions == 2:
        wanted = "two dimensions (nx, ny)" if dimensions == 2 else "one dimension"
        raise TypeError(f"{name}: wanted {wanted}, got shape {array.shape}")


def _refused(error: TypeError) -> bool:
    return "incompatible function arguments" in str(error)


def _once_more(
    native: Callable[..., Any], name: str, overloads: list[dict[str, inspect.Parameter]], arguments: tuple[Any, ...],
    keywords: dict[str, Any], error: TypeError,
) -> Any:  # fmt: skip
    """Calls the first overload that accepts the converted arguments. If there is none, raises the error of the first overload."""
    refusals = []
    for parameters in overloads:
        try:
            bound = _bound(parameters, arguments, keywords)
            checked = {key: _checked(parameters[key], value, "material" in parameters) for key, value in bound.items()}
        except TypeError as wrong:
            refusals.append(str(wrong))
            continue
        if any(checked[key] is not bound[key] for key in bound):
            return native(**checked)
        refusals.append(str(error).split("\n")[0])
    raise TypeError(f"{name}: {refusals[0]}") from None


# ---- after a call

def _missing_file(error: Exception, parameters: Mapping[str, inspect.Parameter], arguments: Mapping[str, Any]) -> None:
    """Raises MissingFile in place of an error about a file that does not exist."""
    for name, value in arguments.items():
        if name not in parameters or "PathLike" not in str(parameters[name].annotation) or not isinstance(value, (str, os.PathLike)):
            continue
        path = os.fspath(value)
        can_be_written = "overwrite" in parameters and os.path.isdir(os.path.dirname(path) or ".")
        if path and not os.path.exists(path) and not can_be_written and os.path.basename(path) in str(error):
            missing = MissingFile(str(error))
            missing.__dict__.update(error.__dict__)
            missing.filename, missing.errno = path, errno.ENOENT
            raise missing from None


def _warn(name: str, signatures: _Signatures, result: Any) -> None:
    """Warns about a result that did not converge."""
    converged = getattr(result, "converged", True)
    if converged is True or getattr(result, "termination", None) == "interrupted":
        return
    if isinstance(converged, np.ndarray) and not converged.all():
        what = f"{np.count_nonzero(~converged)} of {converged.size} samples did not converge; they are marked"
    elif converged is False:
        residual = getattr(result, "residual", None)
        what = "did not converge" + (f", residual {residual:.1e}" if isinstance(residual, float) else "") + "; its numbers are not an answer"
    else:
        return
    remedies = " or ".join(option for option in ("max_iterations", "tolerance") if option in signatures.parameters[0])
    warnings.warn(f"{name}: {what}" + (f". Raise {remedies}" if remedies else ""), ConvergenceWarning, stacklevel=3)


def _warn_of_pressure(name: str, result: Any, arguments: tuple[Any, ...]) -> None:
    """Warns about a contact pressed by more than a tenth of E*: as a rule a unit was forgotten."""
    if isinstance(result, _core.NormalContactState):
        pressure, modulus = result.mean_pressure, result.contact_modulus
    elif isinstance(result, _core.ForceCurve) and len(result) > 0:
        pressure = float(np.max(result.pressure))
        modulus = next((value.contact_modulus for value in arguments if isinstance(value, _core.Material)), np.inf)
    else:
        return
    warning = _core._warning_of_pressure(pressure, modulus)
    if warning:
        warnings.warn(f"{name}: {warning}", stacklevel=3)


def function(native: Any, name: str, module: str = "salebra", method: bool = False) -> Callable[..., Any]:
    """Wraps a function of the extension, which users find in the module."""
    signatures = _Signatures(native, method)

    def call(*arguments: Any, **keywords: Any) -> Any:
        try:
            result = native(*arguments, **keywords)
        except TypeError as error:
            if not _refused(error):
                raise
            here = functools.partial(native, *arguments[:method])
            result = _once_more(here, name, signatures.parameters, arguments[method:], keywords, error)
        except (_core.InvalidInput, _core.IoError) as error:
            parameters = signatures.parameters[0]
            _missing_file(error, parameters, dict(zip(parameters, arguments[method:])) | keywords)
            raise
        _warn_of_pressure(name, result, (*arguments, *keywords.values()))
        _warn(name, signatures, result)
        _remember(result, name, arguments, keywords)
        return result

    call.__name__ = name.rsplit(".", 1)[-1]
    call.__qualname__ = name
    call.__module__ = module
    call.__doc__ = native.__doc__.split("\n", 2)[-1].strip() if native.__doc__ else None
    call.__wrapped__ = signatures  # type: ignore[attr-defined]
    return call


# ---- objects

_constructors: dict[str, Callable[..., Any]] = {}


def construct(name: str, made: Any, arguments: tuple[Any, ...], keywords: dict[str, Any]) -> None:
    """The extension calls this function to make an object."""
    if name == "Surface":
        from ._results import from_xarray

        arguments, keywords = from_xarray(arguments, keywords)
    _constructors[name](made, *arguments, **keywords)
    if name == "Surface":
        warning = _core._warning_of_heights(made)
        if warning:
            warnings.warn(f"{name}: {warning}", stacklevel=2)
    _remember(made, name, arguments, keywords)


# Classes without a description: a pickle has the call that made the object, and == compares those calls.
_REMADE: tuple[type, ...] = (
    _core.ContactLaw, _core.AsperityModel, _core.Spectrum, _core.ProfileSpectrum, _core.HeightDistribution, _core.IndenterProfile,
    _core.PerssonTheory, _core.BearingCurve, _core.ContactSets, _core.ResultReader,
)  # fmt: skip


def _remember(made: Any, name: str, arguments: tuple[Any, ...], keywords: dict[str, Any]) -> None:
    def kept(value: Any) -> Any:
        return value.copy() if isinstance(value, np.ndarray) else value

    if isinstance(made, _REMADE) and type(made).__dictoffset__:
        made.__dict__.setdefault("_call", (name, tuple(map(kept, arguments)), {key: kept(value) for key, value in keywords.items()}))


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
    """The hash of the function and of the arguments that are numbers or texts, so that equal objects have equal hashes."""
    if "_call" not in self.__dict__:
        return object.__hash__(self)
    name, arguments, keywords = self.__dict__["_call"]
    return hash((name, *(value for value in (*arguments, *map(keywords.get, sorted(keywords))) if isinstance(value, (str, int, float, np.generic)))))


def _answer_class(kind: Any) -> None:
    """Replaces constructor and methods of a class of the extension by wrappers, and adds pickle, == and repr."""
    own = vars(kind)
    name = kind.__name__
    if type(own.get("__init__")).__name__ == "nb_method":
        kind.__signature__ = _Signatures(own["__init__"], method=True)
        _constructors[name] = function(own["__init__"], name, method=True)
        _core._answer_constructor(kind, name)
    for key, value in list(own.items()):
        if key.startswith("_"):
            continue
        if type(value).__name__ == "nb_method":
            setattr(kind, key, function(value, f"{name}.{key}", method=True))
        elif type(value).__name__ == "nb_func":
            setattr(kind, key, staticmethod(function(value, f"{name}.{key}")))
        elif isinstance(value, property) and value.__doc__:  # without a text, nanobind names the type by its first module
            value.__doc__ = value.__doc__.replace("salebra._core.", "salebra.").replace("salebra._figures.", "salebra.figures.")
    if issubclass(kind, _REMADE):
        kind.__reduce__, kind.__eq__, kind.__hash__ = _reduce, _equal, _hash_of_call
    elif "__eq__" in own and "__hash__" not in own:
        kind.__hash__ = None if name in ("Surface", "NonGaussianSurface") else _hash
    kind.__getattr__ = _attribute(own.get("__getattr__"))
    if "__repr__" not in own:
        kind.__repr__ = _show.text
    kind._repr_html_ = _show.html


def answer() -> None:
    """Wraps the whole extension. The package calls this once, when it is imported."""
    # Signatures, documentation, messages and pickles show the module of a class: it is set before they are made.
    for kind in [*vars(_core).values(), MissingFile, ConvergenceWarning]:
        if isinstance(kind, type):
            kind.__module__ = "salebra"
    for kind in vars(_core._figures).values():
        if isinstance(kind, type):
            kind.__module__ = "salebra.figures"
    for module, public in ((_core, "salebra"), (_core._closed_form, "salebra.closed_form"), (_core._figures, "salebra.figures")):
        for name, value in list(vars(module).items()):
            if name.startswith("_"):
                continue
            if type(value).__name__ == "nb_func":
                setattr(module, name, function(value, name, public))
            elif isinstance(value, type) and not issubclass(value, BaseException):
                _answer_class(value)
