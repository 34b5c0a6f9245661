# Rules for C and C++, and for the form of all text. Each prints its remedy; without its tool it is skipped.
motionrack_rule(LinesAndFilesAreShort /usr/bin/python3 -B ${here}/lines.py)
motionrack_rule(TextHasOneForm /usr/bin/python3 -B ${here}/text_form.py)
motionrack_rule(CodeIsFormatted ${here}/format)
motionrack_rule(FunctionsAndClassesAreSmall /usr/bin/python3 -B ${here}/sizes.py)
motionrack_rule(ChangedFilesAreTidy ${here}/tidy --build ${PROJECT_BINARY_DIR} --changed)
