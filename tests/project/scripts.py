# SPDX-License-Identifier: GPL-3.0-or-later
"""What the scripts do on systems that this one is not: scripts.py ROOT SCRATCH

Programs that install, compile or make root file systems are imitated: each notes how it was called, and does no more.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT, SCRATCH = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
SYSTEM = ("apt-get", "apt-cache", "dpkg-query", "sudo", "ccache")
faults = []


def expect(holds, what):
    if not holds:
        faults.append(what)


class Machine:
    """A checkout of the scripts, and a PATH of this system's programs without those that install or are imitated."""

    def __init__(self, name):
        self.tree = SCRATCH / name / "tree"
        self.programs = SCRATCH / name / "programs"
        self.calls_file = SCRATCH / name / "calls"
        shutil.copytree(ROOT / "scripts", self.tree / "scripts")
        self.programs.mkdir()
        for folder in os.environ["PATH"].split(":"):
            for program in pathlib.Path(folder).glob("*") if folder else []:
                link = self.programs / program.name
                if program.name not in SYSTEM and not link.is_symlink() and os.access(program, os.X_OK):
                    link.symlink_to(program)

    def imitate(self, name, script=""):
        path = self.programs / name
        path.unlink(missing_ok=True)
        path.write_text(f'#!/bin/bash\necho "{name} $*" >>"{self.calls_file}"\n{script}\n')
        path.chmod(0o755)

    def calls(self):
        return self.calls_file.read_text() if self.calls_file.exists() else ""

    def run(self, script, *arguments, **environment):
        return subprocess.run([self.tree / "scripts" / script, *arguments], capture_output=True, text=True,
                              env={"PATH": str(self.programs), "HOME": str(SCRATCH), "LANG": "C.UTF-8", **environment})


def debian(name):
    """A machine on which nothing is installed, and whose apt-get says what it would do."""
    machine = Machine(name)
    machine.imitate("id", "echo 0")
    machine.imitate("dpkg-query", "exit 1")
    machine.imitate("npm", "exit 127")
    machine.programs.joinpath("npm").unlink()
    machine.imitate("python3", "exit 1")
    # With more lines than a pipe holds.
    machine.imitate("apt-cache", '''[[ $2 == chromium ]] && echo "  Candidate: (none)" && exit
echo "  Candidate: 1.0"
for line in {1..2000}; do echo "  a line of the version table, which nobody may stop reading" || exit 1; done''')
    machine.imitate("apt-get", '''if [[ " $* " == *" --assume-no "* ]]; then
  echo "0 upgraded, 147 newly installed, 0 to remove and 3 not upgraded."
  echo "Need to get 128 MB of archives."
  echo "After this operation, 502 MB of additional disk space will be used."
  exit 1
fi''')
    return machine


shutil.rmtree(SCRATCH, ignore_errors=True)

# Without apt: once, and on.
other = Machine("other")
for arguments in ([], ["tests"], ["build", "report"]):
    run = other.run("install-dependencies", *arguments)
    expect(run.returncode == 0 and run.stderr.count("\n") == 1 and "no apt" in run.stderr and not run.stdout,
           f"without apt, install-dependencies {arguments} ends with {run.returncode}: {run.stderr}")
other.imitate("cmake")
other.imitate("python3", "exit 1")
run = other.run("build", "--target", "salebra_program")
expect(run.returncode == 0 and run.stderr.count("no apt") == 1, f"without apt, build ends with {run.returncode}: {run.stderr}")

# A new tree is without tests, an old one keeps what it has, one that was moved is named.
calls = other.calls()
expect("cmake --preset release -D SALEBRA_BUILD_TESTS=OFF\n" in calls and "cmake --build --preset release --target salebra_program" in calls,
       f"build in a new tree calls\n{calls}")
cache = other.tree / "build/release/CMakeCache.txt"
cache.parent.mkdir(parents=True)
cache.write_text(f"CMAKE_HOME_DIRECTORY:INTERNAL={other.tree}\n")
other.calls_file.unlink()
other.run("build", "-D", "SALEBRA_BUILD_TESTS=ON")
expect("cmake --preset release -D SALEBRA_BUILD_TESTS=ON\n" in other.calls(), f"build with an option calls\n{other.calls()}")
cache.write_text("CMAKE_HOME_DIRECTORY:INTERNAL=/elsewhere/salebra\n")
other.calls_file.unlink()
run = other.run("build")
expect(run.returncode == 1 and "made in /elsewhere/salebra" in run.stderr and "rm -r build/release" in run.stderr and "cmake" not in other.calls(),
       f"in a moved tree, build ends with {run.returncode}: {run.stderr}\n{other.calls()}")

# What apt-get will install is said before it does.
bare = debian("bare")
run = bare.run("install-dependencies", "tests")
said = re.search(r"^Dependencies: installing 147 packages, 128 MB to fetch, 502 MB on disk, for (.*)$", run.stdout, re.MULTILINE)
expect(run.returncode == 0 and said and {"catch2", "g++", "clang", "openmpi-bin"} <= set(said[1].split()),
       f"install-dependencies tests ends with {run.returncode} and says\n{run.stdout}{run.stderr}")
