// Files that only this user may change.
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <motionrack/auth/private_files.hpp>

namespace motionrack::auth {
namespace {

using testing::HasSubstr;

constexpr uid_t another_user = 65534;

class PrivateFiles : public testing::Test {
  protected:
    PrivateFiles()
        : folder_(std::filesystem::path(testing::TempDir()) / ("private_" + std::to_string(::getpid()))),
          file_((folder_ / "users.json").string()) {
        std::filesystem::create_directory(folder_);
        std::ofstream(file_) << "{}";
        ::chmod(folder_.c_str(), 0755);
        ::chmod(file_.c_str(), 0600);
    }
    ~PrivateFiles() override { std::filesystem::remove_all(folder_); }
    std::string refused() const {
        const Result<void> checked = check_writers(file_, "The users file");
        return checked ? std::string() : checked.error().message;
    }
    const std::filesystem::path folder_;
    const std::string file_;
};

TEST_F(PrivateFiles, OfThisUserAreAccepted) {
    EXPECT_EQ(refused(), "");
    ::chmod(file_.c_str(), 0620);
    EXPECT_THAT(refused(), HasSubstr("Others may write the users file (mode 620)"));
}

TEST_F(PrivateFiles, OfAnotherUserAreRefused) {
    if (::geteuid() != 0) GTEST_SKIP() << "only root can give a file to another user";
    ASSERT_EQ(::chown(file_.c_str(), another_user, another_user), 0);
    EXPECT_THAT(refused(), HasSubstr("Another user (uid 65534) owns the users file"));
    ASSERT_EQ(::chown(file_.c_str(), 0, 0), 0);
    ASSERT_EQ(::chown(folder_.c_str(), another_user, another_user), 0);
    EXPECT_THAT(refused(), HasSubstr("Another user (uid 65534) may replace the users file"));
}

}  // namespace
}  // namespace motionrack::auth
