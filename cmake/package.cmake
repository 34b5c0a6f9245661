# Debian packages of what cmake --install puts where: cpack -G DEB in a build that was configured with
# -DCMAKE_INSTALL_PREFIX=/usr.
#
#   motionrack            program, page, manual, completion, systemd unit, examples, rack files
#   libmotionrack0        the shared C libraries                  ◄── libmotionrack-dev: headers, archives, CMake
#                                                                   and pkg-config files, Pascal unit
#   python3-motionrack    the Python package, where it was built
#   motionrack-doc        the documentation as a site, where it was built (cmake/docs.cmake)
#
# and an archive of all of it that runs from any folder: cpack -G TGZ. packaging/test tries both in a clean Debian.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME motionrack)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "Motionrack maintainers <maintainers@motionrack.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_OUTPUT_FILE_PREFIX ${PROJECT_BINARY_DIR}/packages)
set(CPACK_THREADS 0)
set(CPACK_PACKAGE_FILE_NAME motionrack-${PROJECT_VERSION}-${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR})
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_SOURCE_DIR}/cmake/archive_settings.cmake)
set(CPACK_MOTIONRACK_SOURCE ${PROJECT_SOURCE_DIR})
set(CPACK_MOTIONRACK_SITE ${PROJECT_BINARY_DIR}/share/motionrack/docs)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program library dev docs)
if(TARGET motionrack_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/lib)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(same "(= ${PROJECT_VERSION}-1)")

# motionrack_package(COMPONENT NAME SECTION SENTENCE [DEPENDS] [RECOMMENDS]): with its file copyright.
function(motionrack_package component name section sentence)
  string(TOUPPER ${component} c)
  set(CPACK_DEBIAN_${c}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${c}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_COMPONENT_${c}_DESCRIPTION "${PROJECT_DESCRIPTION}: ${sentence}" PARENT_SCOPE)
  if(ARGC GREATER 4)
    set(CPACK_DEBIAN_${c}_PACKAGE_DEPENDS "${ARGV4}" PARENT_SCOPE)
  endif()
  if(ARGC GREATER 5)
    set(CPACK_DEBIAN_${c}_PACKAGE_RECOMMENDS "${ARGV5}" PARENT_SCOPE)
  endif()
  if(component IN_LIST CPACK_COMPONENTS_ALL)
    install(FILES ${PROJECT_SOURCE_DIR}/packaging/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name}
            COMPONENT ${component})
  endif()
endfunction()
# By their names: no file asks for them.
set(loaded libhdf5-103-1)
set(loaded_for_networks "libddsc0debian, libnats3.4")
motionrack_package(program motionrack science "the program, the page of its operator panel, examples" "${loaded}"
                   "fonts-dejavu-core, ${loaded_for_networks}, cyclonedds-tools")
motionrack_package(library libmotionrack0 libs "shared C libraries" "${loaded}")
motionrack_package(dev libmotionrack-dev libdevel "headers and libraries for C, C++ and Pascal"
                   "libmotionrack0 ${same}, libfmt-dev, libexpected-dev, libtomlplusplus-dev, zlib1g-dev, libhdf5-dev"
                   "libddsc0debian, libpugixml-dev")
motionrack_package(python python3-motionrack python "the Python package"
                   "python3 (>= 3.11), python3 (<< 3.12), python3-numpy, ${loaded}" "python3-matplotlib")
motionrack_package(docs motionrack-doc doc "the documentation as a searchable site; motionrack docs serves it")
set(CPACK_DEBIAN_DOCS_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS motionrack-doc)
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/packaging/python/postinst
    ${PROJECT_SOURCE_DIR}/packaging/python/prerm)
include(CPack)
