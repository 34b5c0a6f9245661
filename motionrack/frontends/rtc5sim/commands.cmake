# What follows from rtc5sim.h alone: the commands for a card by its number, those for the selected card, the list
# commands, and the names that the library shows. rtc5sim.h is the one place that has a command's name and arguments.
#
# Section "Cards" has functions of the process; those of the other sections exist twice, and those of sections
# "Lists: .." are the rows of the same name in map/commands.hpp.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/rtc5sim.h)
file(READ ${CMAKE_CURRENT_SOURCE_DIR}/rtc5sim.h header)
string(REPLACE ";" "@" header "${header}")
string(REGEX MATCHALL "\n/\\* ---- [^\n]+ ---- \\*/|\nRTC5_API [^@]+@" items "${header}")

set(declared "")
set(selected "")
set(listed "")
set(shown "")
set(section "")
foreach(item IN LISTS items)
  string(REGEX REPLACE "[ \n]+" " " item "${item}")
  if(item MATCHES "/\\* ---- (.+) ---- \\*/")
    set(section "${CMAKE_MATCH_1}")
    continue()
  endif()
  if(NOT item MATCHES "^ RTC5_API (.*[ *])([A-Za-z0-9_]+)\\((.*)\\)@$")
    message(FATAL_ERROR "rtc5sim.h: not a function: ${item}")
  endif()
  set(answer "${CMAKE_MATCH_1}")
  set(name "${CMAKE_MATCH_2}")
  set(parameters "${CMAKE_MATCH_3}")
  if(NOT name MATCHES "^rtc5sim_")
    string(APPEND shown "        ${name};\n")
  endif()
  if(section STREQUAL "Cards")
    continue()
  endif()
  set(arguments "")
  set(with_card "UINT CardNo")
  if(NOT parameters STREQUAL "void")
    string(APPEND with_card ", ${parameters}")
    string(REPLACE ", " ";" each "${parameters}")
    list(TRANSFORM each REPLACE "^.*[ *]([A-Za-z0-9_]+)$" ", \\1")
    list(JOIN each "" arguments)
  endif()
  string(APPEND declared "RTC5_API ${answer}n_${name}(${with_card});\n")
  string(APPEND selected "${answer}${name}(${parameters}) { return n_${name}(selected()${arguments}); }\n")
  if(section MATCHES "^Lists: ")
    string(APPEND listed "void n_${name}(${with_card}) { put(CardNo, Op::${name}${arguments}); }\n")
  endif()
endforeach()

set(made ${CMAKE_CURRENT_BINARY_DIR}/made)
set(from "Made from rtc5sim.h.")
file(CONFIGURE OUTPUT ${made}/rtc5sim_cards.h @ONLY CONTENT
"/* The commands of rtc5sim.h on the card CardNo instead of the selected one; that header includes this one. ${from} */
#ifndef RTC5SIM_CARDS_H
#define RTC5SIM_CARDS_H

#include <rtc5sim.h>

#ifdef __cplusplus
extern \"C\" {
#endif

${declared}
#ifdef __cplusplus
}
#endif

#endif
")
file(CONFIGURE OUTPUT ${made}/commands.cpp @ONLY CONTENT
"// The list commands, and every command on the selected card. ${from}
#include <motionrack/frontends/rtc5sim/calls.hpp>

using motionrack::rtc5::Op;
using namespace motionrack::rtc5sim;

${listed}
${selected}")
file(CONFIGURE OUTPUT ${made}/exports.map @ONLY CONTENT
"/* What librtc5sim.so shows. ${from} */
{
    global:
        rtc5sim_*;
        n_*;
${shown}    local: *;
};
")
