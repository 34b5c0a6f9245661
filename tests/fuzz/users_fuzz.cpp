// libFuzzer: any bytes as a users file. Either it is rejected with a sentence and left unchanged, or its users are
// valid. No token authenticates unless it was issued, and a rewritten file gives the same users. Each TOKEN in the
// bytes is replaced by the hash of a known token.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <motionrack/auth/authenticator.hpp>
#include <motionrack/auth/secrets.hpp>
#include <tests/fuzz/scratch_file.hpp>

namespace {

using namespace motionrack;
using namespace motionrack::auth;
using fuzz::require;
using fuzz::ScratchFile;

const std::string& known_token() {
    static const std::string token(64, 'a');
    return token;
}

const ScratchFile& file() {
    static const ScratchFile one("users.json");
    return one;
}

std::string with_tokens(std::string text) {
    for (std::size_t at = 0; (at = text.find("TOKEN", at)) != std::string::npos;)
        text.replace(at, 5, hash_of(known_token()));
    return text;
}

Result<std::unique_ptr<Authenticator>> open() {
    AuthSettings settings;
    settings.users_file = file().path();
    settings.on_start_code = [](const std::string&) {};
    return Authenticator::open(std::move(settings));
}

WallTime at(std::int64_t seconds) {
    return WallTime(std::chrono::seconds(seconds));
}

void check_user(const Authenticator& door, const Identity& user) {
    require(name_problem(user.user).empty(), "a user has a name", user.user);
    require(user.role != Role::none, "a user has a role", user.user);
    require(user.id.size() == 16 && user.id.find_first_not_of("0123456789abcdef") == std::string::npos,
            "a token has an id", user.id);
    require(user.expires >= at(0) && user.expires <= at(9'000'000'000), "a token expires at a time that there is");
    require(door.role_of(user.id, user.expires) == Role::none, "a token that has expired gives no role", user.user);
}

/// Unissued tokens and hashes used as tokens are rejected; a known token is accepted only if its hash is in the file.
void check_tokens(const Authenticator& door, std::string_view text) {
    for (const std::string& wrong :
         {std::string(), std::string("TOKEN"), std::string(64, 'b'), hash_of(known_token()), std::string(64, '\0')})
        require(!door.authenticate(wrong, at(0)), "nobody comes in by a token that was not given out", wrong);
    const auto known = door.authenticate(known_token(), at(0));
    require(!known || text.find(hash_of(known_token())) != std::string_view::npos,
            "a token opens the door only where the file has its hash");
    if (!known) return;
    require(!door.authenticate(known_token(), known->expires), "a token that has expired opens no door");
}

bool is_same(const Identity& a, const Identity& b) {
    return a.id == b.id && a.user == b.user && a.role == b.role && a.expires == b.expires;
}

void check_again(const std::vector<Identity>& users) {
    const auto again = open();
    require(again.has_value(), "what the door wrote it reads", again ? "" : again.error().text());
    const std::vector<Identity> read = (*again)->users();
    require(std::equal(read.begin(), read.end(), users.begin(), users.end(), is_same),
            "users that were written are read as the same ones");
}

/// Changes the file: removes a user and adds another.
void change(Authenticator& door) {
    const Timestamps now{at(1'000'000), std::chrono::steady_clock::time_point{}};
    const std::vector<Identity> before = door.users();
    if (!before.empty()) {
        require(door.forget(before.front().id).has_value(), "a token that is there can be forgotten");
        require(door.users().size() < before.size(), "a token that was forgotten is gone");
        check_again(door.users());
    }
    const auto paired = door.pair(door.start_code(), "fuzz", "127.0.0.1", now);
    if (!paired) return require(!paired.error().sentence.empty(), "who is not paired is told why");
    require(door.authenticate(paired->token, now.wall).has_value(), "who was paired comes in");
    check_again(door.users());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text = with_tokens({reinterpret_cast<const char*>(data), size});
    file().write(text);
    const auto door = open();
    require(file().bytes() == text, "a users file that is read is left as it is");
    if (!door) {
        require(!door.error().message.empty() && door.error().file == file().path(), "a refusal has a sentence",
                door.error().text());
        return 0;
    }
    for (const Identity& user : (*door)->users()) check_user(**door, user);
    check_tokens(**door, text);
    change(**door);
    return 0;
}
