// Recordings of jobs whose end fails.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <motionrack/rack/job_recorder.hpp>
#include <motionrack/rack/template.hpp>
#include <string>

namespace motionrack::rack {
namespace {

TEST(JobRecorder, ReportsTheErrorOfItsEndAtEachFurtherEnd) {
    const std::string path =
        (std::filesystem::temp_directory_path() / ("motionrack_job_recorder_" + std::to_string(::getpid()) + ".h5"))
            .string();
    Rack rack(*read_rack_text(*rack_template("single")).config);
    auto recorder = JobRecorder::create(rack, path, {});
    ASSERT_TRUE(recorder) << recorder.error().text();
    rack.start();
    (*recorder)->begin();
    rack.kernel().run_until(milliseconds(2));
    std::filesystem::remove(path + ".incomplete");
    const Result<void> first = (*recorder)->finish({}, {});
    ASSERT_FALSE(first);
    rack.kernel().run_until(milliseconds(4));
    (*recorder)->drain();
    (*recorder)->input({milliseconds(3), "stop"});
    (*recorder)->sample({}, 0);
    const Result<void> again = (*recorder)->finish({}, {});
    ASSERT_FALSE(again);
    EXPECT_EQ(again.error().message, first.error().message);
    EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace motionrack::rack
