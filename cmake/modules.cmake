# One CMake target a module: what a module may include is what it links, so the linker enforces the dependencies.

# Flags every translation unit of the product has: same input, same bits, on every compiler and CPU.
add_library(motionrack_flags INTERFACE)
target_compile_features(motionrack_flags INTERFACE cxx_std_20)
target_include_directories(motionrack_flags INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                           $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
# No function is replaced at load time, so position-independent code may inline it: the chip is a tenth to a third
# faster.
# Strangers need only the flag that decides bits.
# In a test a local name may be that of a constant in the source beside it; clang++ takes any two for one that way.
set(shadow_warning -Wshadow)
set(local_shadow -Wshadow=local)
if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(local_shadow -Wno-shadow)
  if(MOTIONRACK_UNITY)
    set(shadow_warning -Wno-shadow)
  endif()
endif()
set(shadow $<TARGET_PROPERTY:MOTIONRACK_SHADOW>)
# Assertions name a source by its place in the tree: what is built does not depend on the folder it was built in.
set(own_flags -fno-semantic-interposition -fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=
    -Wall -Wextra -Wpedantic -Wconversion -Wno-sign-conversion
    $<IF:$<BOOL:${shadow}>,${shadow},${shadow_warning}>)
if(MOTIONRACK_WERROR)
  list(APPEND own_flags -Werror)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # g++ 12 sees overlaps in std::string that are not there (GCC bug 105651).
    list(APPEND own_flags -Wno-error=restrict)
  endif()
endif()
target_compile_options(motionrack_flags INTERFACE -ffp-contract=off "$<BUILD_INTERFACE:${own_flags}>")
set_target_properties(motionrack_flags PROPERTIES EXPORT_NAME flags)

# Addresses differ from start to start, and what the loader has bound cannot be overwritten (tests/hardened).
if(NOT WIN32)
  include(CheckPIESupported)
  check_pie_supported(LANGUAGES CXX)
  add_link_options(LINKER:-z,relro,-z,now,-z,noexecstack)
endif()

# motionrack_harden(TARGET): it checks its stack, its copies and its containers while it runs, as all modules do but the
# fast ones, and what is linked of them. Builds for sanitizers have their own checks.
function(motionrack_harden target)
  if(CMAKE_CXX_FLAGS MATCHES "-fsanitize|--coverage")
    return()
  endif()
  if(WIN32)  # the others need a library there that would have to be given away, too
    target_compile_options(${target} PRIVATE "$<$<CONFIG:Release,RelWithDebInfo>:-D_GLIBCXX_ASSERTIONS>")
    return()
  endif()
  set(checks -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2 -D_GLIBCXX_ASSERTIONS -fstack-protector-strong
      -fstack-clash-protection)
  target_compile_options(${target} PRIVATE "$<$<CONFIG:Release,RelWithDebInfo>:${checks}>")
endfunction()

# The sources of a target are compiled together, some tens at a time: headers and templates are paid once, which makes
# a build several times as quick. So names in their anonymous namespaces are unique within a target. Without it
# (MOTIONRACK_UNITY=OFF, and tests/rules/alone) each source is compiled alone and has to include all that it uses.
if(MOTIONRACK_UNITY)
  set(CMAKE_UNITY_BUILD ON)
  set(CMAKE_UNITY_BUILD_BATCH_SIZE 40)
  # g++ takes a source that is included for a header, whose classes should have no members of hidden types.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(motionrack_flags INTERFACE
                           "$<BUILD_INTERFACE:$<$<COMPILE_LANGUAGE:CXX>:-Wno-subobject-linkage>>")
  endif()
endif()

# A Release has -O3 for what is FAST, -O2 for the other modules, and less for code that is compiled longer than it runs.
# motionrack_optimise(TARGET LEVEL): another level than that of the build type, in a Release.
function(motionrack_optimise target level)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:${level}>)
endfunction()
# motionrack_compile_quickly(TARGET [LEVEL]): such code (the network, the command line, tests) gets MOTIONRACK_QUICK,
# or LEVEL in a Release; without it -O1.
set(MOTIONRACK_QUICK "" CACHE STRING "Compiler option for code that is compiled longer than it runs")
function(motionrack_compile_quickly target)
  if(MOTIONRACK_QUICK)
    target_compile_options(${target} PRIVATE ${MOTIONRACK_QUICK})
  elseif(ARGC GREATER 1)
    motionrack_optimise(${target} ${ARGV1})
  else()
    motionrack_optimise(${target} -O1)
  endif()
endfunction()

