# synovia_find_mfem_from_make(<directory>): an MFEM that was built with make has
# no MFEMConfig.cmake, but a config.mk, in <prefix>/share/mfem or, where it is
# not installed, in config/. Sets MFEM_FOUND, MFEM_VERSION, MFEM_USE_..., and
# the target mfem, as MFEMConfig.cmake would.
function(synovia_find_mfem_from_make directory)
  find_file(config_mk config.mk NO_CACHE NO_DEFAULT_PATH PATHS
    "${directory}" "${directory}/share/mfem" "${directory}/config")
  if(NOT directory OR NOT config_mk)
    return()
  endif()
  find_program(SYNOVIA_MAKE NAMES make gmake)
  mark_as_advanced(SYNOVIA_MAKE)
  if(NOT SYNOVIA_MAKE)
    message(FATAL_ERROR "${config_mk} is MFEM's, but there is no make to read "
      "it with. Install make.")
  endif()
  set(features USE_MPI USE_METIS USE_MUMPS USE_SUITESPARSE USE_SINGLE)
  set(names VERSION_STRING INC_DIR LIB_FILE TPLFLAGS EXT_LIBS ${features})
  # Only make knows what its variables mean.
  set(lines "")
  foreach(name IN LISTS names)
    string(APPEND lines "$(info ${name}=$(MFEM_${name}))\n")
  endforeach()
  cmake_path(GET config_mk PARENT_PATH source)
  cmake_path(GET source PARENT_PATH source)
  set(reader "${CMAKE_CURRENT_BINARY_DIR}/read_config.mk")
  file(WRITE "${reader}"
    "MFEM_DIR := ${source}\ninclude ${config_mk}\n${lines}all:;@:\n")
  execute_process(COMMAND ${SYNOVIA_MAKE} -s -f "${reader}" all
    OUTPUT_VARIABLE values ERROR_VARIABLE complaint RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${config_mk} can't be read: ${complaint}")
  endif()
  foreach(name IN LISTS names)
    string(REGEX MATCH "(^|\n)${name}=([^\n]*)" line "${values}")
    string(STRIP "${CMAKE_MATCH_2}" ${name})
  endforeach()
  set(MFEM_CONSIDERED_CONFIGS "${config_mk}" PARENT_SCOPE)
  set(MFEM_CONSIDERED_VERSIONS "${VERSION_STRING}" PARENT_SCOPE)
  if(VERSION_STRING VERSION_LESS 4.9)
    return()
  endif()
  foreach(feature IN LISTS features)
    set(MFEM_${feature} "${${feature}}" PARENT_SCOPE)
  endforeach()
  if(NOT EXISTS "${LIB_FILE}")
    message(FATAL_ERROR "${config_mk} names the library ${LIB_FILE}, which "
      "isn't there. Build it with make, or install it anew.")
  endif()
  separate_arguments(TPLFLAGS UNIX_COMMAND "${TPLFLAGS}")
  separate_arguments(EXT_LIBS UNIX_COMMAND "${EXT_LIBS}")
  if(NOT TARGET mfem)
    add_library(mfem UNKNOWN IMPORTED)
    set_target_properties(mfem PROPERTIES IMPORTED_LOCATION "${LIB_FILE}"
      INTERFACE_INCLUDE_DIRECTORIES "${INC_DIR}"
      INTERFACE_COMPILE_OPTIONS "${TPLFLAGS}"
      INTERFACE_LINK_LIBRARIES "${EXT_LIBS}")
  endif()
  set(library_dirs ${EXT_LIBS})
  list(FILTER library_dirs INCLUDE REGEX "^-L")
  list(TRANSFORM library_dirs REPLACE "^-L" "")
  set(MFEM_LIBRARY_DIRS "${library_dirs}" PARENT_SCOPE)
  set(MFEM_VERSION "${VERSION_STRING}" PARENT_SCOPE)
  set(MFEM_FOUND TRUE PARENT_SCOPE)
endfunction()
