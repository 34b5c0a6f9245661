// `motionrack docs`: the documentation on this computer, or the sentence that says how to get it.
#include <gmock/gmock.h>

#include <tests/ran.hpp>

namespace motionrack {
namespace {

using testing::HasSubstr;

class DocsCommand : public InFolder {};

TEST_F(DocsCommand, WithoutASiteReportsHowToInstallOne) {
    const Ran ran = motionrack("docs --folder nowhere");
    EXPECT_EQ(ran.code, 5);
    EXPECT_THAT(ran.out, HasSubstr("The documentation was not found in nowhere. Nothing was served."));
    EXPECT_THAT(ran.out, HasSubstr("motionrack-doc"));
}

TEST_F(DocsCommand, PrintsItsAddressAndEndsByCtrlC) {
    std::filesystem::create_directories(folder / "site");
    write("site/index.html", "<!doctype html>");
    const Ran ran = shell(interrupted(MOTIONRACK_PROGRAM " docs --port 0 --folder site", "0.2"));
    EXPECT_EQ(ran.code, 0);
    EXPECT_THAT(ran.out, HasSubstr("The documentation is at http://127.0.0.1:"));
}

}  // namespace
}  // namespace motionrack
