# Licences, releases and commits. motionrack_rule(NAME SCRIPT ARGUMENT...): Rules.NAME, which a script of this folder checks.
function(motionrack_rule name script)
  add_test(NAME Rules.${name} COMMAND /usr/bin/python3 -B ${CMAKE_CURRENT_LIST_DIR}/${script} ${PROJECT_SOURCE_DIR} ${ARGN})
  set_tests_properties(Rules.${name} PROPERTIES TIMEOUT 120 SKIP_RETURN_CODE 77)
endfunction()

motionrack_rule(TheVersionStandsOnce version_once.py $<TARGET_FILE:motionrack>)
motionrack_rule(TheChangelogKeepsItsForm changelog_form.py)
motionrack_rule(CommitsKeepTheirForm commits_form.py)
