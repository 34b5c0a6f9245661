# The same for programs of 32 bits: package g++-mingw-w64-i686-posix. Numbers with a point are those of SSE2, as in 64
# bits; callers may have aligned the stack to four bytes only.
set(motionrack_mingw i686-w64-mingw32)
set(CMAKE_CXX_FLAGS_INIT "-msse2 -mfpmath=sse -mstackrealign")
include(${CMAKE_CURRENT_LIST_DIR}/windows.toolchain.cmake)
set(CMAKE_SYSTEM_PROCESSOR i686)
