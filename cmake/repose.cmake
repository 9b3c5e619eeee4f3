# Targets of the house: one per folder, so that an include against the direction of the data does not build.
#
# Every library sees its own folder and those it links to under one path, "engine/base/vec3.hpp" or "sweep/store.hpp",
# through a root of its own that holds a link to that folder and nothing else.

set(REPOSE_WARNINGS -Wall -Wextra -Wpedantic -Wconversion)
if(REPOSE_WERROR)
  list(APPEND REPOSE_WARNINGS -Werror)
endif()
# These GCC decides after inlining, where GCC 12 is often wrong, differently for each instruction set: of "a" + std::string
# (its bug 105651), of the temporary in its AVX-512 square root (its bug 105593), of Eigen's packets of three-vectors. Real
# reads beyond an array are left to the sanitizers; of variables read before they are set nothing here warns.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  list(APPEND REPOSE_WARNINGS -Wno-restrict -Wno-uninitialized -Wno-maybe-uninitialized -Wno-array-bounds
    -Wno-stringop-overflow -Wno-stringop-overread)
endif()

# IEEE results are kept: nothing here reorders sums. errno and traps are given up because they stop vectorisation.
add_library(repose_options INTERFACE)
target_compile_options(repose_options INTERFACE ${REPOSE_WARNINGS} -fno-math-errno -fno-trapping-math)
if(REPOSE_NATIVE)
  target_compile_options(repose_options INTERFACE -march=native)
endif()
# Left out is what costs most and finds least here: the kernels' thousands of inlined vectors, each guarded on the stack,
# take 137 s to compile instead of 17 s and about 12 times as long to run; the library's own assertions watch array bounds
# instead. A null pointer ends in AddressSanitizer anyhow.
if(REPOSE_SANITIZE)
  target_compile_options(repose_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all
    -fno-omit-frame-pointer -fno-sanitize-address-use-after-scope --param=asan-stack=0
    -fno-sanitize=null,alignment,object-size,vptr)
  target_compile_definitions(repose_options INTERFACE _GLIBCXX_ASSERTIONS)
  target_link_options(repose_options INTERFACE -fsanitize=address,undefined)
endif()

# Where no time is spent at run time, optimisation only costs time to compile: half of it for the program's verbs.
set(REPOSE_COLD $<$<CONFIG:Release>:-O1>)

# repose_library(NAME FOLDER [COLD] LINKS ...): every .cpp of FOLDER (relative to the project) as library NAME.
function(repose_library name folder)
  cmake_parse_arguments(ARG "COLD" "" "LINKS" ${ARGN})
  set(root ${PROJECT_BINARY_DIR}/include/${name})
  cmake_path(GET folder PARENT_PATH parent)
  file(MAKE_DIRECTORY ${root}/${parent})
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${folder} ${root}/${folder} SYMBOLIC)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.cpp)
  if(sources)
    add_library(${name} STATIC ${sources})
    target_include_directories(${name} PUBLIC ${root})
    target_link_libraries(${name} PUBLIC ${ARG_LINKS} PRIVATE repose_options)
    if(ARG_COLD)
      target_compile_options(${name} PRIVATE ${REPOSE_COLD})
    endif()
  else()
    add_library(${name} INTERFACE)
    target_include_directories(${name} INTERFACE ${root})
    target_link_libraries(${name} INTERFACE ${ARG_LINKS})
  endif()
endfunction()

# repose_test(NAME FOLDER [COLD] LINKS ... [LABELS ...]): every .cpp of FOLDER (relative to tests/) as one GoogleTest program.
# Tests run in the source's folder, so that "cases/quick.json" is found.
function(repose_test name folder)
  cmake_parse_arguments(ARG "COLD" "" "LINKS;LABELS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tests/${folder}/*.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(${name} ${sources})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(${name} PRIVATE ${ARG_LINKS} GTest::gtest GTest::gtest_main repose_options)
  if(ARG_COLD)
    target_compile_options(${name} PRIVATE ${REPOSE_COLD})
  endif()
  include(GoogleTest)
  gtest_discover_tests(${name} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} DISCOVERY_TIMEOUT 60
    PROPERTIES LABELS "${ARG_LABELS}")
endfunction()
