// Windows does not provide cards as files, so none is ever opened.
#include <fmt/format.h>

#include <motionrack/live/file.hpp>

namespace motionrack::live {

Result<File> File::open(const std::string& path, int) {
    return fail(ErrorKind::refused,
                fmt::format("{} cannot be a card: Windows does not show cards as files. Nothing was opened. Use "
                            "port:inpoutx64.dll,offset=N for a card at I/O ports.",
                            path));
}

File::~File() = default;

}  // namespace motionrack::live
