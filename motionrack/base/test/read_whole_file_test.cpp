// Files that a user may name.
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <motionrack/base/read_whole_file.hpp>
#include <thread>

namespace motionrack {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr ReadLimit short_one{std::size_t{1} << 20, "a program"};

class ReadWholeFile : public testing::Test {
  protected:
    ReadWholeFile() : path_((fs::temp_directory_path() / ("read-" + std::to_string(::getpid()))).string()) {}
    ~ReadWholeFile() override { fs::remove_all(path_); }
    std::string sentence() const {
        const Result<std::string> text = read_whole_file(path_, short_one);
        return text ? "" : text.error().message;
    }
    std::string path_;
};

TEST_F(ReadWholeFile, IsReadWholeUpToTheSizeLimit) {
    const std::string text((1 << 20) - 1, 'x');
    std::ofstream(path_) << text;
    EXPECT_EQ(*read_whole_file(path_, short_one), text);
    std::ofstream(path_, std::ios::app) << "xx";
    EXPECT_THAT(sentence(), HasSubstr("has more than 1 MiB, the limit of a program"));
}

TEST_F(ReadWholeFile, WithoutAnEndIsRejected) {
    const Result<std::string> zero = read_whole_file("/dev/zero", short_one);
    ASSERT_FALSE(zero);
    EXPECT_EQ(zero.error().kind, ErrorKind::invalid_input);
    EXPECT_THAT(zero.error().message, HasSubstr("/dev/zero has more than 1 MiB"));
    EXPECT_EQ(*read_whole_file("/dev/null", short_one), "");
}

TEST_F(ReadWholeFile, IsRejectedIfMissingOrAFolder) {
    EXPECT_THAT(sentence(), HasSubstr("No such file"));
    fs::create_directory(path_);
    EXPECT_THAT(sentence(), HasSubstr("it is a folder, not a file"));
}

TEST_F(ReadWholeFile, MayBeAFifoWithAWriter) {
    ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
    EXPECT_THAT(sentence(), HasSubstr("a FIFO to which nothing was written"));
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    std::thread writer([&] {
        for (int i = 0; i < 10; ++i) EXPECT_EQ(::write(ends[1], "G0 X1\n", 6), 6);
        ::close(ends[1]);
    });
    EXPECT_EQ(read_whole_file("/proc/self/fd/" + std::to_string(ends[0]), short_one)->size(), 60u);
    writer.join();
    ::close(ends[0]);
}

}  // namespace
}  // namespace motionrack
