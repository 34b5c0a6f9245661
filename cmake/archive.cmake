# The files at the top of the archive: LICENSE, README.md and needs.txt, the Debian packages whose libraries are loaded,
# one a line. cpack runs this when all is installed into CPACK_TEMPORARY_INSTALL_DIRECTORY.
set(top ${CPACK_TEMPORARY_INSTALL_DIRECTORY})
file(COPY ${CPACK_MOTIONRACK_SOURCE}/LICENSE DESTINATION ${top})
configure_file(${CPACK_MOTIONRACK_SOURCE}/packaging/archive.md ${top}/README.md COPYONLY)

# dpkg-shlibdeps asks for a source package; it says `shlibs:Depends=libc6 (>= 2.36), libfmt9 (>= 9.1.0), ...`.
file(GLOB_RECURSE libraries ${top}/lib/*.so ${top}/lib/*.so.*)
list(TRANSFORM libraries PREPEND "-e")
set(work ${CPACK_TOPLEVEL_DIRECTORY}/shlibdeps)
file(WRITE ${work}/debian/control "Source: motionrack\n\nPackage: motionrack\nArchitecture: any\n")
execute_process(COMMAND dpkg-shlibdeps -O --ignore-missing-info -e${top}/bin/motionrack ${libraries}
                WORKING_DIRECTORY ${work} OUTPUT_VARIABLE said ERROR_VARIABLE wrong RESULT_VARIABLE ended)
if(NOT ended EQUAL 0)
  message(FATAL_ERROR "dpkg-shlibdeps does not tell which packages the archive needs; no archive was made. "
                      "It is in the Debian package dpkg-dev. It said: ${wrong}")
endif()
string(REGEX REPLACE "^shlibs:Depends=" "" said "${said}")
string(REGEX REPLACE " *\\([^)]*\\)| *\\|[^,\n]*|[ \n]" "" said "${said}")
string(REPLACE "," ";" packages "${said}")
# Letters in PNG pictures; recordings, networks: loaded by name.
list(APPEND packages fonts-dejavu-core libhdf5-103-1 libddsc0debian libnats3.4)
list(REMOVE_DUPLICATES packages)
list(SORT packages)
list(JOIN packages "\n" lines)
file(WRITE ${top}/needs.txt "${lines}\n")
