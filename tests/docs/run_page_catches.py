# SPDX-License-Identifier: GPL-3.0-or-later
"""run_page_catches.py --program FILE: run_page.py must pass a page that is right and refuse each of these that are not."""

import pathlib
import subprocess
import sys
import tempfile

here = pathlib.Path(__file__).resolve().parent
RIGHT = """# A page
```console
$ echo "value  1.2345 nm"
value 1.2346 nm
$ printf 'a\\nb\\nc\\nd\\n'
a
…
d
$ for n in 1 2; do
>   echo "number $n of …"
> done
number 1 …
number 2 …
$ test -e seen && echo again || { touch seen; echo first; }
first
$ test -e seen && echo again || { touch seen; echo first; }
again
```
```sh
test -e data/README.md
```
<!-- not run: it would fail -->
```sh
false
```
<!-- file: made.toml -->
```toml
key = 1
```
```sh
grep key made.toml
```
```python
import pathlib
text = pathlib.Path("made.toml").read_text()
```
<!-- long: a night -->
```python
raise SystemExit("left out")
```
```python
assert "key" in text
```
"""
WRONG = {
    "a command that fails": "```sh\nfalse\n```\n",
    "a command that fails in a pipe": "```sh\nfalse | cat\n```\n",
    "another number": "```console\n$ echo 1.2345 nm\n1.2348 nm\n```\n",
    "another unit": "```console\n$ echo 1.2345 nm\n1.2345 um\n```\n",
    "a line too many": "```console\n$ printf 'a\\nb\\n'\na\n```\n",
    "a line too few": "```console\n$ printf 'a\\n'\na\nb\n```\n",
    "an option that is not there": "```sh\nsalebra statistics --no-such-option data/surfaces/afm-scan.txt\n```\n",
    "a block without a language": "```\ntrue\n```\n",
    "C++ that is in no example": "```cpp\nint in_no_example();\n```\n",
    "a Python block that fails": "```python\nassert 1 == 2\n```\n",
    "a Python block that needs a later one": "```python\nprint(later)\n```\n```python\nlater = 1\n```\n",
    "a key that is in no study file": "```toml\nno_such_key = 1\n```\n",
}

with tempfile.TemporaryDirectory() as folder:
    folder = pathlib.Path(folder)

    def status(*texts):
        pages = [folder / f"page{number}.md" for number in range(len(texts))]
        for page, text in zip(pages, texts):
            page.write_text(text)
        done = subprocess.run([sys.executable, here / "run_page.py", *pages, *sys.argv[1:], "--scratch", folder / "scratch",
                               "--python", sys.executable],
                              capture_output=True, text=True)
        return done.returncode, done.stdout + done.stderr

    code, said = status(RIGHT)
    if code != 0:
        sys.exit(f"a right page is refused: {said}")
    for fault, text in WRONG.items():
        code, said = status(text)
        if code != 1 or 'run_page.py", line' in said:
            sys.exit(f"{fault} is not caught: status {code}, {said}")
    # What a page ran, the next one compares and does not run again.
    first = "```console\n$ test -e seen && echo again || { touch seen; echo first; }\nfirst\n```\n"
    for pages, expected in (((first, first), 0), ((first, first.replace("\nfirst\n", "\nagain\n")), 1)):
        code, said = status(*pages)
        if code != expected:
            sys.exit(f"two pages with one command end with {code}, not {expected}: {said}")
print(f"{len(WRONG)} faults are caught")
