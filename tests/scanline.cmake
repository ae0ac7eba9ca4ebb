# The scan-line algorithm, end to end: the same bytes as the z-buffer, and no memory for the frame.
add_test(NAME Scanline.SamplesAreTheZBuffers
  COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/tests/scanline_tool_test.py $<TARGET_FILE_DIR:zbuf> SameBytes)
# A sanitizer's own memory says nothing about the tools'.
if(NOT has_sanitizer)
  add_test(NAME Scanline.NeedsNoMemoryForTheFrame
    COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/tests/scanline_tool_test.py $<TARGET_FILE_DIR:zbuf> Memory)
  set_tests_properties(Scanline.NeedsNoMemoryForTheFrame PROPERTIES ENVIRONMENT PYTHONDONTWRITEBYTECODE=1 TIMEOUT 300)
endif()
add_test(NAME Scanline.LongLargestScreen
  COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/tests/scanline_tool_test.py $<TARGET_FILE_DIR:zbuf> LongMemory)
add_test(NAME Scanline.AlgorithmsAreMeasured
  COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/tests/scanline_tool_test.py $<TARGET_FILE_DIR:zbuf> Measurement)
# The source folder stays free of Python's caches.
set_tests_properties(Scanline.SamplesAreTheZBuffers Scanline.AlgorithmsAreMeasured
  PROPERTIES ENVIRONMENT PYTHONDONTWRITEBYTECODE=1 TIMEOUT 300)
set_tests_properties(Scanline.LongLargestScreen
  PROPERTIES ENVIRONMENT PYTHONDONTWRITEBYTECODE=1 LABELS long TIMEOUT 1800)
