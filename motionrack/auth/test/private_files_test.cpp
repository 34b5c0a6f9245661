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
    std::string refused() const { return refused(file_); }
    static std::string refused(const std::string& path) {
        const Result<void> checked = check_writers(path, "The users file");
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

TEST_F(PrivateFiles, OfRootAreAcceptedByEveryUser) {
    const bool is_root = ::geteuid() == 0;
    if (is_root) {
        ASSERT_EQ(::seteuid(another_user), 0);
    }
    const std::string said = refused("/etc/passwd");
    if (is_root) {
        ASSERT_EQ(::seteuid(0), 0);
    }
    EXPECT_EQ(said, "");
}

TEST_F(PrivateFiles, AreCheckedInTheWorkingFolderToo) {
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder_);
    EXPECT_EQ(refused("users.json"), "");
    ::chmod(folder_.c_str(), 0777);
    const std::string said = refused("users.json");
    std::filesystem::current_path(before);
    EXPECT_THAT(said, HasSubstr("Others may replace the users file: its folder . is open to them (mode 777)"));
}

TEST_F(PrivateFiles, ThatAreMissingAreAcceptedAsFarAsTheirFolderIs) {
    EXPECT_EQ(refused((folder_ / "nothing.json").string()), "");
    EXPECT_EQ(refused((folder_ / "nowhere" / "nothing.json").string()), "") << "its folder is created later";
    EXPECT_THAT(refused(file_ + "/nothing.json"), HasSubstr("The users file cannot be checked: Not a directory"));
}

TEST_F(PrivateFiles, OfSecretsMustExist) {
    const Result<void> checked = check_readers((folder_ / "nothing.key").string(), "The key");
    ASSERT_FALSE(checked);
    EXPECT_EQ(checked.error().kind, ErrorKind::io);
    EXPECT_THAT(checked.error().message, HasSubstr("The key cannot be checked: No such file or directory"));
}

}  // namespace
}  // namespace motionrack::auth