expect("doing without chromium, of which this system has no package" in run.stderr and "chromium" not in bare.calls().split("--assume-no")[-1],
       f"a package that the system lacks: {run.stderr}")
expect(re.search(r"--yes .*catch2.*\n.*--yes .*clang", bare.calls()), f"what is needed is not installed first:\n{bare.calls()}")
bare.calls_file.unlink()
run = bare.run("install-dependencies", "tests", "--without", "browser", "--without", "mpi")
expect(run.returncode == 0 and not re.search("openmpi|npm|chromium", bare.calls()), f"--without browser and mpi: {run.stderr}\n{bare.calls()}")
expect(bare.run("install-dependencies", "--without", "bread").returncode == 2, "install-dependencies --without bread is not refused")
bare.calls_file.unlink()
run = bare.run("install-dependencies")
expect("catch2" not in bare.calls(), f"a build without tests installs Catch2:\n{bare.calls()}")
# What some tests alone need may fail.
bare.imitate("apt-get", '[[ " $* " != *" --yes "*clang* ]]')
run = bare.run("install-dependencies", "tests")
expect(run.returncode == 0 and "doing without" in run.stderr, f"where clang cannot be installed: {run.returncode}: {run.stderr}")
bare.imitate("apt-get", '[[ " $* " != *" --yes "*catch2* ]]')
expect(bare.run("install-dependencies", "tests").returncode != 0, "where Catch2 cannot be installed, scripts/test goes on")

# Packages are made beside the tree of whoever develops.
maker = Machine("maker")
for name in ("cmake", "mpicc", "python3"):
    maker.imitate(name)
maker.imitate("cpack", 'echo "CPack: - package: $4/salebra_1_amd64.deb generated."')
run = maker.run("package")
expect(run.returncode == 0 and "package: build/package/salebra_1_amd64.deb" in run.stdout, f"package ends with {run.returncode}: {run.stdout}{run.stderr}")
expect("--preset package" in maker.calls() and "release" not in maker.calls(), f"package calls\n{maker.calls()}")

# What is left out of the tests, and what makes a warning an error.
tester = Machine("tester")
for name in ("cmake", "ctest", "python3", "mpicc", "npm"):
    tester.imitate(name)
run = tester.run("test", "--without", "mpi", "--strict", "--without", "browser", "-R", "contact")
configured = [line for line in tester.calls().splitlines() if line.startswith("cmake --preset")]
expect(run.returncode == 0 and configured and all(" SALEBRA_BUILD_TESTS=ON " in f"{line} " and "CMAKE_COMPILE_WARNING_AS_ERROR=ON" in line
                                                  and line.rindex("MPI=OFF") > line.rfind("MPI=ON") for line in configured),
       f"test ends with {run.returncode}: {run.stderr}\n{tester.calls()}")
expect(re.search("^ctest .* -R contact$", tester.calls(), re.MULTILINE) and "npm ci --prefix tests/report" not in tester.calls(), f"test calls\n{tester.calls()}")
expect(run.stderr.count("no apt") == 1, f"without apt, test says\n{run.stderr}")

# A bare machine of each suite: each phase is printed and logged, also after one that fails.
for suite, mirror in (("bookworm", "debian"), ("trixie", "debian"), ("noble", "ubuntu")):
    host = Machine(f"host-{suite}")
    host.imitate("id", "echo 0")
    host.imitate("mmdebstrap", 'root=${@: -2:1}; mkdir -p "$root"/etc/sudoers.d "$root"/usr/local/share/ca-certificates; echo made')
    host.imitate("chroot", 'case "$*" in *scripts/quickstart*) echo quick; exit 3 ;; *scripts/test*) echo tested ;; esac')
    for name in ("mount", "umount", "git"):
        host.imitate(name)
    root, keys = SCRATCH / f"host-{suite}/root", SCRATCH / "keys"
    keys.touch()
    run = host.run("bare-machine", root, SUITE=suite, PHASES="root", KEYRING=str(keys))
    phases = re.findall(r"^(\S.*?) +\d+ s by the clock, +\d+ s of processor, status (\d+)$", run.stdout, re.MULTILINE)
    expect(phases == [(f"minimal {suite}", "0"), ("clone as root", "0"), ("quickstart as root", "3"), ("test as root", "0")] and run.returncode == 1,
           f"bare-machine of {suite} ends with {run.returncode} and prints\n{run.stdout}{run.stderr}")
    logs = {path.name: path.read_text() for path in (host.tree / f"out/bare-machine-{suite}").glob("*.log")}
    expect(logs.get("quickstart-as-root.log") == "quick\n" and logs.get("test-as-root.log") == "tested\n" and len(logs) == 4,
           f"bare-machine of {suite} keeps the logs {logs}")
    expect(re.search(rf"mmdebstrap .*{suite} {root} http://\S+/{mirror}\n", host.calls()) and f"mount --rbind --make-rslave /sys {root}/sys" in host.calls(),
           f"bare-machine of {suite} calls\n{host.calls()}")
run = host.run("bare-machine", SUITE="woody")
expect(run.returncode == 1 and "no SUITE=woody" in run.stderr, f"bare-machine of woody: {run.stderr}")

print("\n".join(faults) or "the scripts do what they say")
sys.exit(1 if faults else 0)
