// Files that act as real cards, and a machine with such a card beside its axes. /dev/zero acts as a card at standstill.
// A file of plain memory never stops, because it returns the written values.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <motionrack/live/test/zero_card.hpp>
#include <motionrack/operate/live_card.hpp>
#include <motionrack/operate/service.hpp>
#include <string>
#include <tests/text_of.hpp>
#include <vector>

#include "operated.hpp"

namespace motionrack::operate {

using CallArguments = std::map<std::string, std::int64_t, std::less<>>;

inline const StopOrigin dora{"dora", "127.0.0.1", ""};
inline const char* const beside = "[card.bench]\ntype = \"mcx314\"\n[card.glass]\ntype = \"ioflex02\"\n";

/// A link to the file that acts as the card.
class CardFile {
  public:
    explicit CardFile(const std::filesystem::path& to) { points_to(to); }
    ~CardFile() { std::filesystem::remove_all(folder_); }
    CardFile(const CardFile&) = delete;
    CardFile& operator=(const CardFile&) = delete;

    void points_to(const std::filesystem::path& to) const {
        std::filesystem::create_directories(folder_);
        std::filesystem::remove(link_);
        std::filesystem::create_symlink(to, link_);
    }
    /// Returns a file of memory filled with equal bytes.
    std::filesystem::path memory(char byte) const {
        std::filesystem::create_directories(folder_);
        std::ofstream(folder_ / "memory", std::ios::binary) << std::string(16, byte);
        return folder_ / "memory";
    }
    std::string place() const { return "port:" + link_.string(); }

  private:
    live::test::ZeroCard zero_;  // reserved: no test of another process uses it meanwhile
    std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() / ("motionrack_live_card_" + std::to_string(::getpid()));
    std::filesystem::path link_ = folder_ / "card";
};

inline MachineSettings settings_of(const CardFile& file) {
    MachineSettings settings;
    settings.live.push_back(*read_live_place("bench=" + file.place()));
    return settings;
}

/// A machine of two axes, and a real card beside it.
struct Real : Operated {
    explicit Real(const CardFile& file, const char* more = beside) : Operated(two_axes(more), settings_of(file)) {}
    void call(double seconds, const std::string& function, const CallArguments& arguments) {
        at(seconds, [=, this](Machine& m) {
            const Result<void> taken = m.service().call(
                {"bench", function, arguments}, dora, "w1",
                [this](Result<CallAnswer> answer) { said.push_back(answer ? answer->text : answer.error().message); });
            if (!taken) said.push_back("refused: " + taken.error().message);
        });
    }
    void end(double seconds) {
        at(seconds, [this](Machine& m) {
            EXPECT_TRUE(m.service().end([this](const Result<std::string>& reported) { said.push_back(*reported); }));
        });
    }
    const std::vector<Alarm>& alarms() const { return machine->status().alarms; }
    std::vector<std::string> said;
};

}  // namespace motionrack::operate
