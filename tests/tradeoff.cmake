# scripts/tradeoff on tiny scenes: what it finds has to be what arithmetic says. No claim depends on a time.
find_package(Python3 COMPONENTS Interpreter REQUIRED)

add_test(NAME Tradeoff.FindsWhatArithmeticSays
  COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/tests/tradeoff_test.py
    $<TARGET_FILE_DIR:model> ${PROJECT_SOURCE_DIR})
set_tests_properties(Tradeoff.FindsWhatArithmeticSays PROPERTIES TIMEOUT 300 COST 50)
