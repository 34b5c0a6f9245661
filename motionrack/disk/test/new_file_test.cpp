// A file is complete or unchanged, and no command overwrites its inputs.
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <motionrack/disk/new_file.hpp>
#include <motionrack/disk/outputs.hpp>

namespace motionrack::disk {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class AtomicFile : public testing::Test {
  protected:
    AtomicFile() : folder_(fs::path(testing::TempDir()) / ("disk_" + std::to_string(::getpid()))) {
        fs::create_directories(folder_);
    }
    ~AtomicFile() override { fs::remove_all(folder_); }
    std::string at(const char* name) const { return (folder_ / name).string(); }
    static std::string text_of(const std::string& path) {
        std::ifstream in(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    static void put(const std::string& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

    fs::path folder_;
};

TEST_F(AtomicFile, GetsItsNameWhenItIsComplete) {
    put(at("a"), "old");
    ::chmod(at("a").c_str(), 0640);
    auto file = NewFile::create(at("a"));
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_TRUE(file->write("new "));
    EXPECT_TRUE(file->write("text"));
    EXPECT_EQ(text_of(at("a")), "old");
    ASSERT_TRUE(file->commit());
    EXPECT_EQ(text_of(at("a")), "new text");
    EXPECT_FALSE(fs::exists(at("a.incomplete")));
    EXPECT_EQ(static_cast<int>(fs::status(at("a")).permissions()), 0640);
    put(at("b.incomplete"), "that others can read");
    std::ifstream other(at("b.incomplete"));
    ASSERT_TRUE(write_whole(at("b"), "secret", Rights::owner));
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(other), {}), "that others can read");
    EXPECT_EQ(static_cast<int>(fs::status(at("b")).permissions()), 0600);
}

TEST_F(AtomicFile, WithoutACommitLeavesTheOldFile) {
    put(at("a"), "old");
    {
        auto file = NewFile::create(at("a"));
        EXPECT_TRUE(file->write("half"));
    }
    EXPECT_EQ(text_of(at("a")), "old");
    EXPECT_FALSE(fs::exists(at("a.incomplete")));
    {
        auto file = NewFile::create(at("a"), NewFile::Incomplete::keep);
        EXPECT_TRUE(file->write("half"));
    }
    EXPECT_EQ(text_of(at("a")), "old");
    EXPECT_EQ(text_of(at("a.incomplete")), "half");
}

TEST_F(AtomicFile, ReportsWhyItIsNotWritten) {
    const auto reason = [](const std::string& path) { return NewFile::create(path).error().message; };
    EXPECT_EQ(reason(at("nowhere/a")), "No such file or directory");
    EXPECT_EQ(reason(folder_.string()), "Is a directory");
    put(at("a"), "mine");
    fs::create_symlink("a", at("link"));
    EXPECT_THAT(reason(at("link")), HasSubstr("symbolic link"));
    auto first = NewFile::create(at("b"));
    EXPECT_THAT(reason(at("b")), HasSubstr("another program is writing it"));
    EXPECT_TRUE(first->write("first"));
    EXPECT_TRUE(first->commit());
    EXPECT_EQ(text_of(at("b")), "first");
    EXPECT_EQ(text_of(at("a")), "mine");
}

TEST_F(AtomicFile, OnAFullDiskLeavesTheOldFile) {
    put(at("a"), "old");
    struct rlimit before {};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto old = ::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{1000, before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    const Result<void> done = write_whole(at("a"), std::string(2000, 'x'));
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
    ::signal(SIGXFSZ, old);
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().message, "File too large");
    EXPECT_EQ(text_of(at("a")), "old");
    EXPECT_FALSE(fs::exists(at("a.incomplete")));
}

TEST_F(AtomicFile, IsRejectedIfItsContentsDifferOnTheDisk) {
    put(at("a"), "old");
    auto file = NewFile::create(at("a"));
    EXPECT_TRUE(file->write("12.5 mm"));
    std::fstream(file->path_until_whole(), std::ios::in | std::ios::out | std::ios::binary) << "62";
    const Result<void> done = file->commit();
    ASSERT_FALSE(done);
    EXPECT_THAT(done.error().message, HasSubstr("differs from the written data"));
    EXPECT_EQ(text_of(at("a")), "old");
}

TEST_F(AtomicFile, WritesToADeviceDirectly) {
    auto nothing = NewFile::create("/dev/null");
    ASSERT_TRUE(nothing);
    EXPECT_TRUE(nothing->write("text"));
    EXPECT_TRUE(nothing->commit());
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
    EXPECT_EQ(write_whole("/dev/full", "text").error().message, "No space left on device");
}

TEST_F(AtomicFile, IsRefusedAsAnOutputWhereItIsReadOrALinkOrAnotherOutput) {
    put(at("in"), "in");
    fs::create_hard_link(at("in"), at("same"));
    fs::create_symlink("in", at("link"));
    const auto refused = [](const std::vector<std::string>& inputs, const std::vector<std::string>& outputs) {
        const Result<void> may = may_write(inputs, outputs);
        return may ? std::string() : may.error().message;
    };
    EXPECT_EQ(refused({at("in"), ""}, {at("out"), "", "-", "-", "/dev/null", "/dev/null"}), "");
    EXPECT_THAT(refused({at("in")}, {at("./in")}), HasSubstr("is an input"));
    EXPECT_THAT(refused({at("in")}, {at("same")}), HasSubstr("is an input"));
    EXPECT_THAT(refused({}, {at("link")}), HasSubstr("symbolic link"));
    EXPECT_THAT(refused({}, {at("out"), at("../") + folder_.filename().string() + "/out"}), HasSubstr("Two outputs"));
    EXPECT_THAT(refused({}, {at("out"), at("out.incomplete")}), HasSubstr("Two outputs"));
    put(at("out.incomplete"), "in");
    EXPECT_THAT(refused({at("out.incomplete")}, {at("out")}), HasSubstr("which is an input"));
}

}  // namespace
}  // namespace motionrack::disk
