# What cpack -G TGZ does otherwise than cpack -G DEB: folders begin at the top of the archive, not at /usr, and the
# archive says what it needs, as no package manager does it.
if(CPACK_GENERATOR STREQUAL "TGZ")
  set(CPACK_PACKAGING_INSTALL_PREFIX "/")
  set(CPACK_PRE_BUILD_SCRIPTS ${CPACK_MOTIONRACK_SOURCE}/cmake/archive.cmake)
endif()
# A build without the site makes no package of it.
if(NOT EXISTS ${CPACK_MOTIONRACK_SITE}/index.html)
  list(REMOVE_ITEM CPACK_COMPONENTS_ALL docs)
endif()
