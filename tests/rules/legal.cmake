# Licences, releases and commits. What cannot be asked here is skipped with its reason.
function(motionrack_legal_rule name script)
  motionrack_rule(${name} /usr/bin/python3 -B ${here}/${script} ${PROJECT_SOURCE_DIR} ${ARGN})
endfunction()

motionrack_legal_rule(TheVersionStandsOnce version_once.py $<TARGET_FILE:motionrack>)
motionrack_legal_rule(TheChangelogKeepsItsForm changelog_form.py)
motionrack_legal_rule(CommitsKeepTheirForm commits_form.py)
motionrack_legal_rule(EveryPartOfOthersIsOnItsPage third_party.py)
motionrack_legal_rule(TheCopyrightFileHasEveryLicence copyright_file.py)

# What is given away: the program and its module, the C libraries, the Python module.
set(given motionrack motionrack_png motionrack_c mcx314lib databoard4002lib rtc5sim)
if(TARGET motionrack_python)
  list(APPEND given motionrack_python)
endif()
list(TRANSFORM given REPLACE "(.+)" "$<TARGET_FILE:\\1>")
motionrack_legal_rule(NoGplLibraryIsLinked linked.py ${given})
