# One CMake target a room: what a room may include is what it links, so the linker keeps the plan of the house.

# Flags every translation unit of the product has: same input, same bits, on every compiler and CPU.
add_library(motionrack_flags INTERFACE)
target_compile_features(motionrack_flags INTERFACE cxx_std_20)
target_include_directories(motionrack_flags INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                           $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
# Nobody replaces a function at load time, so position-independent code may inline it: the chip is a tenth to a third faster.
# Strangers need only the flag that decides bits.
set(own_flags -fno-semantic-interposition -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
target_compile_options(motionrack_flags INTERFACE -ffp-contract=off "$<BUILD_INTERFACE:${own_flags}>")
set_target_properties(motionrack_flags PROPERTIES EXPORT_NAME flags)

# motionrack_room(NAME [SOURCES ...] [DEPS ...] [LIBRARIES ...] [HEADERS_OF ...]): the library motionrack_NAME, for others
# motionrack::NAME; without sources it is headers only. Only its sources use LIBRARIES and HEADERS_OF; the latter have no library.
# COMPONENT: what strangers ask find_package for to have it, where it needs packages that the other rooms do not.
function(motionrack_room name)
  cmake_parse_arguments(ROOM "" "COMPONENT" "SOURCES;DEPS;LIBRARIES;HEADERS_OF" ${ARGN})
  if(ROOM_SOURCES)
    add_library(motionrack_${name} STATIC ${ROOM_SOURCES})
    target_link_libraries(motionrack_${name} PUBLIC motionrack_flags ${ROOM_DEPS} PRIVATE ${ROOM_LIBRARIES})
    foreach(target IN LISTS ROOM_HEADERS_OF)
      target_link_libraries(motionrack_${name} PRIVATE $<BUILD_INTERFACE:${target}>)
    endforeach()
  else()
    add_library(motionrack_${name} INTERFACE)
    target_link_libraries(motionrack_${name} INTERFACE motionrack_flags ${ROOM_DEPS})
  endif()
  add_library(motionrack::${name} ALIAS motionrack_${name})
  set_target_properties(motionrack_${name} PROPERTIES EXPORT_NAME ${name})
  if(ROOM_COMPONENT)
    install(TARGETS motionrack_${name} EXPORT motionrack-${ROOM_COMPONENT} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
  else()
    set_property(GLOBAL APPEND PROPERTY motionrack_rooms motionrack_${name})
  endif()
endfunction()

# motionrack_test(NAME [SOURCES ...] [DEPS ...] [LABELS ...] [FAULTS FILTER]): one test program; each of its tests is a ctest test. Those with the
# label deep take minutes; ./test leaves them out, ctest -L deep passes them. FAULTS: those that rows of the catalogue of faults name, which get the
# label fault; a filter of GoogleTest.
function(motionrack_test name)
  if(NOT MOTIONRACK_TESTS)
    return()
  endif()
  cmake_parse_arguments(T "" "FAULTS" "SOURCES;DEPS;LABELS" ${ARGN})
  if(NOT T_SOURCES)
    return()
  endif()
  add_executable(test_${name} ${T_SOURCES})
  target_link_libraries(test_${name} PRIVATE ${T_DEPS} rapidcheck GTest::gmock GTest::gtest_main)
  target_compile_definitions(test_${name} PRIVATE MOTIONRACK_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
  if(T_FAULTS)
    gtest_discover_tests(test_${name} DISCOVERY_TIMEOUT 60 TEST_FILTER "${T_FAULTS}" PROPERTIES TIMEOUT 600 LABELS fault)
    set(others TEST_FILTER "-${T_FAULTS}")
  endif()
  gtest_discover_tests(test_${name} DISCOVERY_TIMEOUT 60 ${others} PROPERTIES TIMEOUT 600 LABELS "${T_LABELS}")
endfunction()
