"""Synovia for Spack, from the directory of the sources:

    spack repo add scripts/packaging/spack_repo/synovia
    spack dev-build synovia@0.1.0
"""

from spack_repo.builtin.build_systems.cmake import CMakePackage

from spack.package import *


class Synovia(CMakePackage):
    """Contact of biphasic soft tissues (cartilage, meniscus, joints), on MFEM."""

    license("BSD-3-Clause")

    version("0.1.0")

    variant("shared", default=True, description="Build a shared library")
    variant("python", default=False,
            description="Python modules of meshes, reports and plots")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.21:", type="build")
    # CMake reads the config.mk of an MFEM that was built with make.
    depends_on("gmake", type="build")
    depends_on("mpi")
    depends_on("mfem@4.9: +shared +mpi +metis +mumps +lapack precision=double")
    depends_on("mumps +double +float +metis")
    depends_on("hdf5 +mpi")
    depends_on("pugixml")
    depends_on("tomlplusplus@3.1:", type="build")
    with when("+python"):
        depends_on("python@3.11:", type="run")
        depends_on("py-gmsh", type="run")
        depends_on("py-h5py", type="run")
        depends_on("py-matplotlib", type="run")
        depends_on("py-nibabel", type="run")
        depends_on("py-numpy", type="run")
        depends_on("py-pynrrd", type="run")
        depends_on("py-pyvista", type="run")
        depends_on("py-scipy", type="run")

    def cmake_args(self):
        return [
            self.define("MFEM_DIR", self.spec["mfem"].prefix),
            self.define("SYNOVIA_BUILD_TESTS", False),
            self.define_from_variant("BUILD_SHARED_LIBS", "shared"),
        ]
