# The real binaries, end to end; Python 3 with its standard library drives them. Verbose, so that what is skipped
# says why.
set(TOOLS_TIMEOUT 300)
set(TOOLS_SCENES 12)
set(SHADING_TESTS)  # all
if(has_sanitizer)
  set(TOOLS_TIMEOUT 1200)  # sanitizers take their time, above all to start a tool
  set(TOOLS_SCENES 2)  # the random scenes of a test that starts the tools hundreds of times for each
  set(SHADING_TESTS Shading WholePictures)  # the others cast a ray through every pixel, which is Python's time
endif()
function(tools_test name script)
  add_test(NAME Tools.${name}
    COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/tests/${script}.py $<TARGET_FILE_DIR:model> --verbose ${ARGN})
  # The source folder stays free of Python's caches. They take longest, so they start first: none is left running alone.
  set_tests_properties(Tools.${name} PROPERTIES
    ENVIRONMENT PYTHONDONTWRITEBYTECODE=1 TIMEOUT ${TOOLS_TIMEOUT} COST 50)
endfunction()

tools_test(SayWhatIsWrong tools_messages_test)
tools_test(FailTogether tools_failures_test)
tools_test(DoWhatTheirOptionsSay tools_options_test)
tools_test(PassTrianglesOnAtOnce tools_streaming_test Streaming Pieces PipeSize)
tools_test(SurviveFaults tools_faults_test)
tools_test(PrintNumbers tools_fuzz_test)
tools_test(WorkOnThreads tools_threads_test)
tools_test(WriteTheSameOnEveryProcessor tools_kernels_test)
tools_test(TakeHostileTexts tools_hostile_test)
tools_test(KeepProperties tools_properties_test)
set_tests_properties(Tools.KeepProperties PROPERTIES
  COST 100 ENVIRONMENT "PYTHONDONTWRITEBYTECODE=1;TOOLS_SCENES=${TOOLS_SCENES}")
tools_test(DrawOnThreads zbuf_tool_test Threads)
tools_test(DrawWithEveryKernel zbuf_tool_test Kernels)
tools_test(ShowProgress zbuf_tool_test Progress Timing)
tools_test(ClipAtPlanesPulledIn clip_inset_test)
tools_test(ExplainEveryFragment fragments_test)
tools_test(CarryColorAndLight tools_colors_test)
tools_test(ShadePixels tools_shading_test ${SHADING_TESTS})
tools_test(MakePictures tools_pictures_test)

# A sanitizer's own memory says nothing about the tools'. Nor can it be limited.
if(NOT has_sanitizer)
  tools_test(NeedConstantMemory tools_streaming_test Memory BufferMemory)
  tools_test(NeedConstantMemoryLong tools_streaming_test LongMemory)
  set_tests_properties(Tools.NeedConstantMemoryLong PROPERTIES LABELS long TIMEOUT 3600)
  # A sanitizer has an allocator of its own and has to be loaded first.
  add_library(fault_shim MODULE fault_shim.cpp)
  target_link_libraries(fault_shim PRIVATE pipeline_options ${CMAKE_DL_LIBS})
  # It calls the C library's allocator by its reserved names.
  set_source_files_properties(fault_shim.cpp PROPERTIES
    COMPILE_OPTIONS $<$<CXX_COMPILER_ID:Clang>:-Wno-reserved-identifier>)
  add_test(NAME Tools.LoseNothingToFaults
    COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/tests/tools_calls_test.py $<TARGET_FILE_DIR:model>
      $<TARGET_FILE:fault_shim> --verbose)
  set_tests_properties(Tools.LoseNothingToFaults PROPERTIES ENVIRONMENT PYTHONDONTWRITEBYTECODE=1 TIMEOUT 600)
  tools_test(LoseNothingToFullDisks tools_disk_test)
  tools_test(LoseNothingToKilledNeighbours tools_killed_test)
endif()
