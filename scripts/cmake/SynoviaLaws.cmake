# Sets synovia_law_list: a source that registers the law of each header in
# plugin/materials/solids and plugin/materials/permeabilities. A header has the
# name of its class: foo_bar.hpp has FooBar.

set(law_includes "")
foreach(kind solids permeabilities)
  set(${kind}_lines "")
  file(GLOB headers CONFIGURE_DEPENDS plugin/materials/${kind}/*.hpp)
  foreach(header IN LISTS headers)
    get_filename_component(name ${header} NAME_WE)
    string(APPEND law_includes
      "#include \"synovia/materials/${kind}/${name}.hpp\"\n")
    set(class "")
    string(REPLACE "_" ";" words ${name})
    foreach(word IN LISTS words)
      string(SUBSTRING ${word} 0 1 initial)
      string(SUBSTRING ${word} 1 -1 rest)
      string(TOUPPER ${initial} initial)
      string(APPEND class ${initial}${rest})
    endforeach()
    string(APPEND ${kind}_lines "      found.Add<${class}>();\n")
  endforeach()
endforeach()
set(synovia_law_list ${CMAKE_CURRENT_BINARY_DIR}/law_list.cpp)
configure_file(plugin/materials/law_list.cpp.in ${synovia_law_list} @ONLY)
