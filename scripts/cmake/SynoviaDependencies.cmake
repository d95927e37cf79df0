# What Synovia needs besides MFEM, found here for the build and, installed
# beside synoviaConfig.cmake, for the projects that use it.

# FindHDF5 asks the C compiler. A project that uses Synovia may be C++ only.
if(NOT CMAKE_C_COMPILER_LOADED)
  enable_language(C)
endif()

find_package(MPI QUIET COMPONENTS C CXX)
if(NOT MPI_FOUND)
  message(FATAL_ERROR "MPI for C and C++ was not found. Install it (Debian: "
    "libopenmpi-dev openmpi-bin), or pass -DMPI_HOME=<prefix>.")
endif()

set(HDF5_PREFER_PARALLEL ON)
find_package(HDF5 QUIET COMPONENTS C)
if(NOT HDF5_FOUND OR NOT HDF5_IS_PARALLEL)
  message(FATAL_ERROR "HDF5 with MPI was not found. Install it (Debian: "
    "libhdf5-openmpi-dev), or pass -DHDF5_ROOT=<prefix>.")
endif()
if(NOT TARGET synovia::hdf5)
  add_library(synovia::hdf5 INTERFACE IMPORTED)
  target_include_directories(synovia::hdf5 INTERFACE ${HDF5_C_INCLUDE_DIRS})
  target_compile_definitions(synovia::hdf5 INTERFACE ${HDF5_C_DEFINITIONS})
  target_link_libraries(synovia::hdf5 INTERFACE ${HDF5_C_LIBRARIES})
endif()

find_package(pugixml QUIET CONFIG)
if(NOT pugixml_FOUND)
  message(FATAL_ERROR "pugixml, which reads models of FEBio, was not found. "
    "Install it (Debian: libpugixml-dev), or pass -Dpugixml_DIR=<prefix>/lib/"
    "cmake/pugixml.")
endif()
