# A build for Windows, by cmake/windows.toolchain.cmake: the MCX314's function library alone, as a DLL that needs
# nothing but Windows, and the archive that it is given away in (cpack -G ZIP). Modules that need Linux are left out; in
# the others, files of a folder windows/ take the places of those with their names: see motionrack_sources.
#
#   /usr/include: headers that are whole libraries ──► links in headers/ ──► modules ──► mcx314lib.dll,
#                                                                                   libmcx314lib.dll.a, mcx314lib.def

# The host's folder of headers has those of its C library too, which are not for Windows.
set(headers ${PROJECT_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${headers})
# motionrack_header_library(TARGET FOLDER FILE [DEFINITION...]): FOLDER/FILE is one of its headers.
function(motionrack_header_library target folder file)
  find_path(place ${folder}/${file} NO_CMAKE_FIND_ROOT_PATH NO_CACHE REQUIRED)
  file(CREATE_LINK ${place}/${folder} ${headers}/${folder} SYMBOLIC)
  string(MAKE_C_IDENTIFIER header_${target} name)
  add_library(${name} INTERFACE)
  target_include_directories(${name} SYSTEM INTERFACE ${headers})
  target_compile_definitions(${name} INTERFACE ${ARGN})
  add_library(${target} ALIAS ${name})
endfunction()
motionrack_header_library(fmt::fmt fmt format.h FMT_HEADER_ONLY=1)
motionrack_header_library(tl::expected tl expected.hpp)
motionrack_header_library(fast_float::fast_float fast_float fast_float.h)

# Only what the library needs of them is built.
foreach(module base live sim cards/mcx314)
  add_subdirectory(motionrack/${module} EXCLUDE_FROM_ALL)
endforeach()
add_subdirectory(motionrack/frontends/mcx314lib)

# ---- the archive ----
# Of 32 bits, bin32/ and lib32/ go into the same one: packaging/windows.
set(source ${PROJECT_SOURCE_DIR})
set(bits "")
if(CMAKE_SIZEOF_VOID_P EQUAL 4)
  set(bits 32)
endif()
install(TARGETS mcx314lib RUNTIME DESTINATION bin${bits} ARCHIVE DESTINATION lib${bits})
install(FILES ${motionrack_mcx314lib_def} DESTINATION lib${bits})
install(FILES ${source}/motionrack/frontends/mcx314lib/mcx314lib.h DESTINATION include)
install(FILES ${source}/examples/09_mcx314lib/main.c ${source}/examples/09_mcx314lib/howto.c
              ${source}/examples/09_mcx314lib/card.toml DESTINATION example)
install(FILES ${source}/LICENSE ${source}/packaging/copyright DESTINATION .)
install(FILES ${source}/packaging/windows.md DESTINATION . RENAME README.md)
set(CPACK_GENERATOR ZIP)
set(CPACK_PACKAGE_FILE_NAME motionrack-mcx314lib-${PROJECT_VERSION}-windows)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_OUTPUT_FILE_PREFIX ${PROJECT_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
include(CPack)
