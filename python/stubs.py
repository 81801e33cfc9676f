# SPDX-License-Identifier: GPL-3.0-or-later
"""stubs.py MADE STUB: declares in the stub of the extension that arguments for numbers accept texts with units (salebra/_calls.py)."""

import re
import sys
from pathlib import Path


def with_texts(line: str) -> str:
    signature = re.match(r"(\s*def \w+\()(.*)(\) -> .*)$", line, re.DOTALL)
    if signature is None:
        return line
    # A function as an argument receives numbers and returns numbers.
    arguments = re.sub(r"(Callable\[\[.*?\], [\w.\[\], ]+\])|\bfloat\b(?!\()", lambda found: found[1] or "_Quantity", signature[2])
    arguments = re.sub(r"\bMaterial(?=[,)]|$)", "Material | str", arguments)
    return signature[1] + arguments + signature[3]


made, stub = map(Path, sys.argv[1:])
text = "".join(map(with_texts, made.read_text(encoding="utf-8").splitlines(keepends=True)))
text = re.sub(r"^(class |@overload|def )", r"_Quantity = float | str  # a number in SI units, or a text with a unit\n\n\1", text, count=1, flags=re.MULTILINE)
stub.write_text(text, encoding="utf-8")
