# The documentation as a site of static files, built offline: packaging/docs, or cmake --build BUILD --target docs.
#
#   docs/, READMEs ───────────────┐
#   headers ──doxygen──► XML ─────┼──► Markdown ──mkdocs──► share/motionrack/docs ──► package motionrack-doc
#   Python stubs, docstrings ─────┘
#
# Needs mkdocs-material and doxygen; nothing else in the build does. The program finds the site beside itself.
set(site ${PROJECT_BINARY_DIR}/share/motionrack/docs)
set(build_site /usr/bin/python3 -B ${PROJECT_SOURCE_DIR}/docs/site/build_site.py ${PROJECT_SOURCE_DIR}
    ${PROJECT_BINARY_DIR}/site)
add_custom_target(docs COMMAND ${build_site} ${site} COMMENT "The documentation as a site in share/motionrack/docs"
                  VERBATIM)
install(DIRECTORY ${site} DESTINATION ${CMAKE_INSTALL_DATADIR}/motionrack COMPONENT docs OPTIONAL)
