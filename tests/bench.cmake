# scripts/bench on tiny scenes: it runs, and every figure is there. No claim depends on a time.
if(TARGET draw_triangles)
  add_test(NAME Bench.MeasuresEveryGroup
    COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/tests/bench_test.py $<TARGET_FILE_DIR:zbuf> ${PROJECT_SOURCE_DIR})
  set_tests_properties(Bench.MeasuresEveryGroup PROPERTIES TIMEOUT 300 COST 50 ENVIRONMENT PYTHONDONTWRITEBYTECODE=1)
endif()
