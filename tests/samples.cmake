# Tests in Python (its standard library is all they need): the samples and what goes with them.
find_package(Python3 REQUIRED COMPONENTS Interpreter)

add_test(NAME Readme.CommandsPrintWhatItShows
  COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/tests/readme_test.py
    $<TARGET_FILE_DIR:model> ${PROJECT_SOURCE_DIR})
add_test(NAME Samples.AreWhatTheReferenceCalculates
  COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/tests/samples_match_reference.py ${PROJECT_SOURCE_DIR})
add_test(NAME Samples.StagesCanBeSwapped
  COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/tests/swap_stage_test.py
    $<TARGET_FILE_DIR:model> ${PROJECT_SOURCE_DIR})
add_test(NAME Samples.MakefileRemakesWhatIsStale
  COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/tests/makefile_samples_test.py
    $<TARGET_FILE_DIR:model> ${PROJECT_SOURCE_DIR})
add_test(NAME Pipeline.RandomScenesMatchTheReference
  COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/tests/random_scenes_test.py $<TARGET_FILE_DIR:model>)
# The reference is imported from the source folder, which stays free of Python's caches.
set_tests_properties(Samples.AreWhatTheReferenceCalculates Pipeline.RandomScenesMatchTheReference
  PROPERTIES ENVIRONMENT PYTHONDONTWRITEBYTECODE=1)
