# Cross compilers of Debian 12 for Windows, 64 bits: package g++-mingw-w64-x86-64-posix.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
if(NOT motionrack_mingw)  # windows32.toolchain.cmake has another
  set(motionrack_mingw x86_64-w64-mingw32)
endif()
set(CMAKE_C_COMPILER ${motionrack_mingw}-gcc-posix)
set(CMAKE_CXX_COMPILER ${motionrack_mingw}-g++-posix)
set(CMAKE_FIND_ROOT_PATH /usr/${motionrack_mingw})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
