#include <gtest/gtest.h>

#include <cmath>
#include <motionrack/base/late_library.hpp>

namespace motionrack {
namespace {

TEST(LateLibrary, FindsAnExportedFunction) {
    LateLibrary library("libm.so.6");
    double (*cosine)(double) = nullptr;
    library.find("cos", cosine);
    EXPECT_EQ(library.trouble(), "");
    ASSERT_NE(cosine, nullptr);
    EXPECT_EQ(cosine(0), 1);
}

TEST(LateLibrary, ReportsTheMissingFunction) {
    LateLibrary nowhere("libnowhere.so.1");
    EXPECT_NE(nowhere.trouble().find("libnowhere.so.1"), std::string::npos) << nowhere.trouble();
    LateLibrary library("libm.so.6");
    double (*missing)(double) = std::cos;
    library.find("no_such_function", missing);
    EXPECT_EQ(missing, nullptr);
    EXPECT_NE(library.trouble().find("no_such_function"), std::string::npos) << library.trouble();
}

}  // namespace
}  // namespace motionrack
