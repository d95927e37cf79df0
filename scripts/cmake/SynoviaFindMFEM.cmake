# Finds an MFEM that has what Synovia needs, or says what is missing.
#
# MFEM_DIR, as a variable of CMake or of the environment, is the prefix of an
# installed MFEM, the directory of its MFEMConfig.cmake, or that where make built
# it.
include("${CMAKE_CURRENT_LIST_DIR}/SynoviaMFEMFromMake.cmake")
set(synovia_mfem_dir "${MFEM_DIR}")
if(NOT synovia_mfem_dir)
  set(synovia_mfem_dir "$ENV{MFEM_DIR}")
endif()
# What was asked for comes before what else is installed.
if(synovia_mfem_dir)
  find_package(MFEM 4.9 CONFIG QUIET PATHS "${synovia_mfem_dir}"
    NO_DEFAULT_PATH)
endif()
if(NOT MFEM_FOUND)
  synovia_find_mfem_from_make("${synovia_mfem_dir}")
  if(MFEM_FOUND)
    # find_package() has replaced it by what it didn't find.
    set(MFEM_DIR "${synovia_mfem_dir}" CACHE PATH "Where MFEM is" FORCE)
  elseif(NOT synovia_mfem_dir)
    find_package(MFEM 4.9 CONFIG QUIET)
  endif()
endif()
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
