# Licences, releases and commits. motionrack_rule(NAME SCRIPT ARGUMENT...): Rules.NAME, by a script of this folder.
function(motionrack_rule name script)
  set(file ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/${script})
  add_test(NAME Rules.${name} COMMAND /usr/bin/python3 -B ${file} ${PROJECT_SOURCE_DIR} ${ARGN})
  set_tests_properties(Rules.${name} PROPERTIES TIMEOUT 120 SKIP_RETURN_CODE 77)
endfunction()

motionrack_rule(TheVersionStandsOnce version_once.py $<TARGET_FILE:motionrack>)
motionrack_rule(TheChangelogKeepsItsForm changelog_form.py)
motionrack_rule(CommitsKeepTheirForm commits_form.py)
motionrack_rule(EveryPartOfOthersIsOnItsPage third_party.py)
motionrack_rule(TheCopyrightFileHasEveryLicence copyright_file.py)

# What is given away: the program, the C libraries, the Python module.
set(given motionrack motionrack_c mcx314lib rtc5sim)
if(TARGET motionrack_python)
  list(APPEND given motionrack_python)
endif()
list(TRANSFORM given REPLACE "(.+)" "$<TARGET_FILE:\\1>")
motionrack_rule(NoGplLibraryIsLinked linked.py ${given})
