// A served panel with a card "bench" that another process serves in place of a real one, and the test's own access to
// that card.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <tests/live/served_files.hpp>
#include <tests/served_program.hpp>
#include <thread>
#include <utility>

namespace motionrack::live_test {

/// Access of the test to the served card, and its faults.
class CardSeen {
  public:
    CardSeen() : place(std::getenv("MOTIONRACK_LIVE_PORT")) {
        const std::size_t at = place.find(':') + 1;
        files_ = std::filesystem::path(place.substr(at, place.find(',') - at)).parent_path();
        refuse(0);
        remove(false);
    }
    /// Reads the card from the test's process.
    void look(unsigned offset, void* out, std::size_t bytes) const {
        const int file = ::open((files_ / "look").c_str(), O_RDWR | O_CLOEXEC);
        EXPECT_EQ(::pread(file, out, bytes, port_base + offset), static_cast<ssize_t>(bytes));
        ::close(file);
    }
    /// Returns the address of the card for the test's process.
    std::string other_place() const {
        return "port:" + (files_ / "look").string() + ",offset=" + std::to_string(port_base);
    }
    /// Makes the next `accesses` accesses of the program fail.
    void refuse(std::uint32_t accesses) const { put("refuse", accesses); }
    /// Shows an empty slot to the program, while the card continues to drive.
    void remove(bool away) const { put("absent", away ? 1 : 0); }

    const std::string place;

  private:
    void put(const char* name, std::uint32_t number) const {
        const int file = ::open((files_ / name).c_str(), O_WRONLY | O_CLOEXEC);
        EXPECT_EQ(::write(file, &number, sizeof number), 4) << name;
        ::close(file);
    }
    std::filesystem::path files_;
};

class PanelOnACard : public testing::Test {
  protected:
    /// `type`: of the card.
    explicit PanelOnACard(std::string type) : type_(std::move(type)) {}
    void SetUp() override {
        std::filesystem::create_directories(folder_);
        std::ofstream(folder_ / "rack.toml") << "[card.m]\ntype = \"mcx314\"\n[card.bench]\ntype = \"" << type_
                                             << "\"\n[axis.X]\ncard = \"m\"\nchannel = \"x\"\n";
        serve();
    }
    void TearDown() override {
        served.reset();
        std::filesystem::remove_all(folder_);
    }
    void serve() {
        served.reset();  // its predecessor has released the journal
        served = std::make_unique<Served>(
            std::vector<std::string>{(folder_ / "rack.toml").string(), "--port", "0", "--no-auth", "--users",
                                     (folder_ / "users.json").string(), "--live", "bench=" + card.place});
        ASSERT_NE(served->port(), 0) << served->said;
    }
    nlohmann::json call(const std::string& function, const nlohmann::json& arguments) const {
        return served->post("call", {{"card", "bench"}, {"function", function}, {"arguments", arguments}});
    }
    /// Checks that the answer has this text.
    void good(const std::string& function, const nlohmann::json& arguments, const std::string& text) const {
        const nlohmann::json answer = call(function, arguments);
        EXPECT_EQ(answer.value("text", ""), text) << function << ": " << answer;
    }
    void end_service() const {
        EXPECT_TRUE(served->post("service", {{"card", "bench"}, {"on", false}}).contains("done"));
    }
    static void until_service_ended(ServedLink& link) {
        until("the service has ended", [&] { return link.status().value("service", "?").empty(); });
    }
    static void until(const std::string& what, const std::function<bool()>& is) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
        while (!is()) {
            ASSERT_LT(std::chrono::steady_clock::now(), end) << "not within half a minute: " << what;
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
    }
    /// Returns the newest alarm of the card; null: none.
    static nlohmann::json alarm(ServedLink& link) {
        nlohmann::json found;
        const nlohmann::json status = link.status();
        for (const nlohmann::json& one : status["alarms"])
            if (one["source"] == "card bench") found = one;
        return found;
    }

    const CardSeen card;
    std::unique_ptr<Served> served;

  private:
    std::string type_;
    std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() / ("motionrack_panel_live_" + std::to_string(::getpid()));
};

}  // namespace motionrack::live_test
