# SPDX-License-Identifier: GPL-3.0-or-later
"""`salebra-import FILE OUT.h5` converts a file of an instrument, by SurfaceTopography, to a surface that salebra reads.

The program calls it for files of unknown format. If FILE states no size or no unit, OUT.h5 has none either, and the reader of OUT.h5 says
which option gives it.
"""

from __future__ import annotations

import argparse
import contextlib
import ctypes
import datetime
import io
import json
import os
import resource
import struct
import sys
import tempfile
import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

from ._topography import metres_in

if TYPE_CHECKING:
    from collections.abc import Sequence

INSTALL = "pip install 'salebra[formats]'"


class ImportRefusal(Exception):
    """The file cannot be read; the reason in one line."""


# The HDF5 library recognises a file by this signature at its start or at byte 512, 1024, 2048 and so on.
_HDF5_SIGNATURE = b"\x89HDF\r\n\x1a\n"


def _require_harmless(file: str) -> None:
    """Raises ImportRefusal unless the file is regular, and for HDF5, which may name other files that h5py would read."""
    if not os.path.isfile(file):
        raise ImportRefusal("does not exist, or is no regular file; check the path")
    with open(file, "rb") as stream:
        size, place = os.fstat(stream.fileno()).st_size, 0
        while place < size:
            stream.seek(place)
            if stream.read(len(_HDF5_SIGNATURE)) == _HDF5_SIGNATURE:
                raise ImportRefusal("is HDF5, which salebra reads itself and which may point at other files; store the surface as heights")
            place = 2 * place or 512


def _require_place(file: str, out: str) -> None:
    """Raises ImportRefusal if OUT is the file itself, or a device, pipe or folder that a file would replace."""
    if not os.path.lexists(out):
        return
    if not os.path.isfile(out):
        raise ImportRefusal(f"cannot be written to {out}, which is no regular file; name another file")
    if os.path.exists(file) and os.path.samefile(file, out):
        raise ImportRefusal("is the file to write too; name another file")


def _confine(file: str, out: str) -> None:
    """Restricts this process, since damaged files may exploit their reader: no other files, no core files, limited time.

    Landlock (Linux 5.13) allows only the file, the folder of OUT, and Python with its libraries. Without Landlock in the kernel, the limits
    of time and core files remain.
    """
    seconds = 60 + os.path.getsize(file) // 1_000_000
    for kind, most in ((resource.RLIMIT_CORE, 0), (resource.RLIMIT_CPU, seconds)):
        hard = resource.getrlimit(kind)[1]
        resource.setrlimit(kind, (most if hard == resource.RLIM_INFINITY else min(most, hard), hard))
    create_ruleset, add_rule, restrict_self, no_new_privileges = 444, 445, 446, 38
    execute, read_file, read_dir, everything = 1, 4, 8, (1 << 13) - 1
    libc = ctypes.CDLL(None, use_errno=True)
    ruleset = libc.syscall(create_ruleset, struct.pack("=Q", everything), 8, 0)
    if ruleset < 0:
        return
    folders = {sys.prefix, sys.base_prefix, "/usr", "/lib", "/lib64", "/sys/devices", "/proc", *(path for path in sys.path if path)}
    allowed = [(folder, execute | read_file | read_dir) for folder in folders if os.path.isdir(folder)]
    allowed += [(os.path.dirname(os.path.abspath(out)), everything), (file, read_file)]
    allowed += [(device, read_file | 2) for device in ("/dev/null", "/dev/urandom")]
    for path, rights in allowed:
        descriptor = os.open(path, os.O_PATH | os.O_CLOEXEC)
        libc.syscall(add_rule, ruleset, 1, struct.pack("=Qi", rights, descriptor), 0)
        os.close(descriptor)
    libc.prctl(no_new_privileges, 1, 0, 0, 0)
    libc.syscall(restrict_self, ruleset, 0)
    os.close(ruleset)


def _channel_of(reader: Any, wanted: str | None) -> Any:
    heights = [channel for channel in reader.channels if getattr(channel, "is_height_channel", True)]
    names = ", ".join(f"{channel.index} ({channel.name})" for channel in reader.channels)
    if wanted is None:
        default = reader.default_channel
        return default if default in heights or not heights else heights[0]
    for channel in reader.channels:
        if wanted in (str(channel.index), channel.name):
            return channel
    raise ImportRefusal(f"has no channel {wanted}; it has {names}")


def _opened(file: str) -> Any:
    try:
        from SurfaceTopography import open_topography
        from SurfaceTopography.Exceptions import CannotDetectFileFormat
    except ImportError as error:
        raise ImportRefusal(f"is of no format that salebra knows; SurfaceTopography knows forty more: {INSTALL}") from error
    try:
        # Readers that do not recognise a file print messages.
        with contextlib.redirect_stderr(io.StringIO()), contextlib.redirect_stdout(io.StringIO()):
            return open_topography(file)
    except CannotDetectFileFormat as error:
        raise ImportRefusal("is of no format that salebra or SurfaceTopography know; export it as text") from error


def _attributes(file: str, reader: Any, channel: Any, topography: Any) -> dict[str, Any]:
    import SurfaceTopography

    info = topography.info if isinstance(topography.info, dict) else {}
    known = {key: value for key, value in info.items() if key not in ("raw_metadata", "reader")}
    try:
        format_ = reader.format()
    except (AttributeError, NotImplementedError):
        format_ = type(reader).__name__
    return {
        "program": "salebra-import",
        "libraries": f"SurfaceTopography {SurfaceTopography.__version__}",
        "origin": os.path.basename(file),
        "source_format": str(format_),
        "channel": str(channel.name),
        "information": json.dumps(known, default=str, sort_keys=True),
        "created": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ"),
    }


