#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every program that the scripts, CMake and CPack call comes from a package of the lists in scripts/install-dependencies.

    listed_programs.py --root TREE --build TREE/build/release --scratch FOLDER

A machine of a developer has programs that no list names, a fresh one has not. Hence a folder is made of links to the programs that
the listed packages bring, with what these depend on, git and the base system, and the rest runs with that folder as its PATH. Then
one package at a time is taken away, and the same steps must fail. Exits with 77 on a system without dpkg.
"""

import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys

# What a script looks for and does without, or what a user has in place of a package: node may come from elsewhere than Debian.
# mmdebstrap: packaging/wheel/try makes small systems of other distributions, and says that it needs it.
OPTIONAL = {"ccache", "sudo", "npm", "node", "clang-format", "run-clang-tidy", "mmdebstrap"}
# Packages that are taken away to see the steps fail, with the step that must.
CATCHES = {"file": "package", "ninja-build": "configure"}


class Packages:
    """The installed packages and what each needs."""

    def __init__(self):
        self.needs, self.provides, self.base = {}, {}, {"git", "apt"}
        fields = ["db:Status-Status", "Package", "Essential", "Priority", "Provides", "Pre-Depends", "Depends"]
        query = subprocess.run(["dpkg-query", "--show", "--showformat=" + "\\t".join(f"${{{f}}}" for f in fields) + "\\n"],
                               check=True, capture_output=True, text=True).stdout
        for line in query.splitlines():
            status, name, essential, priority, provides, *needs = line.split("\t")
            if status != "installed":
                continue
            self.needs.setdefault(name, set()).update(re.findall(r"(?:^|[,|])\s*([^\s,|(:]+)", ", ".join(filter(None, needs))))
            for other in re.findall(r"(?:^|,)\s*([^\s,(]+)", provides):
                self.provides.setdefault(other, set()).add(name)
            if essential == "yes" or priority == "required":
                self.base.add(name)

    def closure(self, names):
        """Names with all that they depend on; of alternatives, each that is installed."""
        found, open_names = set(), list(names)
        while open_names:
            name = open_names.pop()
            if name in found:
                continue
            if name in self.needs:
                found.add(name)
                open_names += self.needs[name]
            open_names += self.provides.get(name, set()) - found
        return found


def programs_of(packages):
    """Real paths of the files that the packages bring."""
    listing = subprocess.run(["dpkg-query", "--listfiles", *sorted(packages)], capture_output=True, text=True).stdout
    return {os.path.realpath(line) for line in listing.splitlines() if "/bin/" in line or "/sbin/" in line or "/lib" in line}


def make_folder(folder, packages):
    """Links to every program on the PATH whose file belongs to a package; links such as c++ come from Debian's alternatives."""
    files = programs_of(packages)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for place in os.environ["PATH"].split(":"):
        for program in pathlib.Path(place).glob("*") if place else []:
            link = folder / program.name
            if not link.is_symlink() and os.path.realpath(program) in files and os.access(program, os.X_OK):
                link.symlink_to(program)


def commands_of(script):
    """Words of a shell script that stand where a command does."""
    text = re.sub(r"(?m)(^|\s)#.*$", "", script.read_text())
    text = re.sub(r"'[^']*'", "''", text)
    text = text.replace("\\\n", " ")
    text = re.sub(r'"[^"]*"', lambda words: re.sub(r"(?<!\$)\(|;", " ", words[0]), text)
    for command in re.split(r"\n|;|\|\|?|&&?|\$\(|`|<\(|\(|\{|\)", text):
        words = command.split()
        while words and (re.fullmatch(r"if|then|elif|else|while|until|do|!|exec|time|env|nice|-n|19|[A-Za-z_]\w*=\S*", words[0])):
            words.pop(0)
        if words and re.fullmatch(r"[A-Za-z][\w.+-]*", words[0]):
            yield words[0]


def steps(arguments, folder, wanted=("install", "configure", "package")):
    """What runs on the programs of a folder: the name of each wanted step and whether it works, with what it said."""
    environment = {**os.environ, "PATH": str(folder), "CMAKE_C_COMPILER_LAUNCHER": "", "CMAKE_CXX_COMPILER_LAUNCHER": ""}
    # CMake also looks where systems have their programs, whatever the PATH.
    # cpack takes its -D as a word of its own.
    only = ["-D", "CMAKE_SYSTEM_IGNORE_PATH=" + ";".join(f"{top}{name}" for top in ("/", "/usr/", "/usr/local/") for name in ("bin", "sbin"))]
    scratch = arguments.scratch
    shutil.rmtree(scratch / "tree", ignore_errors=True)
    shutil.rmtree(scratch / "package", ignore_errors=True)
    for name, command in {
            "install": [arguments.root / "scripts/install-dependencies"],
            "configure": ["cmake", "-S", arguments.root, "-B", scratch / "tree", "-G", "Ninja", *only],
            "package": ["cpack", "--config", arguments.build / "CPackConfig.cmake", "-B", scratch / "package", *only,
                        "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=none"]}.items():  # compression took five sixths of the time
        if name not in wanted:
            continue
        if not shutil.which(str(command[0]), path=str(folder)):
            yield name, False, f"no {command[0]}"
            continue
        run = subprocess.run([str(word) for word in command], env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        yield name, run.returncode == 0, run.stdout


def main():
    parser = argparse.ArgumentParser()
    for name in ("root", "build", "scratch"):
        parser.add_argument(f"--{name}", type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    if not shutil.which("dpkg-query"):
        print("skipped: no dpkg-query, this is no Debian")
        return 77
    listed = subprocess.run([arguments.root / "scripts/install-dependencies", "--list"], check=True, capture_output=True,
                            text=True).stdout.split()
    packages = Packages()
    lacking = {*CATCHES, "cmake", "g++", "dpkg-dev"} - set(packages.needs)
    if lacking:
        print("skipped: not installed:", *sorted(lacking))
        return 77
    folder, status = arguments.scratch / "programs", 0
    make_folder(folder, packages.closure(packages.base | set(listed)))

    scripts = [script for place in ("scripts", ".ci", "packaging/wheel") for script in sorted((arguments.root / place).glob("*"))
               if script.is_file() and script.read_bytes().startswith(b"#!/usr/bin/env bash")]
    for script in scripts:
        for word in sorted(set(commands_of(script))):
            if word not in OPTIONAL and shutil.which(word) and not (folder / word).exists():
                print(f"{script.relative_to(arguments.root)} calls {word}, which no list of scripts/install-dependencies brings")
                status = 1
    for name, works, said in steps(arguments, folder):
        if not works:
            print(f"{name} fails on the programs of the listed packages:\n{said}")
            status = 1
    for package, step in CATCHES.items():
        make_folder(folder, packages.closure((packages.base | set(listed)) - {package}))
        if any(works for _, works, _ in steps(arguments, folder, [step])):
            print(f"without the package {package}, the step {step} should fail")
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())
