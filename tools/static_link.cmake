# Sets static_link_options: how the tools are linked statically; empty where that is impossible. A tool that loads no
# shared libraries starts in two thirds of the time.
set(static_link_options)
if(NOT PIPELINE_STATIC_TOOLS OR NOT CMAKE_SYSTEM_NAME STREQUAL "Linux" OR has_sanitizer)
  return()
endif()

if(PIPELINE_PNG)
  find_library(PIPELINE_STATIC_PNG libpng.a)
  find_library(PIPELINE_STATIC_ZLIB libz.a)
  mark_as_advanced(PIPELINE_STATIC_PNG PIPELINE_STATIC_ZLIB)
  if(NOT PIPELINE_STATIC_PNG OR NOT PIPELINE_STATIC_ZLIB)
    message(STATUS "The tools are linked dynamically: there is no libpng.a or no libz.a")
    return()
  endif()
endif()

# Position-independent, in few segments, and with compact relocations: the fewer pages a tool touches, the sooner it starts.
set(options -static-pie -Wl,--gc-sections -Wl,-z,noseparate-code -Wl,-z,pack-relative-relocs)
if(NOT CMAKE_CROSSCOMPILING OR CMAKE_CROSSCOMPILING_EMULATOR)
  include(CheckCXXSourceRuns)
  set(CMAKE_REQUIRED_LINK_OPTIONS ${options})
  check_cxx_source_runs("
    #include <iostream>
    #include <stdexcept>
    #include <thread>
    int main() {
      std::thread([] { try { throw std::runtime_error(\"\"); } catch (const std::exception&) { std::cout << 1; } }).join();
    }" PIPELINE_STATIC_TOOLS_RUN)
  unset(CMAKE_REQUIRED_LINK_OPTIONS)
endif()
if(NOT PIPELINE_STATIC_TOOLS_RUN)
  message(STATUS "The tools are linked dynamically: the compiler makes no static ones")
  return()
endif()

set(static_link_options ${options})
# For find_package(PNG), whatever an earlier run has found.
if(PIPELINE_PNG)
  foreach(suffix LIBRARY LIBRARY_RELEASE)
    set(PNG_${suffix} ${PIPELINE_STATIC_PNG})
    set(ZLIB_${suffix} ${PIPELINE_STATIC_ZLIB})
  endforeach()
endif()
