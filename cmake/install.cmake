# What `cmake --install` puts where, so that strangers find it by find_package(motionrack) or pkg-config. Nothing that
# is installed knows the prefix: the tree may be moved. The components program, library, dev (and python, see python/)
# are packages of their own: cmake/package.cmake.
include(CMakePackageConfigHelpers)

get_property(modules GLOBAL PROPERTY motionrack_modules)

# ---- libraries ----
install(TARGETS motionrack_flags ${modules} EXPORT motionrack-cpp ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        COMPONENT dev)

# motionrack_c_library(TARGET EXPORT_NAME HEADERS): a shared C library, for others motionrack::EXPORT_NAME;
# and its archive, with all modules in it, for programs that are to stand alone. HEADERS: where its PUBLIC_HEADER goes.
function(motionrack_c_library target export_name headers)
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${export_name})
  install(TARGETS ${target} EXPORT motionrack-c
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT dev
          PUBLIC_HEADER DESTINATION ${headers} COMPONENT dev INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  set(objects $<TARGET_OBJECTS:${target}>)
  foreach(module IN LISTS modules)
    get_target_property(type ${module} TYPE)
    if(type STREQUAL "STATIC_LIBRARY")
      list(APPEND objects $<TARGET_OBJECTS:${module}>)
    endif()
  endforeach()
  add_library(${target}_archive STATIC ${objects})
  set_target_properties(${target}_archive PROPERTIES OUTPUT_NAME $<TARGET_PROPERTY:${target},OUTPUT_NAME>
                        LINKER_LANGUAGE CXX
                        ARCHIVE_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
  install(TARGETS ${target}_archive ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
endfunction()
motionrack_c_library(motionrack_c c ${CMAKE_INSTALL_INCLUDEDIR}/motionrack)
motionrack_c_library(mcx314lib mcx314lib ${CMAKE_INSTALL_INCLUDEDIR})
motionrack_c_library(databoard4002lib databoard4002lib ${CMAKE_INSTALL_INCLUDEDIR})
motionrack_c_library(rtc5sim rtc5sim ${CMAKE_INSTALL_INCLUDEDIR})

# ---- headers: those of the modules; the program and the C library have none but c.h ----
install(DIRECTORY ${PROJECT_SOURCE_DIR}/motionrack DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev
        FILES_MATCHING PATTERN "*.hpp" PATTERN test EXCLUDE PATTERN windows EXCLUDE PATTERN frontends EXCLUDE
        PATTERN report EXCLUDE PATTERN wire.hpp EXCLUDE REGEX "/(hdf5|nats|dds|late)_library[.]hpp$" EXCLUDE)

set(pascal ${PROJECT_SOURCE_DIR}/motionrack/frontends/pascal)
install(FILES ${pascal}/uMotionrack.pas ${pascal}/uIOFlex2.pas ${pascal}/uFlex2Pos.pas ${pascal}/uFlx2Pos.pas
        DESTINATION ${CMAKE_INSTALL_DATADIR}/motionrack/pascal COMPONENT dev)

# ---- the cards' logic, for those who build one ----
install(DIRECTORY ${PROJECT_SOURCE_DIR}/hdl DESTINATION ${CMAKE_INSTALL_DATADIR}/motionrack COMPONENT dev)

# ---- find_package ----
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/motionrack)
install(EXPORT motionrack-cpp NAMESPACE motionrack:: DESTINATION ${package_dir} COMPONENT dev)
install(EXPORT motionrack-dds NAMESPACE motionrack:: DESTINATION ${package_dir} COMPONENT dev)
install(EXPORT motionrack-mark NAMESPACE motionrack:: DESTINATION ${package_dir} COMPONENT dev)
install(EXPORT motionrack-c NAMESPACE motionrack:: DESTINATION ${package_dir} COMPONENT dev)
set(motionrack_find_dependencies "")
foreach(package IN LISTS motionrack_public_packages)
  string(APPEND motionrack_find_dependencies "  find_dependency(${package})\n")
endforeach()
configure_package_config_file(cmake/motionrackConfig.cmake.in ${PROJECT_BINARY_DIR}/motionrackConfig.cmake
                              INSTALL_DESTINATION ${package_dir} NO_SET_AND_CHECK_MACRO
                              NO_CHECK_REQUIRED_COMPONENTS_MACRO)
# Before 1.0 the interface may change with each minor version.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/motionrackConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/motionrackConfig.cmake ${PROJECT_BINARY_DIR}/motionrackConfigVersion.cmake
        DESTINATION ${package_dir} COMPONENT dev)

# ---- pkg-config: folders are told from where the file lies ----
function(motionrack_pc_folder out folder)
  if(IS_ABSOLUTE "${folder}")
    set(${out} "${folder}" PARENT_SCOPE)
  else()
    set(${out} "\${prefix}/${folder}" PARENT_SCOPE)
  endif()
endfunction()
set(pc_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
if(IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}")
  set(pc_prefix ${CMAKE_INSTALL_PREFIX})
else()
  file(RELATIVE_PATH up /${pc_dir} /)
  string(REGEX REPLACE "/$" "" up "${up}")
  set(pc_prefix "\${pcfiledir}/${up}")
endif()
motionrack_pc_folder(pc_libdir "${CMAKE_INSTALL_LIBDIR}")
motionrack_pc_folder(pc_includedir "${CMAKE_INSTALL_INCLUDEDIR}")
# What a C compiler does not link by itself.
set(runtime ${motionrack_linked_libraries} ${CMAKE_CXX_IMPLICIT_LINK_LIBRARIES})
list(REMOVE_DUPLICATES runtime)
list(FILTER runtime EXCLUDE REGEX "^(c|gcc|gcc_s|gcc_eh|.*/.*)$")
list(TRANSFORM runtime PREPEND "-l")
list(JOIN runtime " " pc_libs_private)
configure_file(cmake/motionrack.pc.in ${PROJECT_BINARY_DIR}/motionrack.pc @ONLY)
configure_file(cmake/mcx314lib.pc.in ${PROJECT_BINARY_DIR}/mcx314lib.pc @ONLY)
configure_file(cmake/databoard4002lib.pc.in ${PROJECT_BINARY_DIR}/databoard4002lib.pc @ONLY)
configure_file(cmake/rtc5sim.pc.in ${PROJECT_BINARY_DIR}/rtc5sim.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/motionrack.pc ${PROJECT_BINARY_DIR}/mcx314lib.pc
              ${PROJECT_BINARY_DIR}/databoard4002lib.pc ${PROJECT_BINARY_DIR}/rtc5sim.pc
        DESTINATION ${pc_dir} COMPONENT dev)

# ---- the program, and what it says of itself ----
install(TARGETS motionrack RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
set(pages ${PROJECT_BINARY_DIR}/pages)
file(MAKE_DIRECTORY ${pages})
add_custom_command(OUTPUT ${pages}/motionrack ${pages}/motionrack.1
                   COMMAND motionrack completion > ${pages}/motionrack
                   COMMAND motionrack manual > ${pages}/motionrack.1
                   DEPENDS motionrack COMMENT "The program's manual page and shell completion" VERBATIM)
add_custom_target(motionrack_pages ALL DEPENDS ${pages}/motionrack ${pages}/motionrack.1)
install(FILES ${pages}/motionrack DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
install(FILES ${pages}/motionrack.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)

# ---- the operator panel's page, if it was built (cmake/setup.sh, build_page) ----
install(DIRECTORY ${PROJECT_BINARY_DIR}/share/motionrack/page DESTINATION ${CMAKE_INSTALL_DATADIR}/motionrack
        COMPONENT program OPTIONAL)

# ---- the systemd unit ----
install(FILES ${PROJECT_SOURCE_DIR}/packaging/motionrack.service DESTINATION lib/systemd/system COMPONENT program)

# ---- examples and rack files, and how frames use the network ----
install(FILES ${PROJECT_SOURCE_DIR}/motionrack/dds/cyclonedds.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/motionrack
        COMPONENT program)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples DESTINATION ${CMAKE_INSTALL_DATADIR}/motionrack COMPONENT program)

# ---- the licence, those of all parts of others, what is new; packaging/copyright: cmake/package.cmake ----
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/CHANGELOG.md
              ${PROJECT_SOURCE_DIR}/docs/reference/third-party.md
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/motionrack COMPONENT program)