def _read(file: str, wanted: str | None) -> tuple[np.ndarray, np.ndarray | None, dict[str, Any], list[str]]:
    """Heights, positions of a profile, attributes, and warnings."""
    reader = _opened(file)
    channel = _channel_of(reader, wanted)
    found = []
    if wanted is None and len(reader.channels) > 1:
        others = ", ".join(str(other.name) for other in reader.channels if other.index != channel.index)
        found.append(f"channel {channel.name} of several; the others are {others}")
    missing: dict[str, Any] = {}
    if channel.physical_sizes is None or any(size is None for size in np.atleast_1d(channel.physical_sizes)):
        missing["physical_sizes"] = (1.0,) * channel.dim
    topography = reader.topography(channel_index=channel.index, **missing)
    unit = topography.unit
    if unit is not None and metres_in(str(unit)) is None:
        raise ImportRefusal(f"has heights in '{unit}', which is not a unit of length; name another channel by --channel")
    factor = None if unit is None else metres_in(str(unit))
    attributes = _attributes(file, reader, channel, topography)
    heights = np.ma.filled(np.ma.asarray(topography.heights(), dtype=np.float64), np.nan)
    positions = None
    if topography.dim == 1:
        # Without a length SurfaceTopography sets the distance of points to 1.
        positions = np.asarray(topography.positions(), dtype=np.float64)
        if "physical_sizes" in missing:
            positions = None
    if factor is not None:
        # The heights of SurfaceTopography are in this unit.
        heights = heights * factor if factor != 1.0 else heights
        positions = positions * factor if positions is not None else None
        attributes["units"], attributes["source_units"] = "m", str(unit)
    sizes = topography.physical_sizes
    if "physical_sizes" not in missing:
        if factor is None:
            found.append(f"its size of {' x '.join(f'{size:g}' for size in sizes)} is without a unit, and not used")
            positions = None
        else:
            for name, size in zip(("size_x", "size_y"), sizes):
                attributes[name] = float(size) * factor
    if topography.dim == 2:
        attributes["periodic"] = int(bool(topography.is_periodic))
    return heights, positions, attributes, found


def import_surface(file: str | os.PathLike[str], out: str | os.PathLike[str], *, channel: str | int | None = None) -> list[str]:
    """Converts `file` to HDF5, which appears complete or not at all. Returns warnings. Raises ImportRefusal."""
    file, out = os.fspath(file), os.fspath(out)
    _require_harmless(file)
    _require_place(file, out)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        heights, positions, attributes, found = _read(file, None if channel is None else str(channel))
    import h5py  # type: ignore[import-untyped]  # SurfaceTopography needs it too

    folder = os.path.dirname(os.path.abspath(out))
    descriptor, temporary = tempfile.mkstemp(dir=folder, prefix=".salebra-import-", suffix=".h5")
    os.close(descriptor)
    try:
        with h5py.File(temporary, "w") as document:
            document["heights"] = np.ascontiguousarray(heights)
            if positions is not None:
                document["x"] = positions
            for name, value in attributes.items():
                document.attrs[name] = value
        os.replace(temporary, out)
    except BaseException:
        os.unlink(temporary)
        raise
    return found


def imported(file: str, out: str, channel: str = "") -> list[str]:
    """import_surface() for the extension, which reports a ValueError as a refusal."""
    try:
        return import_surface(file, out, channel=channel or None)
    except ImportRefusal as refusal:
        raise ValueError(str(refusal)) from None
    except Exception as error:
        raise ValueError(_failure(error)) from error


def _failure(error: Exception) -> str:
    return " ".join(f"SurfaceTopography cannot read it ({type(error).__name__}: {error})".split())[:500]


def main(arguments: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(
        prog="salebra-import", description="A file of an instrument as an HDF5 file that salebra reads, by SurfaceTopography."
    )
    parser.add_argument("file", help="of one of SurfaceTopography's formats")
    parser.add_argument("out", help="HDF5 file to write")
    parser.add_argument("--channel", help="number or name; default the first with heights")
    parser.add_argument("--overwrite", action="store_true", help="replace OUT")
    given = parser.parse_args(arguments)

    def say(kind: str, text: str) -> None:
        print(f"salebra-import: {kind}: {' '.join(text.split())[:500]}", file=sys.stderr)

    try:
        if os.path.exists(given.out) and not given.overwrite:
            say("error", f"{given.out}: exists; add --overwrite or name another file")
            return 2
        _require_harmless(given.file)
        _require_place(given.file, given.out)
        # Imported before _confine(), after which they could not write their caches.
        with contextlib.suppress(ImportError):
            import h5py  # noqa: F401
            import SurfaceTopography  # noqa: F401
        _confine(given.file, given.out)
        for warning in import_surface(given.file, given.out, channel=given.channel):
            say("note", f"{given.file}: {warning}")
    except ImportRefusal as refusal:
        say("error", f"{given.file}: {refusal}")
        return 2
    except OSError as error:
        say("error", f"{given.file}: {error}")
        return 1
    except Exception as error:  # a reader of SurfaceTopography may raise anything for a damaged file
        say("error", f"{given.file}: {_failure(error)}")
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
