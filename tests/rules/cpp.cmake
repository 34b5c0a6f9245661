# Rules for C and C++, and for the form of all text. Each prints its remedy; without its tool it is skipped.
function(motionrack_cpp_rule name)
  add_test(NAME Rules.${name} COMMAND ${ARGN})
  set_tests_properties(Rules.${name} PROPERTIES LABELS rules TIMEOUT 300 SKIP_RETURN_CODE 77)
endfunction()

set(rules ${CMAKE_CURRENT_LIST_DIR})
motionrack_cpp_rule(LinesAndFilesAreShort /usr/bin/python3 -B ${rules}/lines.py)
motionrack_cpp_rule(TextHasOneForm /usr/bin/python3 -B ${rules}/text_form.py)
motionrack_cpp_rule(CodeIsFormatted ${rules}/format)
motionrack_cpp_rule(FunctionsAndClassesAreSmall /usr/bin/python3 -B ${rules}/sizes.py)
motionrack_cpp_rule(ChangedFilesAreTidy ${rules}/tidy --build ${PROJECT_BINARY_DIR} --changed)
