# Tests in Python (its standard library is all they need): the samples and what goes with them.
find_package(Python3 REQUIRED COMPONENTS Interpreter)

add_test(NAME Samples.AreWhatTheReferenceCalculates
  COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/tests/samples_match_reference.py ${PROJECT_SOURCE_DIR})
set(RANDOM_SCENES)  # as many as the test chooses
if(has_sanitizer)
  set(RANDOM_SCENES 20)
endif()
add_test(NAME Pipeline.RandomScenesMatchTheReference
  COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/tests/random_scenes_test.py $<TARGET_FILE_DIR:model> ${RANDOM_SCENES})
# Every way through the code that a processor may choose gives the committed bytes.
foreach(kernel portable sse4 avx2)
  set(out ${CMAKE_CURRENT_BINARY_DIR}/samples-${kernel})
  add_test(NAME Samples.AreTheSameWithKernel_${kernel}
    COMMAND sh -c "rm -rf '${out}' && make -s -f Makefile.samples check BIN='$<TARGET_FILE_DIR:model>' OUT='${out}'"
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties(Samples.AreTheSameWithKernel_${kernel} PROPERTIES ENVIRONMENT PIPELINE_KERNEL=${kernel})
endforeach()
# The reference is imported from the source folder, which stays free of Python's caches.
set_tests_properties(Samples.AreWhatTheReferenceCalculates Pipeline.RandomScenesMatchTheReference
  PROPERTIES ENVIRONMENT PYTHONDONTWRITEBYTECODE=1)
set_tests_properties(Pipeline.RandomScenesMatchTheReference Samples.AreWhatTheReferenceCalculates PROPERTIES COST 50)
