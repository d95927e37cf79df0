# Installs the build in BUILD_DIR below WORK_DIR, builds and runs the project
# beside this file against that, and, with MINIAPPS, runs an installed case.
function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# A stale file must not stand in for one that is not installed any more.
file(REMOVE_RECURSE ${WORK_DIR})
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --config ${CONFIG}
  --prefix ${WORK_DIR}/prefix)
# It must work from where it is moved to, too.
file(RENAME ${WORK_DIR}/prefix ${WORK_DIR}/moved)
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${WORK_DIR}/build
  -G ${GENERATOR} -D CMAKE_PREFIX_PATH=${WORK_DIR}/moved
  -D CMAKE_CXX_COMPILER=${CXX_COMPILER} -D CMAKE_BUILD_TYPE=${CONFIG})
run(${CMAKE_COMMAND} --build ${WORK_DIR}/build --config ${CONFIG})
run(${CMAKE_CTEST_COMMAND} --test-dir ${WORK_DIR}/build -C ${CONFIG}
  --output-on-failure --no-tests=error)

if(NOT MINIAPPS)
  return()
endif()
set(programs ${WORK_DIR}/moved/${BIN_DIR})
set(data ${WORK_DIR}/moved/${DATA_DIR}/synovia)
run(${programs}/synovia --version)
foreach(miniapp indentation knee partial_assembly scaling)
  run(${programs}/${miniapp} --help OUTPUT_QUIET)
endforeach()

execute_process(COMMAND ${PYTHON} -c "import gmsh, pyvista"
  RESULT_VARIABLE modules_are_missing OUTPUT_QUIET ERROR_QUIET)
if(modules_are_missing)
  message(STATUS "Installed scripts are not tried: ${PYTHON} lacks gmsh or "
    "pyvista.")
  return()
endif()
set(ENV{SYNOVIA_PYTHON} ${PYTHON})
file(COPY ${data}/cases/two_columns.toml DESTINATION ${WORK_DIR}/case)
function(run_there)
  run(${ARGV} WORKING_DIRECTORY ${WORK_DIR}/case)
endfunction()
run_there(${data}/scripts/run_python ${data}/meshes/boxes.py two_columns --size 3)
run_there(${programs}/synovia two_columns.toml --check)
run_there(${programs}/synovia two_columns.toml --set time.end=25 --output out)
run_there(${data}/scripts/report out)
foreach(file out/history.csv out/report.html)
  if(NOT EXISTS ${WORK_DIR}/case/${file})
    message(FATAL_ERROR "${file} was not written")
  endif()
endforeach()
# The others begin to run, and find the references.
file(GLOB plots ${data}/scripts/plot_*.py)
foreach(plot IN LISTS plots)
  run(${PYTHON} ${plot} --help OUTPUT_QUIET)
endforeach()
if(NOT EXISTS ${data}/tests/reference/indent_force.csv)
  message(FATAL_ERROR "the references are not installed")
endif()
