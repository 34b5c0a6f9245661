# The packages that the library and the program are made with, each with the oldest version that is known to do. This is
# the one list: the top CMakeLists.txt looks for them here, and motionrackConfig.cmake looks for the public ones where
# the library is installed.

# Whoever compiles or links against the installed modules needs these.
set(motionrack_public_packages "fmt 9" "tl-expected 1.0" "tomlplusplus 3.3" "ZLIB 1.2")
# Those of them that are libraries, as a linker calls them.
set(motionrack_linked_libraries fmt tomlplusplus z)
# Recordings: HDF5 1.10 or later, which each system calls otherwise; without MPI.
set(motionrack_hdf5_names hdf5_serial hdf5)
# Headers that only our own sources include.
set(motionrack_private_packages "nlohmann_json 3.11" "CLI11 2.1" "CycloneDDS 0.10" "pugixml 1.13" "SQLite3 3.40"
    "OpenSSL 3.0" "Boost 1.81" "Threads")

# Those of them that have no CMake package (or one that does not work), by their pkg-config names: pictures as PNG;
# NATS.
set(motionrack_private_modules "librsvg-2.0>=2.54" "cairo-png>=1.16")
set(motionrack_nats_module "libnats>=3.4")

# motionrack_soname(NAME FILE): the name in motionrack_NAME_soname by which the program loads a library once something
# of it is needed (motionrack/base/late_library.hpp).
function(motionrack_soname name file)
  execute_process(COMMAND ${CMAKE_OBJDUMP} -p ${file} OUTPUT_VARIABLE said COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX REPLACE ".*SONAME +([^ \n]+).*" "\\1" said "${said}")
  set(motionrack_${name}_soname "${said}" PARENT_SCOPE)
endfunction()

macro(motionrack_find_packages)
  foreach(package IN LISTS motionrack_public_packages motionrack_private_packages)
    separate_arguments(package UNIX_COMMAND "${package}")
    find_package(${package} REQUIRED)
  endforeach()
  find_package(PkgConfig REQUIRED)
  pkg_check_modules(RSVG REQUIRED IMPORTED_TARGET ${motionrack_private_modules})
  pkg_check_modules(NATS REQUIRED IMPORTED_TARGET ${motionrack_nats_module})
  find_path(MOTIONRACK_HDF5_HEADERS hdf5.h PATH_SUFFIXES hdf5/serial REQUIRED)
  find_library(MOTIONRACK_HDF5_LIBRARY NAMES ${motionrack_hdf5_names} REQUIRED)
  motionrack_soname(hdf5 ${MOTIONRACK_HDF5_LIBRARY})
  list(GET NATS_LINK_LIBRARIES 0 motionrack_nats_file)
  motionrack_soname(nats ${motionrack_nats_file})
  get_target_property(motionrack_dds_file CycloneDDS::ddsc LOCATION)
  motionrack_soname(dds ${motionrack_dds_file})
endmacro()
