// The card's map: constants follow from the tables, and the reference page is what the tables say.
#include <gtest/gtest.h>

#include <fstream>
#include <motionrack/base/describe.hpp>
#include <motionrack/cards/mcx314/map.hpp>
#include <sstream>

namespace motionrack::mcx314 {
namespace {

TEST(Mcx314Map, ConstantsAreThoseOfTheDocumentedMap) {
    EXPECT_EQ(reg::WR5, 0x0Au);
    EXPECT_EQ(reg::RR7, 0x0Eu);
    EXPECT_EQ(cmd::LINE3, 0x31u);
    EXPECT_EQ(cmd::READ_CV, 0x12u);
    EXPECT_TRUE(field("RR0", "CNEXT").test(0x0200));
    EXPECT_EQ(field("RR0", "ZONE").get(0x1400), 5u);
    EXPECT_EQ(field("WR2", "PIND").set(0xF3FF, 2), 0xFBFF);
}

TEST(Mcx314Map, TheReferencePageIsCurrent) {
    std::ifstream file(std::string(MOTIONRACK_SOURCE_DIR) + "/docs/reference/mcx314.md");
    std::stringstream stored;
    stored << file.rdbuf();
    EXPECT_EQ(stored.str(), describe_markdown(card_map()))
        << "make it anew: motionrack describe mcx314 --markdown > docs/reference/mcx314.md";
}

}  // namespace
}  // namespace motionrack::mcx314
