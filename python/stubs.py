# SPDX-License-Identifier: GPL-3.0-or-later
"""stubs.py MADE STUB: the stub of the extension with arguments that take texts with units where they take numbers (salebra/_calls.py)."""

import re
import sys
from pathlib import Path


def with_texts(line: str) -> str:
    signature = re.match(r"(\s*def \w+\()(.*)(\) -> .*)$", line, re.DOTALL)
    if signature is None:
        return line
    # A function that is an argument is given numbers and returns numbers.
    arguments = re.sub(r"(Callable\[\[.*?\], [\w.\[\], ]+\])|\bfloat\b(?!\()", lambda found: found[1] or "_Quantity", signature[2])
    arguments = re.sub(r"\bMaterial(?=[,)]|$)", "Material | str", arguments)
    return signature[1] + arguments + signature[3]


made, stub = map(Path, sys.argv[1:])
text = "".join(map(with_texts, made.read_text(encoding="utf-8").splitlines(keepends=True)))
text = re.sub(r"^(class |@overload|def )", r"_Quantity = float | str  # a number in SI units, or a text with a unit\n\n\1", text, count=1, flags=re.MULTILINE)
# Oscillations take the frequency in Hz too (_calls.py).
text = re.sub(
    r"(def __init__\(self, [^\n]*)(?<!_)angular_frequency: _Quantity(?: = [^,)]*)?", r"\1angular_frequency: _Quantity = ..., frequency: _Quantity = ...", text
)
stub.write_text(text, encoding="utf-8")
