# Case files, and the scripts that make their meshes and draw their results, go
# to share/synovia. They find each other there as they do here.
set(synovia_data_dir ${CMAKE_INSTALL_DATADIR}/synovia)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME programs)

install(DIRECTORY miniapps/cases DESTINATION ${synovia_data_dir}
  FILES_MATCHING PATTERN "*.toml" PATTERN "*.frames.toml" EXCLUDE)
install(DIRECTORY meshes DESTINATION ${synovia_data_dir}
  USE_SOURCE_PERMISSIONS FILES_MATCHING PATTERN "*.py")
install(PROGRAMS scripts/get_knee_image scripts/plot_glenohumeral.py
  scripts/plot_indentation.py scripts/plot_knee.py scripts/plot_knee_mesh.py
  scripts/run_python scripts/report scripts/report.py
  DESTINATION ${synovia_data_dir}/scripts)
install(FILES scripts/packages-python.txt scripts/requirements.txt
  DESTINATION ${synovia_data_dir}/scripts)
install(DIRECTORY scripts/lib DESTINATION ${synovia_data_dir}/scripts
  FILES_MATCHING PATTERN "*.py" PATTERN "common.sh" PATTERN "packages.sh"
  PATTERN "python.sh" PATTERN "run.env" PATTERN "benchmark_*" EXCLUDE
  PATTERN "case_*" EXCLUDE PATTERN "find_mfem" EXCLUDE
  PATTERN "histories.py" EXCLUDE
  PATTERN "__pycache__" EXCLUDE)
# The reader of results that they have from the Python package, which pip can
# install from there.
install(DIRECTORY scripts/python DESTINATION ${synovia_data_dir}/scripts
  FILES_MATCHING PATTERN "*.py" PATTERN "py.typed" PATTERN "*.toml"
  PATTERN "*.md" PATTERN "*.ipynb" PATTERN "*.png" PATTERN "__pycache__" EXCLUDE)
# What the plots compare with.
install(DIRECTORY tests/reference DESTINATION ${synovia_data_dir}/tests
  FILES_MATCHING PATTERN "*.csv")
install(FILES README.md CHANGELOG.md LICENSE
  DESTINATION ${CMAKE_INSTALL_DOCDIR})
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME Unspecified)
