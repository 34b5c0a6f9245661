// Publishers and subscribers on several machines, with lost packets, disconnected cables and conflicts.
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <tests/dds/machines.hpp>
#include <vector>

namespace motionrack::dds_test {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr int scales = 6;

struct Row {
    std::uint32_t sequence = 0;
    std::vector<std::int64_t> counts;
};

/// Six machines and a folder for the files of subscribers; both are removed after the test.
class Network : public testing::Test {
  protected:
    void SetUp() override {
        network_ = std::make_unique<Machines>(6);
        if (!network_->why_not().empty()) GTEST_SKIP() << network_->why_not();
        std::string pattern = (fs::temp_directory_path() / "motionrack-dds-XXXXXX").string();
        if (::mkdtemp(pattern.data())) folder_ = pattern;
    }
    void TearDown() override {
        std::error_code ignored;
        if (!folder_.empty()) fs::remove_all(folder_, ignored);
    }
    Child publish(int machine, int offset = 0) {
        return network_->start(machine, {MOTIONRACK_TEST_PUBLISHER, "good", "stage", std::to_string(period_us_),
                                         std::to_string(scales), std::to_string(offset)});
    }
    /// Starts a subscriber that writes its frames to `name`.csv and ends after `count` frames (0: never).
    Child subscribe(int machine, const std::string& name, int count = 0) {
        Command command = {MOTIONRACK_PROGRAM, "frames",     "subscribe", "--bus", "stage",
                           "--json",           "--interval", "0.02",      "--csv", file(name)};
        if (count > 0) command.insert(command.end(), {"--count", std::to_string(count)});
        return network_->start(machine, command);
    }
    std::string file(const std::string& name) const { return (folder_ / (name + ".csv")).string(); }
    std::vector<Row> rows(const std::string& name) const {
        std::ifstream in(file(name));
        std::vector<Row> out;
        std::string line, cell;
        std::getline(in, line);
        while (std::getline(in, line)) {
            std::istringstream cells(line);
            std::vector<std::string> all;
            while (std::getline(cells, cell, ',')) all.push_back(cell);
            Row row;
            row.sequence = static_cast<std::uint32_t>(std::stoul(all.at(1)));
            for (std::size_t i = 3; i < all.size(); ++i) row.counts.push_back(std::stoll(all[i]));
            out.push_back(row);
        }
        return out;
    }
    /// Checks that all rows have the positions of one publisher; returns the offset of these positions, -1 without
    /// rows.
    std::int64_t check_rows(const std::vector<Row>& rows) {
        std::set<std::int64_t> offsets;
        for (const Row& row : rows) {
            EXPECT_EQ(row.counts.size(), static_cast<std::size_t>(scales));
            for (std::size_t k = 0; k < row.counts.size(); ++k)
                offsets.insert(row.counts[k] - 1000 * std::int64_t{row.sequence} - static_cast<std::int64_t>(k));
        }
        EXPECT_EQ(offsets.size(), 1u);
        return offsets.empty() ? -1 : *offsets.begin();
    }
    std::unique_ptr<Machines> network_;
    fs::path folder_;
    int period_us_ = 2000;
};

/// Parameter: frames per second.
class NetworkAt : public Network, public testing::WithParamInterface<int> {
  protected:
    NetworkAt() { period_us_ = 1'000'000 / GetParam(); }
};

INSTANTIATE_TEST_SUITE_P(Frames, NetworkAt, testing::Values(500, 1000),
                         [](const auto& each) { return "at_" + std::to_string(each.param) + "_Hz"; });

std::int64_t count_in(const json& line, const char* name) {
    return line.contains("counts") ? line["counts"].value(name, std::int64_t{-1}) : -1;
}
Child::Condition used_at_least(std::int64_t frames) {
    return [frames](const json& line) { return count_in(line, "used") >= frames; };
}

TEST_F(Network, TenSubscribersHoldTheSameFrames) {
    Child publisher = publish(0);
    ASSERT_TRUE(publisher.wait_for([](const json& line) { return line.contains("sent"); })) << publisher.said();
    std::vector<Child> subscribers;
    for (int i = 0; i < 10; ++i) subscribers.push_back(subscribe(1 + i % 5, std::to_string(i), 300));
    std::map<std::uint32_t, std::vector<std::int64_t>> frames;
    std::map<std::uint32_t, int> holders;
    for (int i = 0; i < 10; ++i) {
        Child& subscriber = subscribers[static_cast<std::size_t>(i)];
        EXPECT_EQ(subscriber.finish(), 0) << subscriber.said();
        const std::vector<Row> got = rows(std::to_string(i));
        EXPECT_EQ(got.size(), 300u);
        EXPECT_EQ(check_rows(got), 0);
        for (const Row& row : got) {
            EXPECT_EQ(frames.emplace(row.sequence, row.counts).first->second, row.counts) << row.sequence;
            ++holders[row.sequence];
        }
        EXPECT_EQ(count_in(subscriber.last(), "other_source"), 0);
    }
    EXPECT_GT(holders.size(), 0u);
}

TEST_P(NetworkAt, CountsWhatALossyLinkLosesAndUsesTheRest) {
    Child publisher = publish(0), subscriber = subscribe(1, "lossy");
    ASSERT_TRUE(subscriber.wait_for(used_at_least(50))) << subscriber.said();
    if (!network_->begin_loss(1)) GTEST_SKIP() << "Nothing was tested: this kernel has neither netem nor tbf";
    EXPECT_TRUE(subscriber.wait_for([](const json& line) { return count_in(line, "lost") > 50; })) << subscriber.said();
    network_->end_loss(1);
    const std::int64_t used = count_in(subscriber.last(), "used");
    EXPECT_TRUE(subscriber.wait_for(used_at_least(used + 100))) << subscriber.said();
    subscriber.send(SIGINT);
    EXPECT_EQ(subscriber.finish(), 130);
    const std::vector<Row> got = rows("lossy");
    EXPECT_EQ(check_rows(got), 0);
    ASSERT_FALSE(got.empty());
    EXPECT_EQ(count_in(subscriber.last(), "used"), static_cast<std::int64_t>(got.size()));
    EXPECT_EQ(
        count_in(subscriber.last(), "used") + count_in(subscriber.last(), "late") + count_in(subscriber.last(), "lost"),
        std::int64_t{got.back().sequence} - std::int64_t{got.front().sequence} + 1);
}

TEST_P(NetworkAt, MarksItsDataStaleWhileTheLinkIsCutAndContinuesAfterIt) {
    Child publisher = publish(0), subscriber = subscribe(1, "cut");
    ASSERT_TRUE(subscriber.wait_for(used_at_least(50))) << subscriber.said();
    network_->set_link(1, false);
    EXPECT_TRUE(subscriber.wait_for([](const json& line) {
        return line.value("stale", false) && line.value("age_ms", 0.0) > 600;
    })) << subscriber.said();
    const std::int64_t lost = count_in(subscriber.last(), "lost"), used = count_in(subscriber.last(), "used");
    network_->set_link(1, true);
    EXPECT_TRUE(subscriber.wait_for([&](const json& line) {
        return count_in(line, "lost") > lost + 50 && !line.value("stale", true);
    })) << subscriber.said();
    EXPECT_TRUE(subscriber.wait_for(used_at_least(used + 100)));
    EXPECT_EQ(count_in(subscriber.last(), "restarts"), 0);
    EXPECT_EQ(count_in(subscriber.last(), "takeovers"), 0);
    subscriber.send(SIGINT);
    subscriber.finish();
    EXPECT_EQ(check_rows(rows("cut")), 0);
    EXPECT_TRUE(subscriber.reported("stale"));
    EXPECT_TRUE(subscriber.reported("fresh"));
}

TEST_P(NetworkAt, FollowsAPublisherThatWasKilledAndRestarted) {
    Child subscriber = subscribe(1, "restart");
    {
        Child publisher = publish(0);
        ASSERT_TRUE(subscriber.wait_for(used_at_least(50))) << subscriber.said();
        publisher.send(SIGKILL);
        EXPECT_EQ(publisher.finish(), -1);
    }
    EXPECT_TRUE(subscriber.wait_for([](const json& line) {
        return line.value("stale", false) && line.value("age_ms", 0.0) > 600;
    })) << subscriber.said();
    Child again = publish(0);
    EXPECT_TRUE(subscriber.wait_for(is_event("restart"))) << subscriber.said();
    const json event = subscriber.last();
    EXPECT_EQ(event["source"]["host"], event["other"]["host"]);
    EXPECT_NE(event["source"]["id"], event["other"]["id"]);
    EXPECT_TRUE(subscriber.wait_for(used_at_least(100)));
    EXPECT_EQ(count_in(subscriber.last(), "restarts"), 1);
    EXPECT_EQ(count_in(subscriber.last(), "conflicts"), 0);
    subscriber.send(SIGINT);
    subscriber.finish();
    EXPECT_EQ(check_rows(rows("restart")), 0);
}

TEST_P(NetworkAt, EverySubscriberAndBothPublishersReportTwoOnOneBus) {
    Child first = publish(0), a = subscribe(2, "a"), b = subscribe(3, "b"), c = subscribe(4, "c");
    std::vector<Child*> subscribers = {&a, &b, &c};
    for (Child* each : subscribers) ASSERT_TRUE(each->wait_for(used_at_least(20))) << each->said();
    ASSERT_TRUE(first.wait_for([](const json& line) { return line.contains("id"); }));
    const std::string first_id = first.last()["id"];
    Child second = publish(1, 500);
    ASSERT_TRUE(second.wait_for([](const json& line) { return line.contains("id"); })) << second.said();
    const std::string second_id = second.last()["id"];
    const auto conflict = is_event("conflict");
    for (Child* each : subscribers) {
        EXPECT_TRUE(each->wait_for(conflict)) << each->said();
        EXPECT_EQ(each->last()["source"]["id"], first_id);
        EXPECT_EQ(each->last()["other"]["id"], second_id);
        EXPECT_EQ(each->last()["other"]["host"], "machine1");
        EXPECT_TRUE(each->wait_for([](const json& line) { return count_in(line, "other_source") > 100; }))
            << each->said();
    }
    EXPECT_TRUE(first.wait_for_event("conflict")) << first.said();
    EXPECT_EQ(first.last()["other"], second_id);
    // The event of its conflict may be printed before the line with its id.
    EXPECT_TRUE(second.wait_for_event("conflict")) << second.said();
    EXPECT_EQ(second.last()["other"], first_id);
    second.send(SIGKILL);
    for (Child* each : subscribers) {
        EXPECT_TRUE(each->wait_for(is_event("conflict_over"))) << each->said();
        each->send(SIGINT);
        each->finish();
    }
    for (const char* name : {"a", "b", "c"}) EXPECT_EQ(check_rows(rows(name)), 0) << "only frames of the first";
}

TEST_P(NetworkAt, CountsForeignSamplesAndUsesNone) {
    Child publisher = publish(0), bad = network_->start(1, {MOTIONRACK_TEST_PUBLISHER, "bad", "stage"}),
          subscriber = subscribe(2, "foreign");
    EXPECT_TRUE(subscriber.wait_for([](const json& line) {
        return count_in(line, "wrong_crc") > 10 && count_in(line, "foreign") > 10 && count_in(line, "malformed") > 10 &&
               count_in(line, "used") > 50;
    })) << subscriber.said();
    EXPECT_EQ(count_in(subscriber.last(), "other_source"), 0);
    subscriber.send(SIGINT);
    subscriber.finish();
    EXPECT_EQ(check_rows(rows("foreign")), 0);
    for (const char* kind : {"wrong_crc", "foreign", "malformed"}) EXPECT_TRUE(subscriber.reported(kind)) << kind;
}

TEST_P(NetworkAt, AFrozenSubscriberDelaysNoOther) {
    Child publisher = publish(0), frozen = subscribe(1, "frozen"), other = subscribe(2, "other");
    ASSERT_TRUE(frozen.wait_for(used_at_least(50))) << frozen.said();
    ASSERT_TRUE(other.wait_for(used_at_least(50))) << other.said();
    frozen.send(SIGSTOP);
    const std::int64_t used = count_in(other.last(), "used");
    EXPECT_TRUE(other.wait_for(used_at_least(used + 500))) << other.said();
    frozen.send(SIGCONT);
    const std::int64_t behind = count_in(frozen.last(), "used");
    EXPECT_TRUE(frozen.wait_for([&](const json& line) {
        return count_in(line, "used") > behind + 100 && !line.value("stale", true);
    })) << frozen.said();
    for (Child* each : {&frozen, &other}) {
        each->send(SIGINT);
        each->finish();
    }
    EXPECT_EQ(check_rows(rows("frozen")), 0);
    EXPECT_EQ(check_rows(rows("other")), 0);
}

TEST_F(Network, ARackOnOneMachineIsReadOnAnother) {
    const std::string rack = (folder_ / "rack.toml").string();
    std::ofstream(rack) << "[card.host]\ntype = \"grating_bus\"\nscales = 6\nperiod_us = 2000\n";
    Child subscriber = network_->start(1, {MOTIONRACK_PROGRAM, "frames", "subscribe", "--bus", "stage", "--json",
                                           "--interval", "0.02", "--scales", "6"});
    Child publisher = network_->start(0, {MOTIONRACK_PROGRAM, "frames", "publish", rack, "--bus", "stage", "--json",
                                          "--fault", "host.off=1@1s", "--fault", "host.off=0@2s", "--duration", "3"});
    ASSERT_TRUE(subscriber.wait_for(is_event("joined"))) << subscriber.said();
    EXPECT_EQ(subscriber.last()["source"]["host"], "machine0");
    EXPECT_TRUE(subscriber.wait_for(is_event("stale"))) << "the host is off: " << subscriber.said();
    EXPECT_TRUE(subscriber.wait_for([](const json& line) {
        return line.value("stale", true) == false && line.value("time_s", 0.0) > 2;
    })) << subscriber.said();
    EXPECT_EQ(subscriber.last()["positions"].size(), 6u);
    EXPECT_EQ(count_in(subscriber.last(), "takeovers") + count_in(subscriber.last(), "restarts"), 0);
    EXPECT_EQ(publisher.finish(), 0) << publisher.said();
    EXPECT_GT(publisher.last().value("sent", 0), 500);
}

TEST_F(Network, CardsOfARackOnAnotherMachineHoldTheFrames) {
    const std::string rack = (folder_ / "rack.toml").string(), listeners = (folder_ / "listeners.toml").string();
    std::ofstream(rack) << "[card.host]\ntype = \"grating_bus\"\nscales = 6\nperiod_us = 2000\n";
    std::ofstream(listeners) << "[card.r1]\ntype = \"grating_bus\"\nrole = \"remote\"\nscales = 6\nperiod_us = 2000\n";
    const auto state_is = [](const char* state) {
        return [state](const json& line) { return line.contains("cards") && line["cards"][0]["state"] == state; };
    };
    Child feed = network_->start(
        1, {MOTIONRACK_PROGRAM, "frames", "feed", listeners, "--bus", "stage", "--json", "--interval", "0.02"});
    ASSERT_TRUE(feed.wait_for(state_is("no frame"))) << feed.said();
    Child publisher = network_->start(
        0, {MOTIONRACK_PROGRAM, "frames", "publish", rack, "--bus", "stage", "--json", "--duration", "1"});
    ASSERT_TRUE(feed.wait_for([&](const json& line) {
        return state_is("agrees")(line) && line["cards"][0]["frames"] > 100;
    })) << feed.said();
    EXPECT_EQ(feed.last()["cards"][0]["counts"].size(), 6u);
    EXPECT_EQ(publisher.finish(), 0) << publisher.said();
    EXPECT_TRUE(feed.wait_for(state_is("stale"))) << "the publisher has ended: " << feed.said();
    EXPECT_EQ(feed.last()["cards"][0]["bad"], 0);
}

TEST_F(Network, ReportsThatNoFrameCame) {
    Child subscriber = network_->start(
        0, {MOTIONRACK_PROGRAM, "frames", "subscribe", "--bus", "nobody", "--json", "--duration", "0.1"});
    EXPECT_EQ(subscriber.finish(), 4);
    EXPECT_EQ(subscriber.last()["joined"], false);
}

}  // namespace
}  // namespace motionrack::dds_test
