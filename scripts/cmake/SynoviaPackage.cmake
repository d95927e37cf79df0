# The Debian package that scripts/packaging/make_deb makes: the program synovia,
# cases and scripts, without what developers need.

if(SYNOVIA_BUNDLE_MFEM)
  if(BUILD_SHARED_LIBS OR NOT SYNOVIA_BUILD_MINIAPPS)
    message(FATAL_ERROR "SYNOVIA_BUNDLE_MFEM is for a static libsynovia, "
      "-DBUILD_SHARED_LIBS=OFF, and for -DSYNOVIA_BUILD_MINIAPPS=ON.")
  endif()
  get_target_property(kind mfem TYPE)
  if(kind STREQUAL "SHARED_LIBRARY")
    # Not of Debian 12, and in a place where nothing else finds it.
    install(IMPORTED_RUNTIME_ARTIFACTS mfem
      LIBRARY DESTINATION lib/synovia COMPONENT programs)
    set_target_properties(synovia_driver PROPERTIES
      INSTALL_RPATH "$ORIGIN/../lib/synovia" INSTALL_RPATH_USE_LINK_PATH OFF)
  elseif(NOT kind STREQUAL "STATIC_LIBRARY")
    message(FATAL_ERROR "SYNOVIA_BUNDLE_MFEM needs an MFEM that CMake built.")
  endif()
  install(FILES ${PROJECT_SOURCE_DIR}/scripts/packaging/copyright
    DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT programs)
endif()

# The names in a list of scripts/, as a field of a package has them.
function(synovia_read_packages result file)
  file(STRINGS ${PROJECT_SOURCE_DIR}/scripts/${file} names REGEX "^[a-z]")
  list(JOIN names ", " names)
  set(${result} "${names}" PARENT_SCOPE)
endfunction()

set(CPACK_PACKAGE_NAME synovia)
set(CPACK_PACKAGE_VENDOR "Synovia developers")
set(CPACK_PACKAGE_CONTACT "Synovia developers <synovia@localhost>")
set(CPACK_COMPONENTS_ALL programs)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME synovia)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAMS_DESCRIPTION "The program synovia runs cases of cartilage, meniscus and whole joints:
porous solids and their fluid, in contact, in parallel with MPI.")
# OpenBLAS makes factorizations several times faster than the reference BLAS.
# One thread a rank is what it should have.
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_DEPENDS "openmpi-bin, python3, ca-certificates, \
libopenblas0-serial | libopenblas0-pthread | libopenblas0-openmp")
synovia_read_packages(CPACK_DEBIAN_PROGRAMS_PACKAGE_RECOMMENDS
  packages-python.txt)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
include(CPack)
