# mcx314lib.dll, its import library libmcx314lib.dll.a for MinGW, and mcx314lib.def, of which MSVC makes one. The names
# are those that mcx314lib.h declares, as they are; functions are called as C functions are (cdecl).
set(header ${CMAKE_CURRENT_SOURCE_DIR}/mcx314lib.h)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${header})
file(STRINGS ${header} declared REGEX "^MCX314_API ")
set(names "")
foreach(line IN LISTS declared)
  if(NOT line MATCHES "[ *]([A-Za-z0-9_]+)\\(")
    message(FATAL_ERROR "mcx314lib.h declares something that is not a function, so it cannot be exported: ${line}")
  endif()
  string(APPEND names "    ${CMAKE_MATCH_1}\n")
endforeach()
set(motionrack_mcx314lib_def ${CMAKE_CURRENT_BINARY_DIR}/mcx314lib.def)
file(CONFIGURE OUTPUT ${motionrack_mcx314lib_def} CONTENT "LIBRARY mcx314lib.dll\nEXPORTS\n${names}" @ONLY)
set(motionrack_mcx314lib_def ${motionrack_mcx314lib_def} PARENT_SCOPE)

target_link_libraries(mcx314lib PRIVATE motionrack_mcx314_model)
target_sources(mcx314lib PRIVATE ${motionrack_mcx314lib_def})
set_target_properties(mcx314lib PROPERTIES OUTPUT_NAME mcx314lib PREFIX ""
                      RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin
                      ARCHIVE_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
# The run-time libraries of C++ are inside; the same sources make the same bytes.
target_link_options(mcx314lib PRIVATE -static LINKER:--gc-sections,--no-insert-timestamp)