# motionrack_sources(OUT PATTERN...): the sources of this folder. In a build for Windows those of its folder windows/
# take the places of those with their names. Each of them is compiled alone: Windows' headers define many words.
function(motionrack_sources out)
  file(GLOB found CONFIGURE_DEPENDS ${ARGN})
  file(GLOB own CONFIGURE_DEPENDS windows/*.cpp)
  set(replaced "")
  foreach(source IN LISTS own)
    get_filename_component(name ${source} NAME)
    if(NOT EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${name})
      message(FATAL_ERROR "${source} takes the place of no source: there is no ${CMAKE_CURRENT_SOURCE_DIR}/${name}. "
                          "Give both one name.")
    endif()
    list(APPEND replaced ${CMAKE_CURRENT_SOURCE_DIR}/${name})
  endforeach()
  if(WIN32)
    list(REMOVE_ITEM found ${replaced})
    set_source_files_properties(${own} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    list(APPEND found ${own})
  endif()
  set(${out} ${found} PARENT_SCOPE)
endfunction()

# motionrack_module(NAME [FAST [READS_FILES]] [SOURCES ...] [DEPS ...] [LIBRARIES ...] [HEADERS_OF ...]): the library
# motionrack_NAME, for others motionrack::NAME; without sources it is headers only. Only its sources use LIBRARIES and
# HEADERS_OF; the latter have no library.
# FAST: the kernel and what it drives run some millions of times a second and are given numbers, no texts; checks would
# take a tenth of their time. For the same reason fuzzers are told its branches, not its comparisons.
# READS_FILES: it reads bytes that strangers wrote, too: the values it compares them with guide the fuzzers.
# COMPONENT: what strangers ask find_package for to have it, where it needs packages that the other modules do not.
function(motionrack_module name)
  cmake_parse_arguments(MODULE "FAST;READS_FILES" "COMPONENT" "SOURCES;DEPS;LIBRARIES;HEADERS_OF" ${ARGN})
  if(MODULE_SOURCES)
    add_library(motionrack_${name} STATIC ${MODULE_SOURCES})
    target_link_libraries(motionrack_${name} PUBLIC motionrack_flags ${MODULE_DEPS} PRIVATE ${MODULE_LIBRARIES})
    if(NOT MODULE_FAST)
      motionrack_optimise(motionrack_${name} -O2)
      motionrack_harden(motionrack_${name})
    elseif(MOTIONRACK_FUZZ AND NOT MODULE_READS_FILES)
      target_compile_options(motionrack_${name} PRIVATE -fno-sanitize-coverage=trace-cmp)
    endif()
    foreach(target IN LISTS MODULE_HEADERS_OF)
      target_link_libraries(motionrack_${name} PRIVATE $<BUILD_INTERFACE:${target}>)
    endforeach()
  else()
    add_library(motionrack_${name} INTERFACE)
    target_link_libraries(motionrack_${name} INTERFACE motionrack_flags ${MODULE_DEPS})
  endif()
  add_library(motionrack::${name} ALIAS motionrack_${name})
  set_target_properties(motionrack_${name} PROPERTIES EXPORT_NAME ${name})
  if(MODULE_COMPONENT)
    install(TARGETS motionrack_${name} EXPORT motionrack-${MODULE_COMPONENT}
            ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
  else()
    set_property(GLOBAL APPEND PROPERTY motionrack_modules motionrack_${name})
  endif()
endfunction()

# The tree's name, for the tests alone.
if(MOTIONRACK_TESTS)
  add_library(motionrack_source_dir STATIC ${PROJECT_SOURCE_DIR}/tests/source_root.cpp)
  target_include_directories(motionrack_source_dir PRIVATE ${PROJECT_SOURCE_DIR})
  target_compile_definitions(motionrack_source_dir PRIVATE MOTIONRACK_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  add_custom_target(deep_tests)
endif()

# The folders of which tests read files.
set(read_by_tests docs examples hdl motionrack tests)
list(TRANSFORM read_by_tests PREPEND ${PROJECT_SOURCE_DIR}/)

# motionrack_test(NAME [SOURCES ...] [DEPS ...] [LABELS ...] [SHARDS N] [FAULTS FILTER] [DEEP FILTER] [EVERY PART FILTER
# ...] [ALONE] [ALWAYS] [COMPUTES | COMPUTES_MUCH]): the test program test_NAME, which ctest runs as NAME, or in N parts
# at once as NAME.1 .. NAME.N. Those with the label deep take long: ./test leaves them out, ./test --all has them.
# FAULTS and DEEP are filters of GoogleTest: those that rows of the catalogue of faults name run as NAME.faults with the
# label fault, those that take long as NAME.deep with the label deep. EVERY: tests that try some of many calls or
# allocations that fail also run as NAME.PART.N with the labels deep and PART, where they try as many by the seed as
# fit into the part. ALONE: each test is a process of its own, where a library has one state for the whole
# process. ALWAYS: its result depends on other programs or libraries of the build, or on sources. Without it only its
# program and the tree's other files decide, so that tests/unchanged knows whether it has to run again. tests/programs
# runs single tests by their names. COMPUTES: its own code takes long, so that it pays to optimise it; COMPUTES_MUCH: so
# long that it pays with sanitizers too. A build with fuzz targets counts no branches of tests for them. Programs whose
# sources draw random numbers have the label random: a new seed shows more. Programs with the label deep are not in
# `all` but in deep_tests: ./test without more runs none of them.
function(motionrack_test name)
  if(NOT MOTIONRACK_TESTS)
    return()
  endif()
  cmake_parse_arguments(T "ALONE;ALWAYS;COMPUTES;COMPUTES_MUCH" "FAULTS;DEEP;SHARDS" "SOURCES;DEPS;LABELS;EVERY"
                        ${ARGN})
  if(NOT T_SOURCES)
    return()
  endif()
  # What replaces operator new is seen by its caller only at the link.
  foreach(source IN LISTS T_SOURCES)
    if(source MATCHES "allocation_count")
      set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
  endforeach()
  foreach(source IN LISTS T_SOURCES)
    file(STRINGS ${source} draws LIMIT_COUNT 1 REGEX "seed_from_environment|<rapidcheck|trials\\(|oracle::programs")
    if(draws)
      list(APPEND T_LABELS random)
      break()
    endif()
  endforeach()
  add_executable(test_${name} ${T_SOURCES})
  target_link_libraries(test_${name} PRIVATE ${T_DEPS} motionrack_source_dir rapidcheck GTest::gmock GTest::gtest_main)
  if(T_COMPUTES_MUCH)
    motionrack_optimise(test_${name} -O1)
  elseif(T_COMPUTES)
    motionrack_compile_quickly(test_${name})
  else()
    motionrack_compile_quickly(test_${name} -O0)
  endif()
  if(MOTIONRACK_FUZZ)
    target_compile_options(test_${name} PRIVATE -fno-sanitize=fuzzer-no-link)
  endif()
  if("deep" IN_LIST T_LABELS)
    set_target_properties(test_${name} PROPERTIES EXCLUDE_FROM_ALL TRUE)
    add_dependencies(deep_tests test_${name})
  endif()
  set_target_properties(test_${name} PROPERTIES MOTIONRACK_SHADOW ${local_shadow})
  if(T_ALONE)
    gtest_discover_tests(test_${name} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600 LABELS "${T_LABELS}")
    return()
  endif()
  set(others --gtest_brief=1)
  set(elsewhere)
  macro(of_program test labels)
    set_tests_properties(${test} PROPERTIES TIMEOUT 1200 LABELS "${labels}")
    if(NOT T_ALWAYS)
      set_property(TEST ${test} PROPERTY REQUIRED_FILES ${read_by_tests})
    endif()
  endmacro()
  if(T_FAULTS)
    add_test(NAME ${name}.faults COMMAND test_${name} --gtest_brief=1 "--gtest_filter=${T_FAULTS}")
    of_program(${name}.faults "fault;${T_LABELS}")
    list(APPEND elsewhere ${T_FAULTS})
  endif()
  if(T_DEEP)
    add_test(NAME ${name}.deep COMMAND test_${name} --gtest_brief=1 "--gtest_filter=${T_DEEP}")
    of_program(${name}.deep "deep;${T_LABELS}")
    list(APPEND elsewhere ${T_DEEP})
  endif()
  while(T_EVERY)
    list(POP_FRONT T_EVERY part filter)
    foreach(shard RANGE 1 8)
      math(EXPR index "${shard} - 1")
      set(test ${name}.${part}.${shard})
      add_test(NAME ${test} COMMAND test_${name} --gtest_brief=1 "--gtest_filter=${filter}")
      of_program(${test} "deep;${part};${T_LABELS}")
      set(environment GTEST_TOTAL_SHARDS=8 GTEST_SHARD_INDEX=${index} MOTIONRACK_CALLS=120
          MOTIONRACK_JOURNAL_CALLS=150 MOTIONRACK_SERVED_CALLS=15 MOTIONRACK_ALLOCATIONS=1200)
      set_tests_properties(${test} PROPERTIES TIMEOUT 3600 ENVIRONMENT "${environment}")
    endforeach()
  endwhile()
  if(elsewhere)
    list(JOIN elsewhere ":" elsewhere)
    list(APPEND others "--gtest_filter=-${elsewhere}")
  endif()
  if(NOT T_SHARDS)
    add_test(NAME ${name} COMMAND test_${name} ${others})
    of_program(${name} "${T_LABELS}")
    return()
  endif()
  foreach(shard RANGE 1 ${T_SHARDS})
    math(EXPR index "${shard} - 1")
    add_test(NAME ${name}.${shard} COMMAND test_${name} ${others})
    of_program(${name}.${shard} "${T_LABELS}")
    # COST: what takes long begins first, also where no run before has measured it.
    set_tests_properties(${name}.${shard} PROPERTIES COST 30
                         ENVIRONMENT "GTEST_TOTAL_SHARDS=${T_SHARDS};GTEST_SHARD_INDEX=${index}")
  endforeach()
endfunction()
