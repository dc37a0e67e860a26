# The project's targets: one static library per source folder, tests and benchmarks beside it.
option(SKYLAPSE_WERROR "Treat compiler warnings as errors" ON)
option(SKYLAPSE_SANITIZE "Build with AddressSanitizer and UndefinedBehaviorSanitizer" OFF)
option(SKYLAPSE_BENCHMARKS "Build the benchmarks" ON)

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib/skylapse)

add_library(skylapse_options INTERFACE)
target_compile_options(skylapse_options INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wno-sign-conversion -Wno-float-conversion)
if(SKYLAPSE_WERROR)
  target_compile_options(skylapse_options INTERFACE -Werror)
endif()
# The same bytes from any checkout: no paths of the build machine in asserts.
target_compile_options(skylapse_options INTERFACE -ffile-prefix-map=${PROJECT_SOURCE_DIR}/=)
if(SKYLAPSE_SANITIZE)
  target_compile_options(skylapse_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(skylapse_options INTERFACE -fsanitize=address,undefined)
endif()

# skylapse_library(astro SOURCES a.cpp b.cpp LINKS core PUBLIC_DEPS X PRIVATE_DEPS Y)
#   makes skylapse_astro (exported as skylapse::astro). LINKS are folders lower in the tree.
function(skylapse_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINKS;PUBLIC_DEPS;PRIVATE_DEPS" ${ARGN})
  set(target skylapse_${name})
  add_library(${target} STATIC ${arg_SOURCES})
  add_library(skylapse::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR};${CMAKE_INSTALL_INCLUDEDIR}/skylapse>")
  target_compile_features(${target} PUBLIC cxx_std_20)
  foreach(folder IN LISTS arg_LINKS)
    target_link_libraries(${target} PUBLIC skylapse_${folder})
  endforeach()
  target_link_libraries(${target} PUBLIC ${arg_PUBLIC_DEPS} PRIVATE ${arg_PRIVATE_DEPS} $<BUILD_INTERFACE:skylapse_options>)
endfunction()

# skylapse_test(astro SOURCES sun_test.cpp LINKS astro) makes and registers tests/astro -> test_astro.
# USES_DRIVERS: the tests load the image module or OpenGL drivers. LeakSanitizer stops all threads when a
# process ends and crashes ("Tracer caught signal 11") if one of their libraries' own threads is just
# ending, about one run in a hundred; drivers also keep memory until the end. Those tests keep
# AddressSanitizer and UBSan and do without the leak check.
function(skylapse_test name)
  cmake_parse_arguments(arg "USES_DRIVERS" "" "SOURCES;LINKS;DEPS" ${ARGN})
  set(target test_${name})
  add_executable(${target} ${arg_SOURCES})
  foreach(folder IN LISTS arg_LINKS)
    target_link_libraries(${target} PRIVATE skylapse_${folder})
  endforeach()
  target_link_libraries(${target} PRIVATE ${arg_DEPS} GTest::gtest_main GTest::gmock skylapse_options)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(${target} PRIVATE
    SKYLAPSE_TEST_DATA="${PROJECT_SOURCE_DIR}/tests/data" SKYLAPSE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  set(environment "")
  if(arg_USES_DRIVERS AND SKYLAPSE_SANITIZE)
    set(environment ENVIRONMENT ASAN_OPTIONS=detect_leaks=0)
  endif()
  gtest_discover_tests(${target} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600 ${environment})
endfunction()

# skylapse_benchmark(bench_sun SOURCES bench_sun.cpp LINKS astro)
function(skylapse_benchmark name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINKS;DEPS" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  foreach(folder IN LISTS arg_LINKS)
    target_link_libraries(${name} PRIVATE skylapse_${folder})
  endforeach()
  target_link_libraries(${name} PRIVATE ${arg_DEPS} skylapse_options)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(${name} PRIVATE
    SKYLAPSE_TEST_DATA="${PROJECT_SOURCE_DIR}/tests/data" SKYLAPSE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
endfunction()
