# SPDX-License-Identifier: GPL-3.0-or-later
"""Spack package. Not run; see packaging/README.md. In a checkout of salebra:

spack repo create my-repo && mkdir -p my-repo/packages/salebra && cp packaging/spack/package.py my-repo/packages/salebra/
spack repo add my-repo && spack dev-build salebra@0.1.0
"""

from spack.package import *


class Salebra(CMakePackage):
    """Statistics of rough-surface contact and its relaxation damping."""

    license("GPL-3.0-or-later")
    version("0.1.0")

    variant("mpi", default=False, description="salebra-mpi: one surface over many processes")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("eigen@3.4:")
    depends_on("fftw@3.3: precision=double,float")
    depends_on("fmt")
    depends_on("gsl@2.7:")
    depends_on("hdf5@1.10:+hl~mpi")
    depends_on("libzip")
    depends_on("zlib-api")
    depends_on("pugixml")
    depends_on("random123", type="build")
    depends_on("tomlplusplus")
    depends_on("nlohmann-json", type="build")
    depends_on("cli11", type="build")
    depends_on("gnuplot", type="run")
    depends_on("mpi@3:", when="+mpi")

    generator("ninja")

    def cmake_args(self):
        return [
            self.define("SALEBRA_BUILD_TESTS", False),
            self.define("SALEBRA_BUILD_EXAMPLES", False),
            self.define_from_variant("SALEBRA_BUILD_MPI", "mpi"),
            self.define("RANDOM123_INCLUDE_DIR", self.spec["random123"].prefix.include),
        ]
