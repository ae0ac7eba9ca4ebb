# Reads runs.txt, while CMake configures and, for GoogleTest's tests, when ctest starts.
set(runs_file ${CMAKE_CURRENT_LIST_DIR}/runs.txt)

# Gives each of these tests its label, its cost, and thirty times its seconds before it is stopped.
function(set_runs)
  file(STRINGS ${runs_file} lines REGEX "^(check|all|matrix) ")
  foreach(line IN LISTS lines)
    string(REGEX MATCH "^([a-z]+) +([0-9]+) +(.*)$" line "${line}")
    set(label ${CMAKE_MATCH_1})
    set(seconds ${CMAKE_MATCH_2})
    set(tests ${ARGN})
    list(FILTER tests INCLUDE REGEX "^(${CMAKE_MATCH_3})$")
    if(tests)
      math(EXPR limit "300 + 30 * ${seconds}")
      set_tests_properties(${tests} PROPERTIES LABELS ${label} COST ${seconds} TIMEOUT ${limit})
    endif()
  endforeach()
endfunction()

# Empty while CMake configures.
foreach(room IN ITEMS text numbers scene stream vertex coverage visibility certainty picture raytracing)
  set_runs(${${room}_tests_TESTS})
endforeach()
