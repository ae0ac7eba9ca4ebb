# Numbers at the extremes, through the real binaries, against a reference of 700 digits.
add_test(NAME Stability.TheToolsPrintCorrectlyRoundedNumbers
  COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/tests/stability_test.py $<TARGET_FILE_DIR:model>)
# The source folder stays free of Python's caches.
set_tests_properties(Stability.TheToolsPrintCorrectlyRoundedNumbers PROPERTIES ENVIRONMENT PYTHONDONTWRITEBYTECODE=1 TIMEOUT 300 COST 50)
