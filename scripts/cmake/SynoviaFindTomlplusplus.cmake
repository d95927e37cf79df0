# Finds toml++, which reads case files: its headers are enough, and only to
# build the library.
find_path(TOMLPLUSPLUS_INCLUDE_DIR toml++/toml.h)
set(tomlplusplus_version 0)
if(TOMLPLUSPLUS_INCLUDE_DIR)
  set(file ${TOMLPLUSPLUS_INCLUDE_DIR}/toml++/impl/version.h)
  if(EXISTS ${file})
    file(STRINGS ${file} lines REGEX "define TOML_LIB_(MAJOR|MINOR) ")
    string(REGEX REPLACE ".*MAJOR ([0-9]+).*MINOR ([0-9]+).*" "\\1.\\2"
      tomlplusplus_version "${lines}")
  endif()
endif()
if(tomlplusplus_version VERSION_LESS 3.1)
  message(FATAL_ERROR "toml++ >= 3.1 was not found. Install it (Debian: "
    "libtomlplusplus-dev), or pass -DTOMLPLUSPLUS_INCLUDE_DIR=<directory that "
    "has toml++/toml.h>.")
endif()
if(NOT TARGET synovia::tomlplusplus)
  add_library(synovia::tomlplusplus INTERFACE IMPORTED)
  target_include_directories(synovia::tomlplusplus SYSTEM INTERFACE
    ${TOMLPLUSPLUS_INCLUDE_DIR})
endif()
