# Finds an MFEM that has what Synovia needs, or says what is missing.
#
# MFEM_DIR, as a variable of CMake or of the environment, is the prefix of an
# installed MFEM or the directory of its MFEMConfig.cmake.
find_package(MFEM 4.9 CONFIG QUIET HINTS "${MFEM_DIR}")
if(NOT MFEM_FOUND)
  set(reason "")
  foreach(config version IN ZIP_LISTS MFEM_CONSIDERED_CONFIGS
          MFEM_CONSIDERED_VERSIONS)
    string(APPEND reason "\n  Found but not used: ${config} (${version})")
  endforeach()
  message(FATAL_ERROR "MFEM >= 4.9 was not found.${reason}\n"
    "Pass -DMFEM_DIR=<prefix of an installed MFEM>, or run scripts/setup, "
    "which builds one into ~/.cache/synovia.")
endif()

foreach(feature MPI METIS)
  if(NOT MFEM_USE_${feature})
    message(FATAL_ERROR "The MFEM in ${MFEM_DIR} was built without ${feature}. "
      "Build it with -DMFEM_USE_${feature}=ON, or run scripts/setup and use "
      "the one that it builds.")
  endif()
endforeach()
if(NOT MFEM_USE_MUMPS AND NOT MFEM_USE_SUITESPARSE)
  message(FATAL_ERROR "The MFEM in ${MFEM_DIR} has no direct solver. Build it "
    "with -DMFEM_USE_MUMPS=ON, or, which does for one rank, with "
    "-DMFEM_USE_SUITESPARSE=ON, or run scripts/setup and use the one that it "
    "builds.")
endif()
if(MFEM_USE_SINGLE)
  message(FATAL_ERROR "The MFEM in ${MFEM_DIR} is of single precision; "
    "Synovia needs double.")
endif()
