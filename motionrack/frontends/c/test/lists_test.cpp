// mr_quantities and mr_faults list every quantity and fault of a rack, with correct ranges.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <motionrack/frontends/c/test/world.hpp>
#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/quantities.hpp>
#include <motionrack/rack/session.hpp>
#include <set>
#include <string>
#include <tests/source_root.hpp>
#include <utility>
#include <vector>

namespace motionrack::c_test {
namespace {

struct Quantity {
    std::string name, meaning, unit;
    double min, max;
    bool can_set;
};
struct Fault {
    std::string name, target, meaning, unit;
    double min, max;
};

std::vector<Quantity> quantities(mr_rack* rack) {
    std::vector<Quantity> out;
    EXPECT_EQ(mr_quantities(
                  rack,
                  [](void* user, const mr_quantity* one) {
                      static_cast<std::vector<Quantity>*>(user)->push_back(
                          {one->name, one->meaning, one->unit, one->min, one->max, one->can_set == 1});
                  },
                  &out),
              MR_OK)
        << mr_last_error();
    return out;
}

std::vector<Fault> faults(mr_rack* rack) {
    std::vector<Fault> out;
    EXPECT_EQ(mr_faults(
                  rack,
                  [](void* user, const mr_fault_info* one) {
                      static_cast<std::vector<Fault>*>(user)->push_back(
                          {one->name, one->target, one->meaning, one->unit, one->min, one->max});
                  },
                  &out),
              MR_OK)
        << mr_last_error();
    return out;
}

/// Racks with one card of each type, and the example racks, which together have all parts.
std::vector<std::string> racks() {
    std::vector<std::string> out = {with_switches};
    for (const std::string_view type : rack::card_type_names()) out.push_back(fmt::format("card.c1 = \"{}\"", type));
    for (const char* example : {"racks/router.toml", "racks/marking.toml", "racks/stage.toml",
                                "11_carriage/machine.toml", "13_stage/machine.toml", "14_line/machine.toml",
                                "15_panel/demonstration.toml", "16_probe/machine.toml", "grating_bus/crate.toml"})
        if (std::filesystem::exists(source_root / "examples" / example))
            out.push_back((source_root / "examples" / example).string());
    // Encoder lines of an axis, wired to another card.
    out.emplace_back(
        "[card.c1]\ntype = \"mcx314\"\n[card.i1]\ntype = \"ioflex02\"\n[axis.X]\ncard = \"c1\"\nchannel = \"x\"\n"
        "encoder_counts_per_rev = 4000\n[wires]\n\"i1.a0\" = \"X.enc_a\"\n\"i1.b0\" = \"X.enc_b\"\n");
    return out;
}

class CLists : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Racks, CLists, testing::ValuesIn(racks()));

TEST_P(CLists, HaveEveryQuantityOfTheRack) {
    World world(GetParam().c_str());
    const auto session = *rack::Session::open(GetParam());
    std::set<std::string> known, reported;
    for (const rack::QuantitiesOfPart& of : rack::quantities_of(session->rack()))
        for (const rack::Quantity& one : of.quantities) known.insert(of.part + "." + one.name);
    for (const auto& card : session->rack().cards())
        for (const std::string_view name : card->quantity_names()) known.insert(card->name() + "." + std::string(name));
    for (const Quantity& one : quantities(world)) {
        EXPECT_TRUE(reported.insert(one.name).second) << one.name << " is told twice";
        EXPECT_FALSE(one.meaning.empty()) << one.name;
        const double value = world.part(one.name.c_str());
        EXPECT_GE(value, one.min) << one.name;
        EXPECT_LE(value, one.max) << one.name;
    }
    EXPECT_EQ(reported, known);
}

TEST_P(CLists, StateWhichQuantitiesCanBeSetAndTheirRange) {
    World world(GetParam().c_str());
    for (const Quantity& one : quantities(world)) {
        const auto set = [&](double value) {
            World copy(world.rack);
            return mr_part_set(copy, one.name.c_str(), value);
        };
        if (!one.can_set) {
            EXPECT_EQ(set(world.part(one.name.c_str())), MR_REFUSED) << one.name;
            continue;
        }
        const double span = one.max - one.min;
        ASSERT_GT(span, 0) << one.name;
        EXPECT_EQ(set(one.min + 1e-9 * span), MR_OK) << one.name << mr_last_error();
        EXPECT_EQ(set(one.max - 1e-9 * span), MR_OK) << one.name << mr_last_error();
        EXPECT_EQ(set(one.min - 1e-3 * span), MR_REFUSED) << one.name;
        EXPECT_EQ(set(one.max + 1e-3 * span), MR_REFUSED) << one.name;
    }
}

TEST_P(CLists, HaveEveryFaultOfTheRackWithItsRange) {
    World world(GetParam().c_str());
    const auto session = *rack::Session::open(GetParam());
    std::set<std::pair<std::string, std::string>> known, reported;
    for (const rack::FaultTarget& target : rack::fault_targets(session->rack()))
        for (const std::string_view name : target.faults) known.insert({target.name, std::string(name)});
    for (const Fault& one : faults(world)) {
        EXPECT_TRUE(reported.insert({one.target, one.name}).second) << one.name << " is told twice";
        EXPECT_FALSE(one.meaning.empty()) << one.name;
        const auto inject = [&](double value) {
            World copy(world.rack);
            return mr_fault(copy, fmt::format("{}={:.17g}", one.name, value).c_str(), one.target.c_str());
        };
        for (const double good : {one.min, one.max, std::clamp(1.0, one.min, one.max)})
            EXPECT_EQ(inject(good), MR_OK) << one.target << " " << one.name << " " << good << mr_last_error();
        if (one.min == 0 && one.max == 1 && one.unit.empty()) continue;  // any nonzero value is the fault
        const double beyond = 1e-3 * std::max(1.0, one.max) + 1;
        EXPECT_EQ(inject(one.max + beyond), MR_REFUSED) << one.target << " " << one.name;
        EXPECT_EQ(inject(one.min - beyond), MR_REFUSED) << one.target << " " << one.name;
    }
    EXPECT_EQ(reported, known);
}

TEST(CListsOfEverything, HaveEveryFaultOfAnAxis) {
    std::set<std::string> reported;
    for (const std::string& rack : racks()) {
        World world(rack.c_str());
        for (const Fault& one : faults(world)) reported.insert(one.name);
    }
    for (const std::string_view name : rack::fault_names()) EXPECT_TRUE(reported.count(std::string(name))) << name;
}

TEST(CListsOfEverything, NullPointersAreBadCalls) {
    World world;
    EXPECT_EQ(mr_quantities(
                  nullptr, [](void*, const mr_quantity*) {}, nullptr),
              MR_BAD_CALL);
    EXPECT_EQ(mr_quantities(world, nullptr, nullptr), MR_BAD_CALL);
    EXPECT_EQ(mr_faults(
                  nullptr, [](void*, const mr_fault_info*) {}, nullptr),
              MR_BAD_CALL);
    EXPECT_EQ(mr_faults(world, nullptr, nullptr), MR_BAD_CALL);
}

}  // namespace
}  // namespace motionrack::c_test
