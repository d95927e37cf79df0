# The target synovia_one_column_blas: for programs, faster solves with MUMPS
# where the BLAS is a shared library (miniapps/blas/one_column.cpp), and else
# nothing.
set(sources ${PROJECT_SOURCE_DIR}/miniapps/blas/one_column.cpp)
add_library(synovia_one_column_blas INTERFACE)
if(MFEM_USE_MUMPS AND NOT CMAKE_CROSSCOMPILING)
  try_run(SYNOVIA_BLAS_CHECK SYNOVIA_BLAS_CHECK_COMPILES
    ${PROJECT_BINARY_DIR}/one_column_blas
    SOURCES ${sources} ${PROJECT_SOURCE_DIR}/miniapps/blas/check.cpp
    LINK_OPTIONS -Wl,--no-as-needed
    LINK_LIBRARIES mfem MPI::MPI_CXX ${CMAKE_DL_LIBS}
    CXX_STANDARD 17)
  if(SYNOVIA_BLAS_CHECK_COMPILES AND SYNOVIA_BLAS_CHECK STREQUAL "0")
    add_library(synovia_one_column_objects OBJECT ${sources})
    target_link_libraries(synovia_one_column_objects PRIVATE synovia_flags)
    target_compile_features(synovia_one_column_objects PRIVATE cxx_std_17)
    target_link_libraries(synovia_one_column_blas INTERFACE
      $<TARGET_OBJECTS:synovia_one_column_objects> ${CMAKE_DL_LIBS})
  else()
    message(STATUS "The BLAS is no shared library: solves with one right side "
      "are left as MUMPS makes them")
  endif()
endif()
