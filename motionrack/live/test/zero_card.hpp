// /dev/zero as a real card: it is stationary, whatever is written to it.
#pragma once

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>

namespace motionrack::live::test {

/// A card can be open only once, and /dev/zero is one card for all tests of this computer: the others wait.
class ZeroCard {
  public:
    ZeroCard() { ::flock(lock_, LOCK_EX); }
    ~ZeroCard() { ::close(lock_); }
    ZeroCard(const ZeroCard&) = delete;
    ZeroCard& operator=(const ZeroCard&) = delete;

  private:
    int lock_ = ::open((std::filesystem::temp_directory_path() / "motionrack_zero_card.lock").c_str(),
                       O_CREAT | O_RDWR | O_CLOEXEC, 0666);
};

}  // namespace motionrack::live::test
